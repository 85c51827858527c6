//! A card that lies: in its registers, and in the words of its answers.

use incircle_protocol::{answer_header, answer_opcode, Opcode, Status, StreamRegister};

/// The lie that a card tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CardLie {
    /// The registers do not begin with the letters of the project.
    Magic,
    /// The registers claim another major version of the stream link.
    Stream,
    /// The registers claim another major version of the protocol.
    Protocol,
    /// The registers claim a capacity of 2^32 - 1 points.
    Capacity,
    /// The registers claim a width of beats that does not exist.
    Beat,
    /// The registers claim a capacity other than that of the core's identity.
    Identity,
    /// The report of an insertion counts more points than were sent.
    Report,
    /// A record names a vertex that does not exist.
    Index,
    /// A read-out announces one word fewer than it has.
    Length,
    /// A read-out goes on beyond its end.
    Endless,
    /// Every read-out is refused.
    Status,
}

/// A word with ids that no small job has in any form: 3fe with ids of 10 bits, ffe with those of 12, fbfe and ffef with
/// those of 16, and 7bfe in a whole record. None of them is the infinite vertex.
const NO_VERTEX: u32 = 0xffef_fbfe;

impl CardLie {
    /// The names of all lies, for messages.
    pub const NAMES: &'static str =
        "magic, stream, protocol, capacity, beat, identity, report, index, length, endless or status";

    /// All lies, with their names.
    pub const ALL: [(Self, &'static str); 11] = [
        (Self::Magic, "magic"),
        (Self::Stream, "stream"),
        (Self::Protocol, "protocol"),
        (Self::Capacity, "capacity"),
        (Self::Beat, "beat"),
        (Self::Identity, "identity"),
        (Self::Report, "report"),
        (Self::Index, "index"),
        (Self::Length, "length"),
        (Self::Endless, "endless"),
        (Self::Status, "status"),
    ];

    /// The lie of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|lie| lie.1 == name).map(|lie| lie.0)
    }

    /// The value that a register reads as, given its true value.
    pub(super) fn register(self, offset: u32, value: u32) -> u32 {
        let (register, lie) = match self {
            Self::Magic => (StreamRegister::Magic, 0x6e6f_7065),
            Self::Stream => (StreamRegister::StreamVersion, 2 << 16),
            Self::Protocol => (StreamRegister::ProtocolVersion, 9 << 16),
            Self::Capacity => (StreamRegister::Capacity, u32::MAX),
            Self::Beat => (StreamRegister::BeatBits, 96),
            Self::Identity => (StreamRegister::Capacity, 100_000),
            _ => return value,
        };
        if register.offset() == offset {
            lie
        } else {
            value
        }
    }

    /// Whether the answer to this opcode hides its end.
    pub(super) fn hides_the_end(self, opcode: u8) -> bool {
        self == Self::Endless && is_read_out(opcode)
    }
}

fn is_read_out(opcode: u8) -> bool {
    matches!(Opcode::from_u8(opcode), Some(Opcode::Read | Opcode::Triangles))
}

/// Follows the answers of a card, and changes their words.
#[derive(Debug)]
pub(super) struct Liar {
    lie: Option<CardLie>,
    /// Number of words of the current answer that have passed, and its opcode.
    place: usize,
    pub opcode: u8,
}

impl Liar {
    pub fn new(lie: Option<CardLie>) -> Self {
        Self { lie, place: 0, opcode: 0 }
    }

    /// Changes beats of an answer. `is_end` says that they are its last.
    pub fn change(&mut self, bytes: &mut [u8], is_end: bool) {
        let (begins, ends) = (self.place == 0, is_end);
        let first = bytes.first_chunk().map(|&word| u32::from_le_bytes(word));
        if let (true, Some(header)) = (begins, first) {
            self.opcode = answer_opcode(header);
        }
        if let Some(lie) = self.lie {
            for (place, word) in (self.place..).zip(bytes.chunks_exact_mut(4)) {
                let value = u32::from_le_bytes([word[0], word[1], word[2], word[3]]);
                word.copy_from_slice(&self.word(lie, place, value).to_le_bytes());
            }
        }
        self.place = if ends { 0 } else { self.place + bytes.len() / 4 };
    }

    /// The word at this place of an answer, given its true value.
    fn word(&self, lie: CardLie, place: usize, value: u32) -> u32 {
        let is_read_out = is_read_out(self.opcode);
        match (lie, place) {
            (CardLie::Report, 2) if self.opcode == Opcode::Insert as u8 => 1_000_000,
            (CardLie::Index, 2..5) if is_read_out => NO_VERTEX,
            (CardLie::Length, 1) if is_read_out => value.saturating_sub(1),
            (CardLie::Status, 0) if is_read_out => answer_header(self.opcode, Status::BadRange),
            (CardLie::Status, 1) if is_read_out => 0,
            _ => value,
        }
    }

    /// Expects a new answer next, as after a reset of the card.
    pub fn reset(&mut self) {
        self.place = 0;
    }
}
