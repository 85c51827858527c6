//! The core's ends of the two streams of words: blocks that take commands and blocks that send answers. The serial and
//! the stream link lie outside them.
//!
//! ```text
//! command words -> CommandPort -> vertex memory, engine
//! answers <- Responder <- RecordReads <- triangle memory
//! ```
//! `RecordWords` makes the words of a `Read`; `VertexPacker` and `VertexStream` make those of a `Triangles`.

mod answer_head;
mod answer_words;
mod channels;
mod clear_command;
mod command_gate;
mod command_port;
mod payload_words;
mod point_slot;
mod record_buffer;
mod record_reads;
mod record_words;
mod responder;
pub mod types;
mod vertex_packer;
mod vertex_stream;

pub use answer_head::AnswerHead;
pub use answer_words::AnswerWords;
pub use channels::{AnswerSink, AnswerSource, CommandSink, CommandSource};
pub use clear_command::ClearCommand;
pub use command_gate::CommandGate;
pub use command_port::CommandPort;
pub use payload_words::PayloadWords;
pub use point_slot::PointSlot;
pub use record_buffer::RecordBuffer;
pub use record_reads::RecordReads;
pub use record_words::RecordWords;
pub use responder::{AnswerState, Responder};
pub use types::{AnswerBeat, CommandState, WordPair, ANSWER_BEAT_BITS, WORD_PAIR_BITS};
pub use vertex_packer::VertexPacker;
pub use vertex_stream::VertexStream;
