//! The C interface of incircle. The header `include/incircle.h` is made of these files, and documents every call.
//!
//! `border` is the only module that reads and writes memory of the caller; `status` keeps the text of the last error.
//! `mesh` has the functions for meshes of sets, `constrained` those for constraints, `living` those for the mesh that
//! lives, `questions` and `answers` its questions whose answers are lists, `diagram` those for Voronoi cells, `lloyd`
//! those for points spread evenly, and `surface` those for values between points. `grid` lays points onto a grid for
//! cells.

mod answers;
mod border;
mod constrained;
mod diagram;
mod grid;
mod living;
mod lloyd;
mod mesh;
mod questions;
mod status;
mod surface;

pub use constrained::*;
pub use diagram::*;
pub use grid::*;
pub use living::*;
pub use lloyd::*;
pub use mesh::*;
pub use questions::*;
pub use status::*;
pub use surface::*;
