//! Tests of the blocks in `hdl/src/engine/holes`.

mod hole_fill;
mod hole_merge;
mod hole_records;
mod kept_edges;
mod late_point;
mod moved_vertex;
