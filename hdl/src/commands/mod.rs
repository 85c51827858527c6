//! The core's ends of the two streams of words: blocks that take commands and blocks that send answers. The serial and
//! the stream link lie outside them.
//!
//! ```text
//! command words -> CommandPort -> vertex memory, engine
//! answers <- Responder <- RecordReads <- triangle memory
//! ```
//! `RecordHalves`, `RecordGroup`, `KeptHalves`, `RecordPacker` and `RecordStream` make the words of a `Read` and of a
//! `Triangles`.

mod answer_head;
mod answer_words;
mod channels;
mod clear_command;
mod command_gate;
mod command_port;
mod kept_halves;
mod living_reads;
mod living_tally;
mod payload_words;
mod point_slot;
mod read_range;
mod record_group;
mod record_halves;
mod record_packer;
mod record_reads;
mod record_stream;
mod responder;
pub mod types;

pub use answer_head::AnswerHead;
pub use answer_words::AnswerWords;
pub use channels::{AnswerSink, AnswerSource, CommandSink, CommandSource};
pub use clear_command::ClearCommand;
pub use command_gate::CommandGate;
pub use command_port::CommandPort;
pub use kept_halves::{KeptHalves, KeptNumber};
pub use living_reads::LivingReads;
pub use living_tally::LivingTally;
pub use payload_words::PayloadWords;
pub use point_slot::PointSlot;
pub use read_range::ReadRange;
pub use record_group::RecordGroup;
pub use record_halves::RecordHalves;
pub use record_packer::RecordPacker;
pub use record_reads::RecordReads;
pub use record_stream::RecordStream;
pub use responder::{AnswerState, Responder};
pub use types::{AnswerBeat, CommandState, WordPair, ANSWER_BEAT_BITS, WORD_PAIR_BITS};
