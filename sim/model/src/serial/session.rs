//! A session of the serial link: numbers of frames, and the parts of answers that frames carry.
//!
//! Hardware twin: the answer packer of `hdl/src/serial/`.

use incircle_protocol::{ANSWER_HEADER_BYTES, MAX_PAYLOAD};

use super::frame::FromHost;
use crate::link::{Flow, Taken};

/// Largest distance behind the expected number at which a number counts as old.
const OLD: u8 = 128;
/// Largest number of answer words in a frame.
const FRAME_WORDS: u64 = (MAX_PAYLOAD / 4) as u64;
/// Number of answer words that may wait for the line.
const WAITING: usize = 16;

/// The part of an answer that one frame carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Part {
    /// The bytes before the words.
    pub header: [u8; ANSWER_HEADER_BYTES],
    /// Number of words of the part that are still to come.
    pub words: u64,
    /// Whether the answer ends with this part.
    pub is_last: bool,
}

/// The open session of a device.
#[derive(Clone, Debug)]
pub(super) struct Session {
    pub(super) number: u8,
    /// Number of the data frame that is expected next.
    pub(super) expected: u8,
    pub(super) flow: Flow,
}

impl Session {
    pub(super) fn new(number: u8, patience: u64) -> Self {
        Self { number, expected: 0, flow: Flow::new(WAITING, patience) }
    }

    /// The next part, if it can begin. A new answer must have come up to its length, and a begun answer must
    /// have a word ready.
    pub(super) fn begin_part(&mut self) -> Option<Part> {
        let answers = &mut self.flow.answers;
        let left = answers.left()?;
        if answers.waiting() == 0 {
            return None;
        }
        // A frame has the lowest byte of the number of the answer, and the lowest two of the index.
        let [low, high, ..] = answers.index().to_le_bytes();
        let header = [answers.sent() as u8, low, high];
        Some(Part { header, words: left.min(FRAME_WORDS), is_last: left <= FRAME_WORDS })
    }

    /// Takes a data frame of this session, if it is the expected one and there is room.
    pub(super) fn take_data(&mut self, frame: &FromHost, is_room: bool) -> Taken {
        let behind = self.expected.wrapping_sub(frame.number);
        if behind == 0 && is_room {
            self.expected = self.expected.wrapping_add(1);
            return self.flow.take(frame.payload.as_chunks().0.iter().map(|bytes| u32::from_le_bytes(*bytes)));
        }
        if (1..=OLD).contains(&behind) {
            return Taken::Before;
        }
        self.flow.refuse()
    }
}
