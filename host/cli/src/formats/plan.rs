//! The points and the constraints of a file.

use crate::failure::{counted, Failure};
use crate::memory::Memory;
use crate::points::PointTable;

/// The points of a file, the constraints between them, and the holes and regions of a `.poly` file.
pub struct PlanTable {
    /// The points; behind them the places of holes, and then those of regions.
    pub table: PointTable,
    /// The number of points.
    pub points: usize,
    /// The sides of polygons, or all segments of a `.poly` file.
    pub rings: Vec<[u32; 2]>,
    /// The rings of polygons, in the order of their sides. A `.poly` file has none.
    pub polygons: Vec<Ring>,
    /// The pieces of lines.
    pub lines: Vec<[u32; 2]>,
    /// The number of holes.
    pub holes: usize,
    /// The attribute of each region, as it is written.
    pub attributes: Vec<String>,
    /// Whether the file is a `.poly` file.
    pub is_poly: bool,
    /// Whether lines and polygons are refused, because somebody wants points.
    only_points: bool,
    /// Whether the next ring is the outer one of a polygon.
    begins_polygon: bool,
}

/// A ring of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ring {
    /// The number of sides of polygons up to the last one of this ring.
    pub end: usize,
    /// Whether the ring is the first one of its polygon: all others bound holes.
    pub is_outer: bool,
}

impl PlanTable {
    /// A plan without points. If only points are wanted, lines and polygons are refused.
    pub fn new(memory: Memory, only_points: bool) -> Self {
        Self::of_points(PointTable::of_items("point").within(memory), only_points)
    }

    /// A plan of points without constraints.
    pub fn of_points(table: PointTable, only_points: bool) -> Self {
        let (rings, polygons, lines, attributes) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (points, holes, is_poly, begins_polygon) = (table.len(), 0, false, false);
        Self { points, table, rings, polygons, lines, holes, attributes, is_poly, only_points, begins_polygon }
    }

    /// Whether lines and polygons are refused.
    pub fn takes_only_points(&self) -> bool {
        self.only_points
    }

    /// The plan, once all points are in it.
    pub fn complete(self) -> Result<Self, Failure> {
        let table = self.table.complete()?;
        let points = if self.is_poly { self.points } else { table.len() };
        Ok(Self { table, points, ..self })
    }

    /// Makes a line of the points from the one with this index to the last. `what` names its place in messages.
    pub fn add_line(&mut self, first: usize, what: impl Fn() -> String) -> Result<(), Failure> {
        let count = self.table.len() - first;
        if count == 1 {
            return Err(Failure::input(format!("{} has a line of 1 point: a line needs two or more", what())));
        }
        self.lines.extend(chain(first, self.table.len()));
        Ok(())
    }

    /// Begins a polygon: the next ring is its outer one.
    pub fn begin_polygon(&mut self) {
        self.begins_polygon = true;
    }

    /// Makes a ring of the points from the one with this index to the last, which repeats the first.
    pub fn add_ring(&mut self, first: usize, what: impl Fn() -> String) -> Result<(), Failure> {
        check_ring(&self.table, first, what)?;
        self.rings.extend(chain(first, self.table.len()));
        let is_outer = std::mem::take(&mut self.begins_polygon);
        self.polygons.push(Ring { end: self.rings.len(), is_outer });
        Ok(())
    }
}

/// Refuses a ring, made of the points from the one with this index to the last, that is too short or not closed.
pub fn check_ring(table: &PointTable, first: usize, what: impl Fn() -> String) -> Result<(), Failure> {
    let count = table.len() - first;
    if count < 4 {
        let count = counted(count, "point");
        return Err(Failure::input(format!(
            "{} has a ring of {count}: a ring needs four or more, of which the last repeats the first",
            what()
        )));
    }
    let place = |index: usize| [0, 1].map(|axis| table.coordinate(index, axis));
    let [from, to] = [place(first), place(table.len() - 1)];
    if from == to {
        return Ok(());
    }
    Err(Failure::input(format!(
        "{} has a ring that is not closed: it begins at ({}, {}) and ends at ({}, {}); repeat the first point at its end",
        what(),
        from[0],
        from[1],
        to[0],
        to[1]
    )))
}

/// The pairs of consecutive indices from the first to before the end.
fn chain(first: usize, end: usize) -> impl Iterator<Item = [u32; 2]> {
    (first as u32..end as u32).zip(first as u32 + 1..end as u32).map(|(from, to)| [from, to])
}
