//! Tests of the blocks in `hdl/src/engine/write`.

mod write_port;
mod write_request;
