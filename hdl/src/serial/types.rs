//! What travels between the blocks of the serial link.

use rust_hdl_core::prelude::*;

/// A byte of the line, of a frame or of a header.
pub type Byte = Bits<8>;
/// Rate of the line: a bit takes `2^24 / step` clocks.
pub type Step = Bits<22>;

crate::packed! {
    /// The header of a frame of a host.
    pub struct FrameHead {
        pub session: Byte,
        pub kind: Byte,
        pub number: Byte,
        /// Bytes of the payload.
        pub length: Bits<11>,
    }

    /// The session.
    pub struct Session {
        /// A session is open; its number, or 0.
        pub is_open: bool,
        pub number: Byte,
        /// Number of the `Data` frame that is awaited.
        pub expected: Byte,
    }

    /// What a host may send, and what has come of it.
    pub struct Receipt {
        /// Bytes of the receive FIFO that are free.
        pub free: Bits<16>,
        /// State of the check sum of the session's payload.
        pub digest: Bits<32>,
    }

    /// What a frame to the host has behind its header.
    pub struct Contents {
        pub has_greeting: bool,
        pub has_digest: bool,
        pub has_answer: bool,
        /// The last words of an answer are in it, and a digest behind them.
        pub ends_answer: bool,
    }

    /// A byte of a frame to the host.
    pub struct BytePlace {
        /// Part of the frame: 0 header, 1 greeting, 2 digest, 3 head of an answer, 4 words, 5 check sum.
        pub part: Bits<3>,
        /// Byte of that part.
        pub index: Bits<6>,
    }

    /// A part of an answer that fits a frame.
    pub struct AnswerPlace {
        /// Answers that have been sent to their end.
        pub number: Byte,
        /// The part's first word, divided by 256.
        pub part: Byte,
    }

    /// For lamps.
    pub struct Lamps {
        /// A beat, or steady in a session.
        pub alive: bool,
        /// A command is under way.
        pub busy: bool,
        /// A frame was dropped in this session.
        pub error: bool,
    }
}
