//! Failures of plans that have no mesh, in the numbers and with the names of the files.

use incircle::constraints::{Domain, Error, Mark, Place, SNAP_BITS};
use incircle::verify::lie_inside;
use incircle::{Lattice, PlanePoint, Step, VerifyError};

use crate::failure::Failure;
use crate::lattice::{Kind, Laid, Numbers};
use crate::number::Coordinate;
use crate::plan::{PlannedSet, Request};
use crate::points::PointTable;

/// The error of the plan that the validator found; `Err` if it found one of the triangles.
pub fn of_plan(error: VerifyError) -> Result<Error, VerifyError> {
    Ok(match error {
        VerifyError::Open { point, count } => Error::Open { point, count },
        VerifyError::Unbalanced { point, begin, end } => Error::Unbalanced { point, begin, end },
        VerifyError::EmptyDomain { triangles } => Error::Empty { triangles },
        VerifyError::MarkOutside { kind, number } => Error::Outside { kind, number },
        VerifyError::MarkOnConstraint { kind, number, edge: [a, b] } => {
            Error::OnConstraint { kind, number, edge: [a.min(b), a.max(b)] }
        }
        other => return Err(other),
    })
}

impl Request {
    /// The failure of constraints that have no mesh. The place of a crossing is told in the numbers of the file. `file`
    /// names the set.
    pub fn refuse(&self, error: Error, (set, file): (&PlannedSet, &str), laid: &Laid<'_>) -> Failure {
        let names = self.file_of(&error, file);
        let mark = |kind, number| self.mark(set, kind, number);
        let told = match error {
            Error::Crossing { constraints, ends, mut place } => {
                if !matches!(laid.kind, Kind::Quantized(_)) {
                    place = place_in(&set.table, ends).unwrap_or_else(|| about(&set.table, ends));
                }
                self.crossing(&Error::Crossing { constraints, ends, place })
            }
            Error::Open { .. } => {
                format!("{error}: add the missing constraint, or take all triangles of the hull by --domain all")
            }
            Error::Unbalanced { .. } => {
                format!("{error}: let the constraints of each ring run one way, or give --domain even-odd")
            }
            Error::Empty { .. } => format!("{error}: close the rings around the domain, or give --domain all"),
            Error::Outside { kind, number } => format!("{} lies outside the hull of the points", mark(kind, number)),
            Error::OnConstraint { kind, number, edge: [a, b] } => {
                format!("{} lies on the constraint from point {a} to point {b}", mark(kind, number))
            }
            Error::RegionOutsideDomain { number } => {
                let region = mark(Mark::Region, number);
                format!("{region} lies in a part of the hull that does not belong to the domain")
            }
            other => other.to_string(),
        };
        Failure::input(told).in_file(names)
    }

    /// The file whose constraints are wrong.
    fn file_of(&self, error: &Error, file: &str) -> String {
        let Some((name, first)) = self.beside() else { return file.to_owned() };
        let is_beside = |number: u32| self.source(number as usize) as usize >= first;
        match error {
            Error::Crossing { constraints, .. } => match constraints.map(is_beside) {
                [true, true] => name.to_owned(),
                [false, false] => file.to_owned(),
                _ => format!("{file} and {name}"),
            },
            Error::Open { .. } | Error::Unbalanced { .. } if first == 0 => name.to_owned(),
            _ => file.to_owned(),
        }
    }

    fn crossing(&self, told: &Error) -> String {
        if self.lacks_grid {
            return format!(
                "{told}, or round the points to a grid of at most {} bits first, such as by --quantize fit --coord-bits \
                 {0}: these points lie on no grid that --crossings snap could make finer",
                u32::BITS - SNAP_BITS
            );
        }
        format!("{told}, or let --crossings snap make points of crossings")
    }

    /// A hole or region as messages name it. Files have no names for them, so they are counted.
    fn mark(&self, set: &PlannedSet, kind: Mark, number: usize) -> String {
        let behind = if kind == Mark::Region { self.holes() } else { 0 };
        let [x, y] = [0, 1].map(|axis| set.table.coordinate(set.points + behind + number, axis));
        format!("{kind} {}, counted from 1, at ({x}, {y}),", number + 1)
    }

