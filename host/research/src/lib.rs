//! Orders of insertion from the literature, with measurements of their costs and gains.
//!
//! The product inserts points in one of four orders, because none of the others is faster on the whole. This package
//! has all orders that were tried: twelve [curves](order::Curve), alone and in rounds of three sizes, rounds with
//! [guides](order::brio_dc()). All are measured on the software model, and in cycles of the largest core.
//!
//! The package also compares the mesh that lives, constrained meshes and values between points with those of other
//! libraries, and ways to fill the hole of a vertex that is deleted. It counts the cycles of questions and changes on
//! the core's living engine, and of features that a camera tracks on the core with runs.
//!
//! Nothing here ships with the product. `cargo run --release -p incircle-research -- figures` makes
//! all published figures again.
#![warn(missing_docs)]

pub mod assembly;
pub mod compare;
mod figures;
mod guided;
mod holes;
pub mod job;
mod living;
pub mod order;
mod orders;
mod picture;
mod plans;
pub mod prepare;
mod runs;
mod tracks;
mod values;

pub use figures::{figures, FiguresArguments};
pub use guided::{GuidedMesh, RING_CAPACITY};
pub use holes::{holes, HolesArguments};
pub use living::{living, LivingArguments};
pub use orders::{orders, Failure, OrdersArguments};
pub use picture::{picture, PictureArguments};
pub use plans::{plans, PlansArguments};
pub use runs::{runs, RunsArguments};
pub use tracks::{tracks, TracksArguments};
pub use values::{values, ValuesArguments};
