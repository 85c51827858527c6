//! The signals that travel between the blocks of the engine, as structs.
//!
//! All widths are those of the largest core: ids of 15 bits, ring entries of 6. The memories of smaller configurations
//! store fewer bits and return zeros above them, so synthesis removes the rest.

mod attempts;
mod commits;
mod contexts;
mod events;
mod holes;
mod visits;
mod widths;
mod writes;

pub use attempts::*;
pub use commits::*;
pub use contexts::*;
pub use events::*;
pub use holes::*;
pub use visits::*;
pub use widths::*;
pub use writes::*;
