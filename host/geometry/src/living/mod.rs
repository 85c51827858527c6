//! A Delaunay triangulation that lives: it can be asked, and points come, go and move.

mod answer;
mod cavity;
mod change;
mod error;
mod flips;
mod frame;
mod hole;
mod iterate;
mod large_hole;
mod level;
mod line;
mod link;
mod load;
mod names;
mod near;
mod plane;
mod queries;
mod rectangle;
mod segment;
mod star;
mod sweep;
#[cfg(test)]
mod tests;
mod triangulation;
mod walk;

pub use error::Error;
pub use queries::Location;
pub use triangulation::Triangulation;
