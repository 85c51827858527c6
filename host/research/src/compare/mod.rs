//! What orders of insertion cost and save: a table, a CSV file, a drawing, and where the published ranking comes back.

mod drawing;
mod measure;
mod ranking;
mod row;

pub use drawing::draw;
pub use measure::measure;
pub use ranking::ranking;
pub use row::{header, to_csv, Row};
