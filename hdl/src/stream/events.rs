//! What happened on the two streams in the clock before.

use crate::commands::types::Word;
use rust_hdl_core::prelude::*;

crate::packed! {
    /// A command beat in the clock before.
    pub struct CommandEvents {
        /// The beat was taken.
        pub took: bool,
        /// The beat waited.
        pub waited: bool,
        /// The beat was taken without all its bytes, and dropped.
        pub dropped: bool,
    }

    /// An answer beat in the clock before.
    pub struct AnswerEvents {
        /// The beat was taken.
        pub took: bool,
        /// The beat waited.
        pub waited: bool,
        /// The beat was taken and was the last one of its answer.
        pub ended: bool,
        /// The beat was taken and was the first one of an answer with a status other than `Ok`.
        pub failed: bool,
        /// The header word of that answer.
        pub header: Word,
    }
}
