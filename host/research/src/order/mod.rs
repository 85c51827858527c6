//! Orders of insertion from the literature.
//!
//! There are twelve curves, alone and in rounds of growing random samples (Amenta, Choi, Rote, *Incremental
//! constructions con BRIO*, 2003; Buchin, *Constructing Delaunay triangulations along space-filling curves*, 2009), and
//! rounds with guides (Buchin and Mulzer, *Delaunay triangulations in O(sort(n)) time and more*, 2011). The product has
//! four of these orders, in `incircle::Order`.

mod adaptive;
mod alpha;
mod brio;
mod brio_dc;
mod curve;
#[cfg(test)]
mod drawing;
mod kind;
mod median;
mod morton;
mod peano;
mod pieces;
mod sierpinski;
mod square;
mod squarified;
#[cfg(test)]
mod tests;

pub use alpha::Alpha;
pub use brio::{brio, brio_rounds};
pub use brio_dc::{brio_dc, BrioDc, Guided};
pub use curve::Curve;
pub use kind::Order;
