//! Tests of the blocks in `hdl/src/commands`.

mod answer_head;
mod answer_words;
mod clear_command;
mod command_gate;
mod command_port;
mod point_slot;
mod record_halves;
mod record_packer;
mod record_reads;
mod record_stream;
mod responder;
