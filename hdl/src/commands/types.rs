//! What travels between the blocks of the command and answer streams.

use rust_hdl_core::prelude::*;

/// A word of a command or an answer.
pub type Word = Bits<32>;
/// A count of vertices.
pub type VertexCount = Bits<15>;
/// A count of records.
pub type RecordCount = Bits<15>;
/// Number of a word of a payload.
pub type WordIndex = Bits<7>;

crate::packed! {
    /// A command and its arguments.
    pub struct Request {
        pub opcode: Bits<8>,
        /// First record of a read.
        pub first: Word,
        /// Records of a read; points of an insert that are still to come.
        pub count: Word,
    }

    /// A command word that is taken.
    pub struct TakenWord {
        pub is_command: bool,
        pub is_point: bool,
        pub word: Word,
    }

    /// The effect of the last `Clear`.
    pub struct Clearing {
        /// Forget the mesh at this edge.
        pub clears: bool,
        /// The last command is a `Clear` that asks for more contexts than there are.
        pub is_refused: bool,
    }

    /// Counts of points since the last `Clear`.
    pub struct Tally {
        /// Points that were given an id.
        pub arrived: VertexCount,
        /// Points that were not, and whether there are some.
        pub refused: Word,
        pub some_refused: bool,
    }

    /// Activity for the cycle counters.
    pub struct Activity {
        pub inserting: bool,
        pub reading: bool,
        /// A point may come.
        pub awaits_point: bool,
    }

    /// An answer's first two words, and what its payload consists of.
    pub struct Head {
        pub header: Word,
        /// Words of the payload, and whether there are none.
        pub length: Word,
        pub is_empty: bool,
        /// The payload consists of records, or of their vertices alone (both are set then).
        pub is_read: bool,
        pub is_packed: bool,
    }

    /// The progress of an answer.
    pub struct AnswerProgress {
        /// No answer is under way.
        pub is_idle: bool,
        /// The last word of the answer is loaded at this edge.
        pub ends: bool,
        /// No word waits, or it is taken.
        pub is_taken: bool,
    }

    /// One or two words of an answer.
    pub struct AnswerBeat {
        /// The word, and the one that follows it.
        pub low: Word,
        pub high: Word,
        /// The beat has a second word.
        pub both: bool,
        /// The last word of an answer is among them.
        pub last: bool,
    }

    /// The words of a beat, without its marks.
    pub struct WordPair {
        pub low: Word,
        pub high: Word,
    }
}

/// Bits of [`AnswerBeat`].
pub const ANSWER_BEAT_BITS: usize = AnswerBeat::BITS;
/// Bits of [`WordPair`].
pub const WORD_PAIR_BITS: usize = WordPair::BITS;

/// What the next word means, or what is awaited.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum CommandState {
    /// A command.
    Command,
    /// The first id of a read.
    First,
    /// The number of records or points.
    Count,
    /// Points.
    Points,
    /// The engine finishes.
    Settle,
    /// The answer is sent.
    Answer,
}
