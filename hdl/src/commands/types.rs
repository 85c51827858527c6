//! The bundles of signals that pass between the blocks of the command and answer streams.

use rust_hdl_core::prelude::*;

/// A word of a command or an answer.
pub type Word = Bits<32>;
/// Half a word.
pub type Half = Bits<16>;
pub type VertexCount = Bits<15>;
pub type RecordCount = Bits<15>;
/// Index of a word in a payload.
pub type WordIndex = Bits<7>;

crate::packed! {
    /// A command with its arguments.
    pub struct Request {
        pub opcode: Bits<8>,
        /// Id of the first record of a read-out.
        pub first: Word,
        /// Number of records of a read-out, or of points that an `Insert` has yet to bring.
        pub count: Word,
        /// A `Triangles` asks for short ids of 10 bits; with `has_rests`, of 12.
        pub has_short_ids: bool,
        pub has_rests: bool,
    }

    /// A word that the core takes from the command stream at this edge.
    pub struct TakenWord {
        pub is_command: bool,
        pub is_point: bool,
        pub word: Word,
    }

    /// The effect of the last `Clear`.
    pub struct Clearing {
        /// Forget the mesh at this edge.
        pub clears: bool,
        /// The numbers of a `Clear` are being checked.
        pub is_checking: bool,
        /// The last command is a `Clear` that asks for more contexts than the core has, or for a number of jobs that
        /// does not divide that of the contexts.
        pub is_refused: bool,
        /// The tag of the last `Clear`, refused or not.
        pub tag: Bits<8>,
    }

    /// Counts of the points since the last `Clear`.
    pub struct Tally {
        /// Number of points that got an id.
        pub arrived: VertexCount,
        /// Number of points that got no id, and whether there are any.
        pub refused: Word,
        pub some_refused: bool,
    }

    /// The activity of the core, for the cycle counters.
    pub struct Activity {
        pub inserting: bool,
        pub reading: bool,
        /// The next word may be a point.
        pub awaits_point: bool,
    }

    /// The first two words of an answer, and the kind of its payload.
    pub struct Head {
        pub header: Word,
        /// Number of words of the payload, and whether there are none.
        pub length: Word,
        pub is_empty: bool,
        /// The payload consists of records (`is_read`); with `is_packed` as well, of their vertices alone.
        pub is_read: bool,
        pub is_packed: bool,
        /// If the payload consists of vertices: with short ids of 10 bits; with `has_rests`, of 12.
        pub has_short_ids: bool,
        pub has_rests: bool,
    }

    /// The state of an answer.
    pub struct AnswerProgress {
        /// No answer is under way.
        pub is_idle: bool,
        /// The last word of the answer is loaded into the output at this edge.
        pub ends: bool,
        /// The output holds no word, or its word is taken at this edge.
        pub is_taken: bool,
    }

    /// One or two words of an answer, with their marks.
    pub struct AnswerBeat {
        /// The first word, and the word that follows it.
        pub low: Word,
        pub high: Word,
        /// The beat has two words.
        pub both: bool,
        /// The beat holds the last word of its answer.
        pub last: bool,
    }

    /// The halves that a record of a read-out brings, in their order in the answer.
    pub struct Halves {
        pub half0: Half,
        pub half1: Half,
        pub half2: Half,
        pub half3: Half,
        pub half4: Half,
        pub half5: Half,
    }

    /// The halves of a beat, in their order in the answer.
    pub struct BeatHalves {
        pub half0: Half,
        pub half1: Half,
        pub half2: Half,
        pub half3: Half,
    }

    /// The words of a beat without the marks.
    pub struct WordPair {
        pub low: Word,
        pub high: Word,
    }
}

/// Number of bits of an [`AnswerBeat`].
pub const ANSWER_BEAT_BITS: usize = AnswerBeat::BITS;
/// Number of bits of a [`WordPair`].
pub const WORD_PAIR_BITS: usize = WordPair::BITS;

/// The meaning of the next command word, or the event that the port awaits.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum CommandState {
    /// The next word is a command.
    Command,
    /// The next word is the id of the first record of a read-out.
    First,
    /// The next word is the number of records or of points.
    Count,
    /// The next word is a point.
    Points,
    /// The insertion engine has to finish all points.
    Settle,
    /// The answer has to be sent.
    Answer,
}
