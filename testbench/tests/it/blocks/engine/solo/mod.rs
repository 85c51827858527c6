//! The blocks of `hdl/src/engine/solo`.

mod solo;
mod solo_visit;
mod solo_writes;
