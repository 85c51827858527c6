//! The bundles of signals that pass between the blocks of the serial link.

use rust_hdl_core::prelude::*;

/// A byte of the line, of a frame or of a header.
pub type Byte = Bits<8>;
/// Rate of the line: a bit lasts `2^24 / step` clocks.
pub type Step = Bits<22>;

crate::packed! {
    /// The header of a frame from the host.
    pub struct FrameHead {
        pub session: Byte,
        pub kind: Byte,
        pub number: Byte,
        /// Bytes of the payload, 0 to 1,024.
        pub length: Bits<11>,
    }

    /// The state of the session.
    pub struct Session {
        /// A session is open; `number` is its number, or 0 if none is open.
        pub is_open: bool,
        pub number: Byte,
        /// Number of the `Data` frame that the device awaits.
        pub expected: Byte,
    }

    /// The room in a receive FIFO.
    pub struct FifoRoom {
        /// Free entries, among them the places of entries that do not count yet.
        pub free: Bits<16>,
        /// There is no place for one more entry.
        pub is_full: bool,
    }

    /// The credit of the host, and the digest of the payload that the device has taken.
    pub struct Receipt {
        /// Free bytes of the receive FIFO.
        pub free: Bits<16>,
        /// State of the check sum over the payload of the session.
        pub digest: Bits<32>,
    }

    /// The parts of a frame to the host that follow its header.
    pub struct Contents {
        pub has_greeting: bool,
        pub has_digest: bool,
        pub has_answer: bool,
        /// The frame holds the last words of an answer, and the digest of the answer behind them.
        pub ends_answer: bool,
    }

    /// The place of a byte in a frame to the host.
    pub struct BytePlace {
        /// Part of the frame: 0 header, 1 greeting, 2 digest, 3 head of an answer, 4 words, 5 check sum.
        pub part: Bits<3>,
        /// Index of the byte in its part.
        pub index: Bits<6>,
    }

    /// The place of a part of an answer, a part being what fits in one frame.
    pub struct AnswerPlace {
        /// Number of the answers that have been sent to their end, modulo 256.
        pub number: Byte,
        /// Index of the part's first word in the answer, divided by 256.
        pub part: Byte,
    }

    /// The lamps of a board; each is lit while its field is high.
    pub struct Lamps {
        /// Blinks while no session is open, and is steady while one is.
        pub alive: bool,
        /// A command is under way.
        pub busy: bool,
        /// A frame was dropped in this session.
        pub error: bool,
    }
}
