//! From the numbers of a file to the numbers that are triangulated: the lattice of the points or, if the user asks for
//! rounding, a grid.

use std::borrow::Cow;

use incircle::quantize::quantize;
use incircle::{Error, Lattice, Point, Quantization, Quantize, Shown, Step};
use serde_json::{json, Value};

use crate::failure::{counted, failure_of, Exit, Failure};
use crate::points::{chosen, Coordinates, PointTable, Unit};

/// Points in the numbers in which they are triangulated.
pub enum Numbers<'a> {
    /// Points on a lattice.
    Grid(Vec<Point>),
    /// Whole numbers of up to 64 bits.
    Whole(Cow<'a, [[i64; 2]]>),
    /// Doubles.
    Doubles(Cow<'a, [[f64; 2]]>),
}

impl Numbers<'_> {
    /// The number of points.
    pub fn len(&self) -> usize {
        match self {
            Self::Grid(points) => points.len(),
            Self::Whole(points) => points.len(),
            Self::Doubles(points) => points.len(),
        }
    }

    /// The points at these indices, which must exist.
    pub fn select(&self, indices: &[u32]) -> Numbers<'static> {
        match self {
            Self::Grid(points) => Numbers::Grid(chosen(points, indices)),
            Self::Whole(points) => Numbers::Whole(chosen(points, indices).into()),
            Self::Doubles(points) => Numbers::Doubles(chosen(points, indices).into()),
        }
    }
}

/// The points of a file in the numbers in which they are triangulated.
pub struct Laid<'a> {
    /// All points, in input order.
    pub numbers: Numbers<'a>,
    /// The kind of numbers.
    pub kind: Kind,
    /// Bits of the larger span, in steps; `None` for doubles, which have no steps.
    pub bits: Option<u32>,
    /// The coordinates of the place from which steps are counted, as JSON; `null` for doubles.
    pub offset: Value,
}

/// The kind of numbers in which points are triangulated.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// Whole numbers.
    Whole,
    /// Whole numbers of steps. The length of a step is the decimal `factor * 10^exponent`, with factor and exponent in
    /// this order.
    Decimal(i64, i32),
    /// Whole numbers of steps. The length of a step is the power of two with this exponent.
    Binary(i32),
    /// The doubles in the file, or the doubles nearest to its decimals, with the number of coordinates that were
    /// rounded.
    Doubles(usize),
    /// Points of a grid, onto which the points of the file were rounded by `--quantize`.
    Quantized(Quantization),
}

