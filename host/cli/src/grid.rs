//! The nodes of a grid of places: all multiples of a step within the box of a set of points.

use crate::failure::Failure;
use crate::memory::Memory;
use crate::number::Number;
use crate::points::PointTable;
use crate::step::Step;

/// Bytes that a row or a column takes: a place in the numbers of the file, on the lattice and as doubles.
const LINE_BYTES: f64 = 64.0;
/// Bytes that a point takes while values are worked out: its triangulation, and the surface.
const POINT_BYTES: f64 = 440.0;

/// A grid of nodes, row by row from the lowest y, and in a row from the lowest x.
pub struct Grid {
    step: Step,
    /// The lowest node, in steps.
    low: [i64; 2],
    /// Nodes in a row, and rows.
    pub counts: [u64; 2],
}

impl Grid {
    /// The nodes with this step, as it is written, within the box of the points. `bytes` is the memory that a node
    /// takes.
    ///
    /// # Errors
    /// The step is no positive decimal, or the nodes do not fit the memory.
    pub fn of(step: &str, points: &PointTable, bytes: u64, memory: Memory) -> Result<Self, Failure> {
        let step = Step::read("--grid", step, "0.5")?;
        let doubles = points.doubles();
        let bound = |axis: usize, pick: fn(f64, f64) -> f64| {
            doubles.iter().map(|point| point[axis]).reduce(pick).unwrap_or(0.0)
        };
        let multiples = |axis: usize| step.multiples(bound(axis, f64::min), bound(axis, f64::max), "points");
        let [columns, rows] = [multiples(0)?, multiples(1)?];
        let counts = [columns, rows].map(|[first, last]| u64::try_from(last - first + 1).unwrap_or(0));
        let [across, up] = counts.map(|count| count as f64);
        let of_points = doubles.len() as f64 * POINT_BYTES;
        let needed = across * up * bytes as f64 + (across + up) * LINE_BYTES + of_points;
        if of_points > memory.bytes() as f64 {
            return Err(Failure::input(format!(
                "{} points take {:.0} MiB on the way to a grid, more than the {} MiB of free memory: give fewer points, or \
                 use a machine with more memory",
                doubles.len(),
                of_points / f64::from(1 << 20),
                memory.bytes() >> 20
            )));
        }
        if needed > memory.bytes() as f64 {
            return Err(step.refuse(&format!(
                "gives {across} by {up} nodes, which take {:.0} MiB with the points, more than the {} MiB of free \
                 memory",
                needed / f64::from(1 << 20),
                memory.bytes() >> 20
            )));
        }
        Ok(Self { step, low: [columns[0], rows[0]], counts })
    }

    /// The nodes of the first row, and behind them the first node of each other row. Together they have all the
    /// coordinates of the grid.
    pub fn edge_nodes(&self) -> Result<PointTable, Failure> {
        let mut table = PointTable::of_items("node");
        let at = |axis: usize, place: u64| {
            let steps = (i128::from(self.low[axis]) + i128::from(place)) * i128::from(self.step.decimal.steps);
            Number::of_decimal(steps, self.step.decimal.digits)
        };
        let [columns, rows] = self.counts;
        if self.len() > 0 {
            (0..columns).try_for_each(|column| table.push_numbers([at(0, column), at(1, 0)]))?;
            (1..rows).try_for_each(|row| table.push_numbers([at(0, 0), at(1, row)]))?;
        }
        Ok(table)
    }

    /// The number of nodes.
    pub fn len(&self) -> usize {
        (self.counts[0] * self.counts[1]) as usize
    }

    /// The places in the list of [`edge_nodes`](Self::edge_nodes) that have the x and the y of a node.
    pub fn sources(&self, node: usize) -> [usize; 2] {
        let columns = self.counts[0] as usize;
        let (row, column) = (node / columns, node % columns);
        [column, if row == 0 { 0 } else { columns + row - 1 }]
    }

    /// Refuses a grid without nodes, for a format that has no such grids.
    pub fn check_nodes(&self) -> Result<(), Failure> {
        if self.len() > 0 {
            return Ok(());
        }
        Err(Failure::input(
            "the grid has no node, because no multiple of the step lies within the box of the points: give a smaller \
             --grid",
        ))
    }

    /// The lowest node, and the step, as doubles.
    pub fn origin(&self) -> ([f64; 2], f64) {
        (self.low.map(|place| self.step.times(place)), self.step.times(1))
    }

    /// The highest y of a node, as a double.
    pub fn top(&self) -> f64 {
        self.step.times(self.low[1] + (self.counts[1].max(1) - 1) as i64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_that_just_fits_is_taken() {
        let mut points = PointTable::of_items("point");
        for [x, y] in [["0", "0"], ["1", "0"], ["0", "1"]] {
            points.push([x.as_bytes(), y.as_bytes()], 0).expect("numbers");
        }
        // 101 rows and columns, and three points.
        let bytes = 8 * 101 * 101 + 64 * 202 + 440 * 3;
        let grid =
            |bytes: u64| Grid::of("0.01", &points, 8, Memory::of_bytes(bytes)).map_err(|failure| failure.message);
        let fitting = grid(bytes).expect("the nodes fit");
        assert_eq!((fitting.counts, fitting.len(), fitting.sources(203)), ([101, 101], 10_201, [1, 102]));
        let nodes = fitting.edge_nodes().expect("numbers");
        assert_eq!((nodes.len(), nodes.doubles()[100], nodes.doubles()[102]), (201, [1.0, 0.0], [0.0, 0.02]));
        assert!(grid(bytes - 1).is_err_and(|message| message.contains("gives 101 by 101 nodes, which take")));
    }
}
