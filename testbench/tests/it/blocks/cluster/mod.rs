//! Tests of the blocks between the streams and the engines of a chip.

mod answer_collector;
mod command_queue;
mod engine_choice;
mod job_router;
mod word_place;
