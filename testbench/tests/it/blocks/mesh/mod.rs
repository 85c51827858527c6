//! Tests of the blocks in `hdl/src/mesh`.

mod lock_store;
mod triangle_store;
mod vertex_store;
