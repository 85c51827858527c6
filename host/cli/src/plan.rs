//! Constraints and domains of the command: reading them, and forcing them into a mesh.

use std::path::{Path, PathBuf};

use incircle::constraints::{constrain, Constrained, Domain, Error, Place, Plan, Snapped, SNAP_BITS};
use incircle::{Duplicate, Lattice, Mesh, PlanePoint, Step};

use crate::arguments::{PlanArguments, ReadArguments};
use crate::connections::Connections;
use crate::failure::Failure;
use crate::formats::{csv, node, PlanTable, PointFormat};
use crate::input::Input;
use crate::lattice::{Kind, Laid, Numbers};
use crate::number::Coordinate;
use crate::path::{check_standard, extension, name};
use crate::planned::Planned;
use crate::points::PointTable;
use crate::source;

/// The constraints, holes and regions that are asked of the mesh of a set.
pub struct Request {
    /// The constraints. Those that bound nothing stand at the end.
    constraints: Vec<[u32; 2]>,
    /// The number of constraints that bound nothing.
    lines: usize,
    pub domain: Domain,
    /// The number of holes, whose places stand behind the points.
    holes: usize,
    /// The attribute of each region. The places of regions stand behind those of holes.
    attributes: Vec<String>,
    /// The constraint of the files that each constraint is a part of; `None` if each is one of these.
    parts: Option<Vec<u32>>,
    /// Whether crossings were to be snapped, but the points lie on no lattice.
    lacks_grid: bool,
}

/// A set of points, and the constraints and the domain that are asked of its mesh.
pub struct PlannedSet {
    /// The points; behind them the places of holes, and then those of regions.
    pub table: PointTable,
    /// The number of points.
    pub points: usize,
    /// `None` if the canonical mesh of the points is all that is asked.
    pub request: Option<Request>,
}

impl PlannedSet {
    /// Whether places of holes or regions stand behind the points.
    pub fn has_marks(&self) -> bool {
        self.table.len() > self.points
    }

    /// The set, of which it is known that its points lie on no lattice, so that crossings cannot be snapped.
    pub fn without_grid(mut self) -> Self {
        self.request.iter_mut().for_each(|request| request.lacks_grid = true);
        self
    }
}

/// Reads a set of points with its constraints.
pub fn read_set(
    paths: &[PathBuf],
    read: &ReadArguments,
    arguments: &PlanArguments,
    quiet: bool,
) -> Result<PlannedSet, Failure> {
    check_standard(paths.iter().chain(&arguments.constraints))?;
    let format = |path: &Path| read.from.or_else(|| PointFormat::of_extension(extension(path)));
    let plan = match paths {
        [path] => match format(path).filter(|format| format.may_constrain()) {
            Some(format) => {
                read.selection(format)?;
                let beside = || read_beside(&path.with_extension("node"), quiet);
                let plan = Input::open(path, quiet).and_then(|input| format.read_plan(input, &beside));
                plan.map_err(|failure| failure.in_file(name(path)))?
            }
            None => PlanTable::of_points(source::read_set(paths, read, quiet)?, false),
        },
        _ => PlanTable::of_points(source::read_set(paths, read, quiet)?, false),
    };
    let PlanTable { table, points, rings: mut constraints, mut lines, holes, attributes, is_poly, .. } = plan;
    if let Some(path) = &arguments.constraints {
        let own = Input::open(path, quiet).and_then(|input| csv::read_pairs(&input.into_bytes()?, points));
        lines.extend(own.map_err(|failure| failure.in_file(name(path)))?);
    }
    let default = match (is_poly, constraints.is_empty()) {
        (true, _) => Domain::Holes,
        (false, false) => Domain::EvenOdd,
        (false, true) => Domain::All,
    };
    // Lines bound a domain only where there is no polygon.
    let free = if constraints.is_empty() { 0 } else { lines.len() };
    constraints.extend(lines);
    let is_asked = is_poly || arguments.is_given() || !constraints.is_empty();
    let domain = arguments.domain.unwrap_or(default);
    let request = is_asked.then_some(Request {
        constraints,
        lines: free,
        domain,
        holes,
        attributes,
        parts: None,
        lacks_grid: false,
    });
    Ok(PlannedSet { table, points, request })
}

/// Reads a `.node` file, and the id of its first point.
fn read_beside(path: &Path, quiet: bool) -> Result<(PointTable, u32), Failure> {
    let table = source::read_points(path, &ReadArguments::of_whole_file(), quiet)?;
    let base = Input::open(path, true).and_then(|input| node::first_id(&input.into_bytes()?));
    Ok((table, base.map_err(|failure| failure.in_file(name(path)))?))
}

impl Request {
    /// Asks for all triangles of the hull with these constraints.
    pub fn of_constraints(constraints: Vec<[u32; 2]>) -> Self {
        let attributes = Vec::new();
        Self { constraints, lines: 0, domain: Domain::All, holes: 0, attributes, parts: None, lacks_grid: false }
    }

