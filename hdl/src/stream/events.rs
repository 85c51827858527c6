//! The events on the two streams that the registers of the stream link count or remember.

use crate::commands::types::Word;
use rust_hdl_core::prelude::*;

crate::packed! {
    /// The events of a command beat, one clock later.
    pub struct CommandEvents {
        /// The beat was taken.
        pub took: bool,
        /// The beat had to wait.
        pub waited: bool,
        /// The beat lacked bytes: the gate took and dropped it.
        pub dropped: bool,
    }

    /// The events of an answer beat, one clock later.
    pub struct AnswerEvents {
        /// The beat was taken.
        pub took: bool,
        /// The beat had to wait.
        pub waited: bool,
        /// The beat was taken, and was the last one of its answer.
        pub ended: bool,
        /// The beat was taken, and was the first one of an answer with a status other than `Ok`.
        pub failed: bool,
        /// The header word of that answer.
        pub header: Word,
    }
}
