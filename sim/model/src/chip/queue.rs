//! The queue of command words before an engine.
//!
//! Hardware twin: the block `CommandQueue`.

use incircle_protocol::ENGINE_QUEUE_WORDS;

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CommandQueue {
    words: [u32; ENGINE_QUEUE_WORDS],
    /// The word that came at the edge before, and is not on offer yet if the queue was empty.
    came: Option<u32>,
    /// Place of the oldest word, and number of words, without the one that came.
    oldest: usize,
    count: usize,
}

impl CommandQueue {
    pub(super) fn has_room(&self) -> bool {
        self.count + usize::from(self.came.is_some()) < ENGINE_QUEUE_WORDS
    }

    /// The word that the engine is offered.
    pub(super) fn offered(&self) -> Option<u32> {
        if self.count == 0 {
            return self.came;
        }
        Some(self.words[self.oldest])
    }

    /// Simulates one clock, in which a word may be pushed, and the word on offer be taken.
    pub(super) fn clock(&mut self, pushed: Option<u32>, is_taken: bool) {
        if let Some(word) = self.came {
            self.words[(self.oldest + self.count) % ENGINE_QUEUE_WORDS] = word;
            self.count += 1;
        }
        if is_taken {
            self.oldest = (self.oldest + 1) % ENGINE_QUEUE_WORDS;
            self.count -= 1;
        }
        self.came = pushed;
    }
}
