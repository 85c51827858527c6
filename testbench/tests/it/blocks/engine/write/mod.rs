//! The blocks of `hdl/src/engine/write`.

mod write_port;
mod write_request;