impl Laid<'_> {
    /// The first `count` points alone, in the same numbers.
    pub fn first(&self, count: usize) -> Laid<'static> {
        let indices: Vec<u32> = (0..count as u32).collect();
        let (kind, offset) = (self.kind.clone(), self.offset.clone());
        Laid { numbers: self.numbers.select(&indices), kind, bits: self.bits, offset }
    }

    /// The quantisation that was done, if the user asked for one.
    pub fn quantization(&self) -> Option<&Quantization> {
        match &self.kind {
            Kind::Quantized(quantization) => Some(quantization),
            _ => None,
        }
    }

    /// The lattice as a JSON object: a grid point `p` stands for `offset + scale * p`.
    pub fn to_json(&self) -> Value {
        let (kind, scale) = match &self.kind {
            Kind::Whole => ("whole", json!(1)),
            &Kind::Decimal(factor, exponent @ ..=0) => {
                ("decimal", json!(crate::number::nearest(factor.into(), exponent.unsigned_abs())))
            }
            &Kind::Decimal(factor, exponent) => ("decimal", json!(factor * 10i64.pow(exponent.unsigned_abs()))),
            &Kind::Binary(exponent) => ("binary", json!(Step::Binary { exponent }.length())),
            Kind::Doubles(_) => ("doubles", Value::Null),
            Kind::Quantized(quantization) => ("quantized", json!(1.0 / quantization.scale)),
        };
        let rounded = match self.kind {
            Kind::Doubles(rounded) => json!(rounded),
            // The report of the quantisation has the largest error.
            Kind::Quantized(_) => Value::Null,
            _ => json!(0),
        };
        json!({ "kind": kind, "scale": scale, "offset": self.offset, "bits": self.bits, "rounded": rounded })
    }

    /// The line of the report for people.
    pub fn line(&self) -> String {
        let steps = match &self.kind {
            Kind::Whole => "lattice: whole numbers".to_owned(),
            Kind::Decimal(factor, exponent) => format!("lattice: decimals, steps of {factor}e{exponent}"),
            Kind::Binary(exponent) => format!("lattice: steps of 2^{exponent}"),
            Kind::Doubles(0) => return "lattice: none of up to 32 bits; exact on the doubles".to_owned(),
            &Kind::Doubles(rounded) => {
                let are = if rounded == 1 { "is" } else { "are" };
                return format!(
                    "lattice: none of up to 32 bits; exact on the nearest doubles ({} {are} rounded to them)",
                    counted(rounded, "coordinate")
                );
            }
            Kind::Quantized(q) => {
                let ([x, y], merged) = (q.offset, counted(q.merged, "point"));
                return format!(
                    "quantised to {} bits: scale {}, offset ({}, {}), largest error {:.3e}, {merged} fell onto another",
                    q.coord_bits,
                    Shown(q.scale),
                    Shown(x),
                    Shown(y),
                    q.largest_error
                );
            }
        };
        format!("{steps}, {}", counted(self.bits.unwrap_or_default() as usize, "bit"))
    }

    /// Refuses points that a device with coordinates of `coord_bits` bits cannot take. The message names both remedies.
    pub fn check_bits(&self, coord_bits: u32, device: &str) -> Result<(), Failure> {
        let Some(have) = self.beyond_bits(coord_bits) else {
            return Ok(());
        };
        if let Kind::Quantized(_) = self.kind {
            return Err(Failure::input(format!(
                "{have} after --quantize, but {device} has coordinates of {coord_bits} bits: give --coord-bits \
                 {coord_bits}"
            )));
        }
        Err(Failure::input(format!(
            "{have}, but {device} has coordinates of {coord_bits} bits: give --backend cpu, which takes them exactly, \
             or --quantize fit, which rounds them"
        )))
    }

    /// The beginning of a message about points that need more than coordinates of `coord_bits` bits; `None` if they do
    /// not.
    pub fn beyond_bits(&self, coord_bits: u32) -> Option<String> {
        match (&self.numbers, self.bits) {
            (Numbers::Grid(_), Some(bits)) if bits <= coord_bits => None,
            (_, Some(bits)) => Some(format!("the {} need {}", self.noun(), counted(bits as usize, "bit"))),
            (_, None) => Some("the points lie on no lattice of up to 32 bits".to_owned()),
        }
    }

    fn noun(&self) -> String {
        match &self.kind {
            Kind::Whole => "whole numbers of the points".to_owned(),
            Kind::Decimal(factor, exponent) => format!("steps of {factor}e{exponent} in which the points lie"),
            Kind::Binary(exponent) => format!("steps of 2^{exponent} in which the points lie"),
            Kind::Doubles(_) | Kind::Quantized(_) => "points".to_owned(),
        }
    }
}

/// Finds the lattice of the points. The first that fits is taken: whole numbers, steps of a power of ten (above 1 where
/// whole numbers do not fit), steps of a power of two, each with spans below 2^32 steps. Without a lattice the points
/// are whole numbers of 64 bits, or doubles. Steps of a power of two are tried only if every number is a double, so
/// that no rounded number passes for the one in the file. If `how` is given, the points are laid onto a grid of that
/// many bits instead.
pub fn lay(table: &PointTable, how: Option<(Quantize, u32)>) -> Result<Laid<'_>, Failure> {
    if let Some((how, coord_bits)) = how {
        return lay_onto_grid(table, how, coord_bits);
    }
    match table.coordinates() {
        Coordinates::Steps { steps, unit } => {
            let kind = if unit.is_whole() { Kind::Whole } else { Kind::Decimal(unit.factor, -(unit.digits as i32)) };
            if let Some((lattice, grid)) = Lattice::of_integers(steps, Step::Whole) {
                return Ok(on_lattice(grid, &lattice, kind, |steps, axis| decimal_json(unit, steps, axis)));
            }
            if let Some(laid) = lay_on_tens(steps).filter(|_| unit.is_whole()) {
                return Ok(laid);
            }
            if is_taken_wide(unit) {
                let numbers = Numbers::Whole(Cow::Borrowed(steps));
                let offset = json!([decimal_json(unit, 0, 0), decimal_json(unit, 0, 1)]);
                return Ok(Laid { numbers, kind, bits: Some(wide_bits(steps)), offset });
            }
        }
        Coordinates::Doubles(_) => {}
    }
    let (doubles, rounded) = (table.doubles(), table.rounded());
    // A lattice of rounded numbers is not that of the file.
    let found = if rounded == 0 { Lattice::of_doubles(&doubles) } else { None };
    let Some((lattice, grid)) = found else {
        let (numbers, kind) = (Numbers::Doubles(doubles), Kind::Doubles(rounded));
        return Ok(Laid { numbers, kind, bits: None, offset: Value::Null });
    };
    let kind = match lattice.step {
        Step::Binary { exponent } => Kind::Binary(exponent),
        _ => Kind::Whole,
    };
    Ok(on_lattice(grid, &lattice, kind, |steps, _| json!(steps as f64 * lattice.step.length())))
}

