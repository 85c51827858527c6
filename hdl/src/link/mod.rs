//! The command and answer streams.

mod answer_words;
mod command_port;
mod responder;

pub use answer_words::AnswerWords;
pub use command_port::{CommandPort, CommandState};
pub use responder::{AnswerState, Responder};
