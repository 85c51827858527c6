//! What passes at one edge of the answer stream.

use super::types::Word;
use rust_hdl_core::prelude::*;

crate::packed! {
    /// One or two words of an answer.
    pub struct AnswerBeat {
        /// The word.
        pub low: Word,
        /// The one that follows it.
        pub high: Word,
        /// The beat has a second word.
        pub both: bool,
        /// The last word of an answer is among them.
        pub last: bool,
    }

    /// The words of a beat, without its marks.
    pub struct WordPair {
        /// The word.
        pub low: Word,
        /// The one that follows it, if one does.
        pub high: Word,
    }
}

/// Bits of [`AnswerBeat`].
pub const ANSWER_BEAT_BITS: usize = AnswerBeat::BITS;
/// Bits of [`WordPair`].
pub const WORD_PAIR_BITS: usize = WordPair::BITS;
