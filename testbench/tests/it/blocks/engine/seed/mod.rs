//! Tests of the blocks in `hdl/src/engine/seed`.

mod seed_writes;
mod seeder;
