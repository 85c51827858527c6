//! The nodes of a grid of places: all multiples of a step within the box of a set of points.

use crate::failure::{quoted, Failure};
use crate::memory::Memory;
use crate::number::{self, Decimal, Number};
use crate::points::PointTable;

/// Bytes that a node takes: its coordinates in the file's numbers, on the lattice and as doubles, its value, and that
/// value again in a file that is made in memory.
const NODE_BYTES: u64 = 88;

/// A grid of nodes, row by row from the lowest y, and in a row from the lowest x.
pub struct Grid {
    step: Decimal,
    /// The lowest node, in steps.
    low: [i64; 2],
    /// Nodes in a row, and rows.
    pub counts: [u64; 2],
}

impl Grid {
    /// The nodes with this step, as it is written, within the box of the points.
    ///
    /// # Errors
    /// The step is no positive decimal, or the nodes do not fit the memory.
    pub fn of(step: &str, points: &PointTable, memory: Memory) -> Result<Self, Failure> {
        let shown = quoted(step.as_bytes());
        let step = match number::parse(step.trim().as_bytes()) {
            Some(Number::Decimal(step)) if step.steps > 0 => step,
            _ => {
                return Err(Failure::input(format!("--grid {shown} is no step: give a positive decimal, such as 0.5")))
            }
        };
        let doubles = points.doubles();
        let bound = |axis: usize, pick: fn(f64, f64) -> f64| {
            doubles.iter().map(|point| point[axis]).reduce(pick).unwrap_or(0.0)
        };
        let low = [0, 1].map(|axis| number::multiple_from(bound(axis, f64::min), step));
        let high = [0, 1].map(|axis| number::multiple_to(bound(axis, f64::max), step));
        let counts = [0, 1].map(|axis| (high[axis] - low[axis] + 1.0).max(0.0));
        let most = (memory.bytes() / NODE_BYTES) as f64;
        let is_far = low.iter().chain(&high).any(|value| value.abs() > 1e15);
        if is_far || counts[0] * counts[1] > most {
            return Err(Failure::input(format!(
                "--grid {shown} has {:.3e} nodes, more than the {most:.3e} that {} MiB of free memory hold: give a \
                 larger step",
                counts[0] * counts[1],
                memory.bytes() >> 20
            )));
        }
        Ok(Self { step, low: low.map(|value| value as i64), counts: counts.map(|count| count as u64) })
    }

    /// The nodes as points.
    pub fn nodes(&self) -> Result<PointTable, Failure> {
        let mut table = PointTable::of_items("node");
        let at = |axis: usize, place: u64| {
            let steps = (i128::from(self.low[axis]) + i128::from(place)) * i128::from(self.step.steps);
            Number::of_decimal(steps, self.step.digits)
        };
        for y in (0..self.counts[1]).map(|row| at(1, row)) {
            for x in (0..self.counts[0]).map(|column| at(0, column)) {
                table.push_numbers([x, y])?;
            }
        }
        Ok(table)
    }

    /// The lowest node, and the step, as doubles.
    pub fn origin(&self) -> ([f64; 2], f64) {
        (self.low.map(|place| self.value(place)), Number::Decimal(self.step).nearest().value)
    }

    /// The highest y of a node, as a double.
    pub fn top(&self) -> f64 {
        self.value(self.low[1] + (self.counts[1].max(1) - 1) as i64)
    }

    /// A number of steps as the nearest double.
    fn value(&self, steps: i64) -> f64 {
        number::nearest(i128::from(steps) * i128::from(self.step.steps), self.step.digits)
    }
}
