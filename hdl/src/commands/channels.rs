//! The two streams of the core. A word on offer stays until an edge with `valid` and `ready`, at which it is taken.

use super::types::Word;
use rust_hdl_core::prelude::*;

/// A stream of command words into a block.
#[derive(LogicInterface, Default)]
#[join = "CommandSource"]
pub struct CommandSink {
    pub valid: Signal<In, Bit>,
    pub ready: Signal<Out, Bit>,
    pub data: Signal<In, Word>,
}

/// A stream of command words out of a block.
#[derive(LogicInterface, Default)]
#[join = "CommandSink"]
pub struct CommandSource {
    pub valid: Signal<Out, Bit>,
    pub ready: Signal<In, Bit>,
    pub data: Signal<Out, Word>,
}

/// A stream of answer words into a block, one or two words at a time.
#[derive(LogicInterface, Default)]
#[join = "AnswerSource"]
pub struct AnswerSink {
    pub valid: Signal<In, Bit>,
    pub ready: Signal<Out, Bit>,
    /// A word in bits 31 to 0; with `both`, the next word in bits 63 to 32.
    pub data: Signal<In, Bits<64>>,
    pub both: Signal<In, Bit>,
    /// The last word of an answer is among the words on offer.
    pub last: Signal<In, Bit>,
}

/// A stream of answer words out of a block, with the signals of [`AnswerSink`].
#[derive(LogicInterface, Default)]
#[join = "AnswerSink"]
pub struct AnswerSource {
    pub valid: Signal<Out, Bit>,
    pub ready: Signal<In, Bit>,
    pub data: Signal<Out, Bits<64>>,
    pub both: Signal<Out, Bit>,
    pub last: Signal<Out, Bit>,
}