    /// The same for a set whose crossings were snapped.
    pub fn snapped(&self, snapped: &Snapped) -> Self {
        let boundary = self.constraints.len() - self.lines;
        Self {
            constraints: snapped.constraints.clone(),
            lines: snapped.of.iter().filter(|&&of| of as usize >= boundary).count(),
            domain: self.domain,
            holes: self.holes,
            attributes: self.attributes.clone(),
            parts: Some(snapped.of.clone()),
            lacks_grid: false,
        }
    }

    /// The constraints. Those that bound nothing stand at the end.
    pub fn constraints(&self) -> &[[u32; 2]] {
        &self.constraints
    }

    /// The number of the constraint of the files that a constraint is a part of.
    pub fn source(&self, number: usize) -> u32 {
        self.parts.as_ref().and_then(|parts| parts.get(number).copied()).unwrap_or(number as u32)
    }

    /// The number of holes.
    pub fn holes(&self) -> usize {
        self.holes
    }

    /// The attributes of regions.
    pub fn attributes(&self) -> &[String] {
        &self.attributes
    }

    /// Whether there are constraints.
    pub fn has_constraints(&self) -> bool {
        !self.constraints.is_empty()
    }

    /// Forces the constraints into the mesh of the first `points` places.
    pub fn force_numbers(
        &self,
        numbers: &Numbers<'_>,
        points: usize,
        mesh: &mut Connections,
    ) -> Result<Constrained, Error> {
        match numbers {
            Numbers::Grid(places) => self.force_in(places, points, mesh),
            Numbers::Whole(places) => self.force_in(places, points, mesh),
            Numbers::Doubles(places) => self.force_in(places, points, mesh),
        }
    }

    /// Forces the constraints into a mesh. The places of holes and regions stand behind the points in `laid`.
    pub fn force(&self, mesh: &mut Connections, set: &PlannedSet, laid: &Laid<'_>) -> Result<Planned, Failure> {
        let made = self.force_numbers(&laid.numbers, set.points, mesh);
        made.map(|made| self.planned(made)).map_err(|error| self.refuse(error, &set.table, laid))
    }

    /// The regions and pieces that constraints made, with the names and numbers of the file.
    pub fn planned(&self, mut made: Constrained) -> Planned {
        let mut constraints = self.constraints.len();
        if let Some(parts) = &self.parts {
            made.pieces = made.pieces.renamed(parts);
            // Every constraint has a part.
            constraints = parts.last().map_or(0, |&last| last as usize + 1);
        }
        let mut attributes = Vec::new();
        if !self.attributes.is_empty() {
            attributes.resize(made.region_count as usize, "0".to_owned());
            // Of several places in one region the first gives the attribute.
            for (&region, attribute) in made.marked.iter().zip(&self.attributes).rev() {
                attributes[region as usize].clone_from(attribute);
            }
        }
        Planned { made, attributes, domain: self.domain, constraints, snapping: None }
    }

    /// The plan in these numbers.
    pub fn plan<'a, P>(&'a self, places: &'a [P], points: usize) -> Plan<'a, P> {
        let marks = places.get(points..).unwrap_or_default();
        let (holes, regions) = marks.split_at(self.holes.min(marks.len()));
        Plan { constraints: &self.constraints, lines: self.lines, domain: self.domain, holes, regions }
    }

    fn force_in<P: PlanePoint>(
        &self,
        places: &[P],
        points: usize,
        mesh: &mut Connections,
    ) -> Result<Constrained, Error> {
        let duplicates = mesh.duplicates.iter().map(|&[index, of]| Duplicate { index, of }).collect();
        let (triangles, hull) = (std::mem::take(&mut mesh.triangles), std::mem::take(&mut mesh.hull));
        let whole = Mesh::new(places[..points].to_vec(), triangles, hull, duplicates);
        let made = constrain(&whole, &self.plan(places, points))?;
        mesh.hull = whole.hull;
        mesh.triangles.clone_from(&made.triangles);
        Ok(made)
    }

    /// The failure of constraints that have no mesh. The place of a crossing is told in the numbers of the file.
    pub fn refuse(&self, error: Error, table: &PointTable, laid: &Laid<'_>) -> Failure {
        let Error::Crossing { constraints, ends, mut place } = error else {
            return Failure::input(error.to_string());
        };
        if !matches!(laid.kind, Kind::Quantized(_)) {
            place = place_in(table, ends).unwrap_or_else(|| about(table, ends));
        }
        let told = Error::Crossing { constraints, ends, place };
        if self.lacks_grid {
            return Failure::input(format!(
                "{told}, or round the points to a grid of at most {} bits first, such as by --quantize fit --coord-bits \
                 {0}: these points lie on no grid that --crossings snap could make finer",
                u32::BITS - SNAP_BITS
            ));
        }
        Failure::input(format!("{told}, or let --crossings snap make points of crossings"))
    }
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
