//! What goes into the core before a clock edge, and what comes out of it.

use super::memory::Write;

/// What drives the core before a clock edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inputs {
    /// Synchronous reset, active high.
    pub reset: bool,
    /// A command word is offered.
    pub command_valid: bool,
    /// The word.
    pub command_data: u32,
    /// The host takes an answer word.
    pub response_ready: bool,
}

/// What the core shows before a clock edge. All outputs are functions of registers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Outputs {
    /// The core takes a command word.
    pub command_ready: bool,
    /// An answer word is offered, or two.
    pub response_valid: bool,
    /// The word in the low half, the one that follows it in the high; holds the last while none is offered.
    pub response_data: u64,
    /// There is one that follows it.
    pub response_both: bool,
    /// The last word of the answer is among them.
    pub response_last: bool,
    /// The write port of the triangle memory (simulation builds).
    pub write: Write,
}

impl Outputs {
    /// The answer words that are offered, in their order.
    pub fn answer_words(&self) -> impl Iterator<Item = u32> {
        let words = usize::from(self.response_valid) * (1 + usize::from(self.response_both));
        [self.response_data as u32, (self.response_data >> 32) as u32].into_iter().take(words)
    }
}
