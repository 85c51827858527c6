//! Tests of the blocks in `hdl/src/stream`.

mod answer_beats;
mod answer_pairs;
mod answer_watch;
mod async_fifo;
mod beat_gate;
mod beat_words;
mod command_under_way;
mod register_block;
mod register_port;
mod reset_reply;
mod reset_request;
mod stream_link;
