//! What is read from the memories of the mesh.

use rust_hdl_core::prelude::*;

crate::packed! {
    /// A record as it is stored, and its lock.
    pub struct Record {
        /// Vertices, counter-clockwise.
        pub v0: Bits<15>,
        pub v1: Bits<15>,
        pub v2: Bits<15>,
        /// Links; `n0` is opposite `v0`.
        pub n0: Bits<15>,
        pub n1: Bits<15>,
        pub n2: Bits<15>,
        /// The lock was set.
        pub was_set: bool,
    }
}
