//! The bundles of signals that pass between the blocks of a chip of several engines.

use crate::commands::types::Word;
use rust_hdl_core::prelude::*;

crate::packed! {
    /// A flag for each engine.
    pub struct EngineFlags {
        pub engine0: bool,
        pub engine1: bool,
        pub engine2: bool,
        pub engine3: bool,
    }

    /// One or two words of an answer, with their marks, as an engine offers them.
    pub struct OfferedBeat {
        pub data: Bits<64>,
        pub both: bool,
        pub last: bool,
    }

    /// A word on its way to an engine.
    pub struct RoutedWord {
        pub word: Word,
        /// The word is the first of a command.
        pub begins: bool,
    }
}
