//! The comparison of orders of insertion: a table, a CSV file, a drawing, and the published ranking beside ours.

mod drawing;
mod measure;
mod ranking;
mod row;

pub use drawing::draw;
pub use measure::measure;
pub use ranking::ranking;
pub use row::{header, to_csv, Row};
