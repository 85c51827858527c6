//! The blocks of `hdl/src/engine/seed`.

mod seed_writes;
mod seeder;
