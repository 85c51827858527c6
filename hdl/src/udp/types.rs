//! The bundles of signals that pass between the blocks of the UDP link.

use rust_hdl_core::prelude::*;

/// Index of a byte in a datagram with the 12 bytes of its sender or receiver before it.
pub type ByteIndex = Bits<11>;
/// Index of a byte before the words: 12 bytes of addresses, then the 16 bytes of the header.
pub type HeadIndex = Bits<5>;

/// Number of bits of an [`AnswerEntry`].
pub(super) const ANSWER_ENTRY_BITS: usize = 66;

crate::packed! {
    /// The facts that the bytes of a datagram show by themselves, valid when the datagram ends.
    pub struct DatagramVerdict {
        /// The Ethernet port found the datagram right and for this device.
        pub counts: bool,
        /// The check sum is right, and the length is one of whole words; only if `counts` is high.
        pub is_sound: bool,
        /// The datagram came to all devices.
        pub is_to_all: bool,
        /// The number of words behind the header is 0 (`is_bare`), 14 (`is_greeting`) or 1 to 360 (`is_data`).
        pub is_bare: bool,
        pub is_greeting: bool,
        pub is_data: bool,
    }

    /// The beginning of a datagram, compared with what the session awaits.
    pub struct DatagramHead {
        pub kind: Bits<8>,
        /// Sender and session are those of the session that was opened last.
        pub is_of_session: bool,
        /// The session that the datagram names is not 0.
        pub names_session: bool,
        /// The number is the one that is awaited; it is smaller than that.
        pub is_next: bool,
        pub is_less: bool,
    }

    /// The request of a datagram, valid for one clock.
    pub struct DatagramAsks {
        /// A datagram of the open session has come, so its host is there.
        pub hears: bool,
        /// An answer of kind `8x` takes the one place, x being `reply`.
        pub replies: bool,
        pub reply: Bits<4>,
        /// A session begins; the open session ends.
        pub opens: bool,
        pub closes: bool,
        /// A `Poll` of the open session.
        pub polls: bool,
        /// A `Data` whose words the device takes.
        pub takes: bool,
        /// A `Data` that the device has taken before.
        pub repeats: bool,
        /// A `Data` behind a gap, or one for which the FIFO has no room.
        pub gap: bool,
        /// A datagram that the device drops: damaged, of an unknown kind, of a wrong length, or an `Open` of session 0.
        pub drops: bool,
    }

    /// The state of the session.
    pub struct UdpSession {
        pub is_open: bool,
        /// Number of the `Data` datagram that the device awaits, 0 without a session.
        pub expected: Bits<32>,
    }

    /// The state of the device that the header of a datagram and a receipt carry.
    pub struct DatagramState {
        /// A session is open, and the number of the `Data` datagram that it awaits.
        pub is_open: bool,
        pub expected: Bits<32>,
        /// Free words of the receive FIFO.
        pub free: Bits<16>,
        /// A command is under way.
        pub is_busy: bool,
        /// State of the check sum over all words of the session.
        pub digest: Bits<32>,
    }

    /// One or two words of an answer on their way from the core to the link, as the core offers them.
    pub struct AnswerEntry {
        pub data: Bits<64>,
        pub both: bool,
        pub last: bool,
    }

    /// The place of a byte in a datagram to the host.
    pub struct PartIndex {
        /// Part of the datagram: 0 receiver and header, 1 greeting, 2 digest, 3 number of answers, 4 words, 5 check
        /// sum, 6 index of the first word, 7 digest of an answer.
        pub part: Bits<3>,
        /// Index of the byte in the datagram. It wraps in the words of an answer.
        pub index: Bits<7>,
    }
}
