//! What passes at one edge of the answer stream.

use rust_hdl_core::prelude::*;

crate::packed! {
    /// One or two words of an answer.
    pub struct AnswerBeat {
        /// The word.
        pub low: Bits<32>,
        /// The one that follows it.
        pub high: Bits<32>,
        /// There is one.
        pub both: bool,
        /// The last word of an answer is among them.
        pub last: bool,
    }

    /// The same as data alone.
    pub struct WordPair {
        /// The word.
        pub low: Bits<32>,
        /// The one that follows it, if one does.
        pub high: Bits<32>,
    }
}

/// Bits of [`AnswerBeat`].
pub const ANSWER_BEAT_BITS: usize = AnswerBeat::BITS;
/// Bits of [`WordPair`].
pub const WORD_PAIR_BITS: usize = WordPair::BITS;
