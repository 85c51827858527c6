//! Tests of the blocks in `hdl/src/engine`.

mod attempt;
mod commit;
mod count;
mod dispatch;
mod holes;
mod seed;
mod solo;
mod visit;
mod write;
