//! Tests of the blocks in `hdl/src/engine/holes`.

mod hole_fill;
mod hole_records;
