//! A Delaunay triangulation that lives: it can be asked, and points come, go and move.

mod answer;
mod cavity;
mod change;
mod error;
mod flips;
mod hole;
mod level;
mod line;
mod link;
mod load;
mod names;
mod plane;
mod queries;
mod star;
#[cfg(test)]
mod tests;
mod triangulation;
mod walk;

pub use error::ChangeError;
pub use queries::Location;
pub use triangulation::Triangulation;
