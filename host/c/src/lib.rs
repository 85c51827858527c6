//! The C interface of incircle. The header `include/incircle.h` is made of these files, and documents every call.
//!
//! `border` is the only module that reads and writes memory of the caller; `status` keeps the text of the last error.
//! `mesh` has the functions for meshes of sets, and `living` those for the mesh that lives.

mod border;
mod living;
mod mesh;
mod status;

pub use living::*;
pub use mesh::*;
pub use status::*;
