//! Code that several tests share: a core that is driven by command words, and the check of a mesh.

pub mod batches;
pub mod bench;
pub mod living;
pub mod mesh_check;
pub mod sphere;

pub use incircle_testkit::{words as sets, Random32 as Random};
