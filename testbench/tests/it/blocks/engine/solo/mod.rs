//! Tests of the blocks in `hdl/src/engine/solo`.

#[expect(clippy::module_inception, reason = "the room carries the name of its main block")]
mod solo;
mod solo_visit;
mod solo_writes;
