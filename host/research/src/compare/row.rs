//! A row of figures: one line of the table and of the CSV file.

use std::fmt::Write as _;

use incircle_protocol::LARGE;
use incircle_testkit::Distribution;

use crate::order::Order;

/// The figures of one order of insertion on one set.
pub struct Row {
    /// The set of points.
    pub set: Distribution,
    /// Number of points in the set, duplicates included.
    pub asked: usize,
    /// Number of distinct points.
    pub points: usize,
    /// The order of insertion.
    pub order: Order,
    /// Nanoseconds per point to put the points in order.
    pub order_ns: f64,
    /// Nanoseconds per point of the whole job on the software model: order, insertions with the guides of the order if
    /// there are any, canonical form.
    pub total_ns: f64,
    /// Triangles that the walk of an insertion visits, on average.
    pub walk: f64,
    /// Conflict tests of an insertion, on average.
    pub tests: f64,
    /// Triangles that an insertion removes, on average.
    pub cavity: f64,
    /// Cycles of an insertion on the largest core, which takes no guides; `None` for a set that the core does not
    /// hold.
    pub cycles: Option<f64>,
}

/// The columns of the CSV file.
const COLUMNS: &str = "set,points,order,order_ns,total_ns,walk,tests,cavity,cycles";

/// The lines above the table.
pub fn header(coord_bits: u32, seed: u64) -> String {
    format!(
        "{} bits, seed {}; ns per point to order, and in all on the software model; per insertion: triangles walked, \
         tests, triangles removed, cycles of the core {}, which takes no guides\n\
         {:<15}{:>9}  {:<36}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n",
        coord_bits, seed, LARGE.name, "set", "points", "order", "order", "in all", "walk", "tests", "cavity", "cycles"
    )
}

impl Row {
    /// The row as a line of the table.
    pub fn line(&self) -> String {
        let cycles = self.cycles.map_or_else(|| "-".to_owned(), |cycles| format!("{cycles:.2}"));
        format!(
            "{:<15}{:>9}  {:<36}{:>9.1}{:>9.1}{:>9.2}{:>9.2}{:>9.2}{cycles:>9}\n",
            self.set.to_string(),
            self.points,
            self.order.name(),
            self.order_ns,
            self.total_ns,
            self.walk,
            self.tests,
            self.cavity
        )
    }
}

/// The text of the CSV file with all rows.
pub fn to_csv(rows: &[Row]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for row in rows {
        let Row { set, points, order, order_ns, total_ns, walk, tests, cavity, cycles, .. } = row;
        let (name, cycles) = (order.name(), cycles.map_or_else(String::new, |cycles| cycles.to_string()));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{set},{points},{name},{order_ns},{total_ns},{walk},{tests},{cavity},{cycles}");
    }
    text
}
