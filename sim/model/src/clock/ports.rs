//! The root ports of the core: inputs before a clock edge, and outputs.

use super::memory::Write;

/// The inputs of the core before a clock edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inputs {
    /// Synchronous reset, active high.
    pub reset: bool,
    /// Whether a command word is offered.
    pub command_valid: bool,
    /// The command word that is offered.
    pub command_data: u32,
    /// Whether the host takes an answer word.
    pub response_ready: bool,
}

/// The outputs of the core before a clock edge. All of them are functions of registers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Outputs {
    /// Whether the core takes a command word.
    pub command_ready: bool,
    /// Whether one or two answer words are offered.
    pub response_valid: bool,
    /// The offered word in the low half, and the word that follows it in the high half. While no word is offered,
    /// the last value stays.
    pub response_data: u64,
    /// Whether the high half holds a word.
    pub response_both: bool,
    /// Whether the last word of the answer is among the offered ones.
    pub response_last: bool,
    /// The write port of the triangle memory, which only simulation builds have.
    pub write: Write,
}

impl Outputs {
    /// The answer words that are offered, in their order.
    pub fn answer_words(&self) -> impl Iterator<Item = u32> {
        let words = usize::from(self.response_valid) * (1 + usize::from(self.response_both));
        [self.response_data as u32, (self.response_data >> 32) as u32].into_iter().take(words)
    }
}
