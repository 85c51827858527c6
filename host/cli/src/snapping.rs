//! `--crossings snap`: a set whose constraints cross becomes one on a finer grid, with points at the crossings.

use incircle::constraints::{snap, SnapError, SNAP_BITS};
use incircle::quantize::quantize;
use incircle::{Lattice, Point, Quantize, Step};

use crate::failure::{failure_of, Failure};
use crate::number;
use crate::plan::PlannedSet;
use crate::planned::Snapping;
use crate::points::{Coordinates, PointTable, Unit};

/// The length of a step of the finer grid, in steps of the grid: `FINE * 10^-8`, as a decimal has 8 digits more.
const FINE: i64 = 390_625;
/// The most digits behind the point that a set may have afterwards. Texts with more are read as doubles.
const MOST_DIGITS: u32 = 18;

/// The coordinates of points of a grid; `None` if they have too many digits.
type MakeCoordinates = dyn Fn(&[Point]) -> Option<Coordinates>;

/// The grid of a set: its points, how long a step is in the coordinates of the snapped set, and how these are made.
struct Fine {
    grid: Vec<Point>,
    bits: u32,
    step: f64,
    make: Box<MakeCoordinates>,
}

/// Snaps the crossings of a set. `how` quantises it before: the coordinates are then those of the grid.
///
/// A set without crossings stays as it is. So does one without a lattice: its crossings are refused when its constraints
/// are forced, with a sentence that says so.
pub fn snap_set(set: PlannedSet, how: Option<(Quantize, u32)>) -> Result<(PlannedSet, Option<Snapping>), Failure> {
    let Some(request) = &set.request else { return Ok((set, None)) };
    let Some(fine) = fine(&set.table, how)? else { return Ok((set.without_grid(), None)) };
    let snapped = snap(&fine.grid[..set.points], request.constraints()).map_err(|error| refuse(&error))?;
    if snapped.finer_bits == 0 {
        return Ok((set, None));
    }
    // Places of holes and regions lie on the same grid.
    if fine.bits + SNAP_BITS > u32::BITS {
        return Err(refuse(&SnapError::NoRoom { bits: fine.bits }));
    }
    let finer = |point: &Point| Point::new(point.x << SNAP_BITS, point.y << SNAP_BITS);
    let mut grid = snapped.points.clone();
    grid.extend(fine.grid[set.points..].iter().map(finer));
    let coordinates = (fine.make)(&grid).ok_or_else(|| {
        Failure::input(
            "constraints cross, and the coordinates have too many digits for points at the crossings: round them first \
             (--quantize)",
        )
    })?;
    let table = PointTable::of_coordinates("point", coordinates);
    let largest_displacement = snapped.largest_displacement * fine.step;
    let told = Snapping { new_points: snapped.new_points, largest_displacement };
    let request = request.snapped(&snapped);
    Ok((PlannedSet { table, points: snapped.points.len(), request: Some(request) }, Some(told)))
}

/// Lays a set onto its grid; `None` if it has none.
fn fine(table: &PointTable, how: Option<(Quantize, u32)>) -> Result<Option<Fine>, Failure> {
    if let Some((how, coord_bits)) = how {
        let (grid, _) = quantize(&table.doubles(), coord_bits, how).map_err(|error| failure_of(&error))?;
        let bits = Lattice::of_grid(&grid).bits;
        let unit = Unit { digits: SNAP_BITS, factor: FINE, offset: [0; 2], is_stored: true };
        let make = move |grid: &[Point]| {
            let steps = grid.iter().map(|point| [point.x.into(), point.y.into()]).collect();
            Some(Coordinates::Steps { steps, unit })
        };
        return Ok(Some(Fine { grid, bits, step: number::nearest(FINE.into(), SNAP_BITS), make: Box::new(make) }));
    }
    match table.coordinates() {
        Coordinates::Steps { steps, unit } => {
            let found = Lattice::of_integers(steps, Step::Whole);
            Ok(found.map(|(lattice, grid)| of_steps(grid, lattice, *unit)))
        }
        Coordinates::Doubles(doubles) if table.rounded() == 0 => {
            Ok(Lattice::of_doubles(doubles).map(|(lattice, grid)| of_doubles(grid, lattice)))
        }
        Coordinates::Doubles(_) => Ok(None),
    }
}

fn of_steps(grid: Vec<Point>, lattice: Lattice, unit: Unit) -> Fine {
    let digits = unit.digits + SNAP_BITS;
    let step = number::nearest(i128::from(unit.factor) * i128::from(FINE), digits);
    let make = move |grid: &[Point]| {
        let power = 10i128.pow(SNAP_BITS);
        let offset = [unit.offset[0].checked_mul(power)?, unit.offset[1].checked_mul(power)?];
        let unit = Unit { digits, factor: unit.factor.checked_mul(FINE)?, offset, is_stored: true };
        let base = [lattice.offset[0].checked_mul(1 << SNAP_BITS)?, lattice.offset[1].checked_mul(1 << SNAP_BITS)?];
        let fine = |point: &Point| Some([base[0].checked_add(point.x.into())?, base[1].checked_add(point.y.into())?]);
        let steps = grid.iter().map(fine).collect::<Option<Vec<[i64; 2]>>>()?;
        (digits <= MOST_DIGITS).then_some(Coordinates::Steps { steps, unit })
    };
    Fine { grid, bits: lattice.bits, step, make: Box::new(make) }
}

fn of_doubles(grid: Vec<Point>, lattice: Lattice) -> Fine {
    let fine = 1.0 / f64::from(1u32 << SNAP_BITS);
    let length = lattice.step.length() * fine;
    let make = move |grid: &[Point]| {
        // Numbers of at most 53 bits are doubles.
        let steps = |offset: i64, value: u32| {
            let steps = offset.checked_mul(1 << SNAP_BITS)?.checked_add(value.into())?;
            let double = steps as f64 * length;
            (steps.unsigned_abs() < 1 << 53 && double / length == steps as f64).then_some(double)
        };
        let double = |point: &Point| Some([steps(lattice.offset[0], point.x)?, steps(lattice.offset[1], point.y)?]);
        grid.iter().map(double).collect::<Option<Vec<[f64; 2]>>>().map(Coordinates::Doubles)
    };
    Fine { grid, bits: lattice.bits, step: length, make: Box::new(make) }
}

fn refuse(error: &SnapError) -> Failure {
    let hint = match error {
        SnapError::NoRoom { .. } => ", such as --quantize fit --coord-bits 24",
        _ => "",
    };
    Failure::input(format!("{error}{hint}"))
}
