//! The queue of command words before an engine.
//!
//! Hardware twin: the block `CommandQueue`.

use incircle_protocol::ENGINE_QUEUE_WORDS;
use std::collections::VecDeque;

#[derive(Clone, Debug, Default)]
pub(super) struct CommandQueue {
    /// The words, oldest first, without the one that came last.
    words: VecDeque<u32>,
    /// The word that came at the edge before. It is on offer only if no other word waits.
    came: Option<u32>,
}

impl CommandQueue {
    pub(super) fn has_room(&self) -> bool {
        self.words.len() + usize::from(self.came.is_some()) < ENGINE_QUEUE_WORDS
    }

    /// The word that the engine is offered.
    pub(super) fn offered(&self) -> Option<u32> {
        self.words.front().copied().or(self.came)
    }

    /// Simulates one clock, in which a word may be pushed, and the word on offer be taken.
    pub(super) fn clock(&mut self, pushed: Option<u32>, is_taken: bool) {
        self.words.extend(self.came);
        if is_taken {
            self.words.pop_front();
        }
        self.came = pushed;
    }
}
