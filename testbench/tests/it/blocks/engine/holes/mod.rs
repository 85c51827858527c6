//! Tests of the blocks in `hdl/src/engine/holes`.

mod hole_fill;
mod hole_records;
mod kept_edges;
mod moved_vertex;
