//! The two streams of the core. What is offered stays until an edge with `valid` and `ready`, at which it is taken.

use super::types::Word;
use rust_hdl_core::prelude::*;

/// Command words that a block takes.
#[derive(LogicInterface, Default)]
#[join = "CommandSource"]
pub struct CommandSink {
    pub valid: Signal<In, Bit>,
    pub ready: Signal<Out, Bit>,
    pub data: Signal<In, Word>,
}

/// Command words that a block gives.
#[derive(LogicInterface, Default)]
#[join = "CommandSink"]
pub struct CommandSource {
    pub valid: Signal<Out, Bit>,
    pub ready: Signal<In, Bit>,
    pub data: Signal<Out, Word>,
}

/// Answer words that a block takes, one or two at a time.
#[derive(LogicInterface, Default)]
#[join = "AnswerSource"]
pub struct AnswerSink {
    pub valid: Signal<In, Bit>,
    pub ready: Signal<Out, Bit>,
    /// A word in bits 31 to 0. With `both` the word that follows it is in bits 63 to 32.
    pub data: Signal<In, Bits<64>>,
    pub both: Signal<In, Bit>,
    /// The last word of its answer is among them.
    pub last: Signal<In, Bit>,
}

/// Answer words that a block gives, as in [`AnswerSink`].
#[derive(LogicInterface, Default)]
#[join = "AnswerSink"]
pub struct AnswerSource {
    pub valid: Signal<Out, Bit>,
    pub ready: Signal<In, Bit>,
    pub data: Signal<Out, Bits<64>>,
    pub both: Signal<Out, Bit>,
    pub last: Signal<Out, Bit>,
}