    /// Refuses a polygon with a hole outside its outer ring, which the rule even-odd would make part of the
    /// domain. The constraints are known not to cross.
    pub fn check_holes(&self, (set, file): (&PlannedSet, &str), laid: &Laid<'_>) -> Result<(), Failure> {
        if !matches!(self.domain, Domain::EvenOdd | Domain::NonZero) {
            return Ok(());
        }
        let rings: Vec<(&[[u32; 2]], bool)> = self.rings().collect();
        for (polygon, own) in (1..).zip(rings.chunk_by(|_, (_, next_is_outer)| !next_is_outer)) {
            let Some((&(outer, _), holes)) = own.split_first().filter(|(_, holes)| !holes.is_empty()) else { continue };
            let holes: Vec<&[[u32; 2]]> = holes.iter().map(|&(hole, _)| hole).collect();
            let found = match &laid.numbers {
                Numbers::Grid(places) => misplaced(places, outer, &holes),
                Numbers::Whole(places) => misplaced(places, outer, &holes),
                Numbers::Doubles(places) => misplaced(places, outer, &holes),
            };
            let Some(hole) = found else { continue };
            let first = holes[hole].first().map_or(0, |side| side[0]) as usize;
            let [x, y] = [0, 1].map(|axis| set.table.coordinate(first, axis));
            return Err(Failure::input(format!(
                "ring {} of polygon {polygon}, both counted from 1, is a hole that begins at ({x}, {y}) and lies outside \
                 ring 1 of the polygon, at least in part: move it inside, or make it a polygon of its own",
                hole + 2
            ))
            .in_file(file));
        }
        Ok(())
    }
}

/// The first hole that is not inside a ring or on it.
fn misplaced<P: PlanePoint>(places: &[P], outer: &[[u32; 2]], holes: &[&[[u32; 2]]]) -> Option<usize> {
    let mut used: Vec<u32> = holes.iter().copied().chain([outer]).flatten().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let points: Vec<P> = used.iter().map(|&index| places[index as usize]).collect();
    let rank = |index: u32| used.partition_point(|&own| own < index) as u32;
    let renamed = |sides: &[[u32; 2]]| sides.iter().map(|side| side.map(rank)).collect::<Vec<_>>();
    let outer = renamed(outer);
    let has_misplaced = |count: usize| lie_inside(&points, &outer, &renamed(&holes[..count].concat())) == Ok(false);
    if !has_misplaced(holes.len()) {
        return None;
    }
    let (mut inside, mut outside) = (0, holes.len());
    while outside - inside > 1 {
        let middle = (inside + outside) / 2;
        if has_misplaced(middle) {
            outside = middle;
        } else {
            inside = middle;
        }
    }
    Some(inside)
}

/// The place of [`place_in`] in doubles, where whole numbers of 128 bits do not hold it. Coordinates are divided by the
/// largest one first, so that no product overflows or vanishes.
fn about(table: &PointTable, ends: [[u32; 2]; 2]) -> Place {
    let doubles = table.doubles();
    let [a, b, c, d] = [ends[0][0], ends[0][1], ends[1][0], ends[1][1]].map(|index| doubles[index as usize]);
    let largest = [a, b, c, d].as_flattened().iter().fold(f64::MIN_POSITIVE, |most, value| most.max(value.abs()));
    let [a, b, c, d] = [a, b, c, d].map(|point| point.map(|value| value / largest));
    let vector = |from: [f64; 2], to: [f64; 2]| [to[0] - from[0], to[1] - from[1]];
    let cross = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
    let along = vector(a, b);
    let share = cross(vector(a, c), vector(c, d)) / cross(along, vector(c, d));
    Place::About([0, 1].map(|axis| (a[axis] + share * along[axis]) * largest))
}

/// The crossing of two constraints, given by the indices of their ends, in the numbers of the file. `None` if whole
/// numbers of 128 bits do not hold it.
fn place_in(table: &PointTable, ends: [[u32; 2]; 2]) -> Option<Place> {
    let [a, b, c, d] = [ends[0][0], ends[0][1], ends[1][0], ends[1][1]]
        .map(|index| [0, 1].map(|axis| table.coordinate(index as usize, axis)));
    let all = [a, b, c, d];
    let digits = all.iter().flatten().map(|coordinate| match coordinate {
        Coordinate::Decimal { digits, .. } => Some(*digits),
        Coordinate::Double(_) => None,
    });
    if let Some(digits) = digits.collect::<Option<Vec<u32>>>().and_then(|digits| digits.into_iter().max()) {
        let steps = |coordinate: Coordinate| match coordinate {
            Coordinate::Decimal { steps, digits: own } => steps.checked_mul(10i128.checked_pow(digits - own)?),
            Coordinate::Double(_) => None,
        };
        let point = |[x, y]: [Coordinate; 2]| Some([steps(x)?, steps(y)?]);
        return Place::of_lines([[point(a)?, point(b)?], [point(c)?, point(d)?]], 10i128.checked_pow(digits)?);
    }
    let value = |coordinate: Coordinate| match coordinate {
        Coordinate::Double(value) => Some(value),
        Coordinate::Decimal { .. } => None,
    };
    let point = |[x, y]: [Coordinate; 2]| Some([value(x)?, value(y)?]);
    let (lattice, grid) = Lattice::of_doubles(&[point(a)?, point(b)?, point(c)?, point(d)?])?;
    let parts = match lattice.step {
        Step::Binary { exponent: exponent @ ..=0 } => 2i128.checked_pow(exponent.unsigned_abs())?,
        _ => 1,
    };
    let steps = |place: usize| grid.get(place).map(|&point| lattice.steps(point).map(i128::from));
    Place::of_lines([[steps(0)?, steps(1)?], [steps(2)?, steps(3)?]], parts)
}