/// Whole numbers on a lattice whose steps are a power of ten above 1.
fn lay_on_tens(steps: &[[i64; 2]]) -> Option<Laid<'static>> {
    let mut exponent = 18;
    for value in steps.iter().flatten() {
        while value % 10i64.pow(exponent) != 0 {
            exponent -= 1;
        }
        if exponent == 0 {
            return None;
        }
    }
    let power = 10i64.pow(exponent);
    let multiples: Vec<_> = steps.iter().map(|point| point.map(|value| value / power)).collect();
    let (lattice, grid) = Lattice::of_integers(&multiples, Step::Whole)?;
    Some(on_lattice(grid, &lattice, Kind::Decimal(1, exponent as i32), |multiple, _| json!(multiple * power)))
}

/// Makes the points of a lattice of up to 32 bits. `value` gives the coordinate for a number of steps on an axis.
fn on_lattice(grid: Vec<Point>, lattice: &Lattice, kind: Kind, value: impl Fn(i64, usize) -> Value) -> Laid<'static> {
    let [x, y] = lattice.offset;
    let offset = json!([value(x, 0), value(y, 1)]);
    Laid { numbers: Numbers::Grid(grid), kind, bits: Some(lattice.bits), offset }
}

/// Whether the points stay in steps even if a span is 2^32 steps or more. Decimals of a text do not: they usually are
/// printed doubles, and the nearest doubles are quicker to triangulate.
fn is_taken_wide(unit: &Unit) -> bool {
    unit.is_whole() || unit.is_stored
}

/// The bits of the larger span of the points, in steps.
fn wide_bits(steps: &[[i64; 2]]) -> u32 {
    let span = |axis: usize| {
        let values = || steps.iter().map(|point| point[axis]);
        values().max().unwrap_or(0).abs_diff(values().min().unwrap_or(0))
    };
    u64::BITS - (span(0) | span(1)).leading_zeros()
}

/// A coordinate as a JSON number: a whole number exactly, any other as the nearest double.
fn decimal_json(unit: &Unit, steps: i64, axis: usize) -> Value {
    if unit.is_whole() {
        json!(steps)
    } else {
        json!(unit.nearest(steps, axis))
    }
}

/// Lays points onto a grid, because the user asked for it.
fn lay_onto_grid(table: &PointTable, how: Quantize, coord_bits: u32) -> Result<Laid<'static>, Failure> {
    let (points, quantization) = quantize(&table.doubles(), coord_bits, how).map_err(|error| refuse(&error, table))?;
    let offset = json!(quantization.offset);
    let bits = Some(Lattice::of_grid(&points).bits);
    Ok(Laid { numbers: Numbers::Grid(points), kind: Kind::Quantized(quantization), bits, offset })
}

/// Turns an error of the library into a failure that names the place of the point in the file.
fn refuse(error: &Error, table: &PointTable) -> Failure {
    let Error::OutOfGrid { index, axis, value, coord_bits } = error else {
        return failure_of(error);
    };
    let place = table.place(*index, usize::from(*axis == 'y'));
    let last = (1u64 << coord_bits) - 1;
    Failure::new(
        Exit::Input,
        format!(
            "{place}: the value falls on {}, outside 0 to {last} ({coord_bits} bits): \
             choose another scale or --quantize fit",
            Shown(*value)
        ),
    )
}

#[cfg(test)]
mod tests;
