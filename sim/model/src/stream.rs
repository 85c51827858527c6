//! The device's end of the stream link: words in beats between two FIFOs, and the registers beside them.
//!
//! Hardware twin: the blocks of `hdl/src/stream/`.
//!
//! [`StreamModel`] models the device behind one AXI4-Stream in each direction and a register block, without a clock:
//! the device takes beats while there is room, and gives answers while there are some. A [`WordStream`] lies
//! behind the beats. The model shares nothing with the hardware or with a host but the numbers of the protocol.
//!
//! ```
//! use incircle_model::stream::{ModelCore, StreamModel};
//! use incircle_protocol::{command_word, Opcode, StreamRegister, SMALL};
//! let mut device = StreamModel::new(ModelCore::of(SMALL)?, 64);
//! assert_eq!(device.read(StreamRegister::Capacity.offset()), Ok(1024));
//! let mut beat = [0; 8]; // a command and a word of padding
//! beat[..4].copy_from_slice(&command_word(Opcode::Hello).to_le_bytes());
//! assert_eq!(device.take(&beat), 8);
//! let mut answer = [0; 100];
//! let given = device.give(&mut answer);
//! assert_eq!((given.bytes, given.is_end), (40, true)); // header, length, 7 words, and the rest of the last beat
//! # Ok::<(), incircle_model::ModelError>(())
//! ```

mod core;
#[cfg(test)]
mod tests;

use std::collections::VecDeque;

use incircle_protocol::{
    answer_status, Identity, Status, StreamRegister, CONTROL_RESET, ERROR_ANSWER_STATUS, ERROR_PARTIAL_BEAT,
    STREAM_FIFO_BEATS, STREAM_STATUS_BUSY, STREAM_STATUS_ERROR, STREAM_STATUS_RUNS, STREAM_VERSION,
};

pub use self::core::{ModelCore, WordStream};

/// Number of bytes of a word.
const WORD: usize = 4;
/// Number of words in front of an answer's payload: header and length.
const HEAD_WORDS: usize = 2;

/// An access to registers that the bus refuses with SLVERR.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BusError;

/// The result of reading answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Given {
    /// Number of bytes that were given, in whole beats.
    pub bytes: usize,
    /// Whether the last byte ends an answer.
    pub is_end: bool,
}

/// A word of an answer in the FIFO, and whether it is the last of the answer.
type Leaving = (u32, bool);

/// A device of beats and registers.
#[derive(Debug)]
pub struct StreamModel<C> {
    core: C,
    identity: Identity,
    /// Number of words of a beat.
    width: usize,
    commands: VecDeque<u32>,
    answers: VecDeque<Leaving>,
    /// Number of words of the current answer that have come from the core, and the length of that answer
    /// once it is known.
    came: usize,
    length: Option<usize>,
    header: u32,
    errors: u32,
    fault: u32,
    command_beats: u32,
    answer_beats: u32,
    answers_ended: u32,
}

impl<C: WordStream> StreamModel<C> {
    /// A device around this core, with beats of 64 or 128 bits, after its reset.
    pub fn new(mut core: C, beat_bits: u32) -> Self {
        core.reset();
        Self {
            identity: core.identity(),
            core,
            width: if beat_bits >= 128 { 4 } else { 2 },
            commands: VecDeque::new(),
            answers: VecDeque::new(),
            came: 0,
            length: None,
            header: 0,
            errors: 0,
            fault: 0,
            command_beats: 0,
            answer_beats: 0,
            answers_ended: 0,
        }
    }

    /// Number of bytes of a beat.
    pub fn beat_bytes(&self) -> usize {
        WORD * self.width
    }

    fn fifo_words(&self) -> usize {
        STREAM_FIFO_BEATS as usize * self.width
    }

    /// Takes as many whole beats as there is room for, and returns how many bytes that were. If `bytes` ends within a
    /// beat, that beat lacks bytes: it is dropped, and an error bit is set.
    pub fn take(&mut self, bytes: &[u8]) -> usize {
        let beat = self.beat_bytes();
        let mut taken = 0;
        while bytes.len() - taken >= beat {
            let room = (self.fifo_words() - self.commands.len()) / self.width * beat;
            let piece = room.min((bytes.len() - taken) / beat * beat);
            if piece == 0 {
                return taken;
            }
            let words = bytes[taken..taken + piece].chunks_exact(WORD);
            self.commands.extend(words.map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])));
            self.command_beats = self.command_beats.wrapping_add((piece / beat) as u32);
            taken += piece;
            self.work();
        }
        if taken < bytes.len() {
            self.errors |= ERROR_PARTIAL_BEAT;
        }
        bytes.len()
    }

    /// Gives beats, at most as many as fit into `bytes`, and none beyond the end of an answer.
    pub fn give(&mut self, bytes: &mut [u8]) -> Given {
        let mut given = Given::default();
        for beat in bytes.chunks_exact_mut(WORD * self.width) {
            // Within an answer only whole beats may leave; the end of an answer may fill a beat with padding.
            let is_whole = self.answers.len() >= self.width || self.answers.iter().any(|word| word.1);
            if !is_whole {
                break;
            }
            beat.fill(0);
            for place in beat.chunks_exact_mut(WORD) {
                let Some((word, is_last)) = self.answers.pop_front() else {
                    break;
                };
                place.copy_from_slice(&word.to_le_bytes());
                given.is_end = is_last;
                if is_last {
                    break;
                }
            }
            given.bytes += WORD * self.width;
            self.answer_beats = self.answer_beats.wrapping_add(1);
            self.work();
            if given.is_end {
                self.answers_ended = self.answers_ended.wrapping_add(1);
                break;
            }
        }
        given
    }

    /// Moves words through the core, as far as the FIFOs allow. As the core does, the model takes no word while it has
    /// an answer to give.
    fn work(&mut self) {
        loop {
            while self.answers.len() < self.fifo_words() {
                let mut word = [0];
                if self.core.receive(&mut word) == 0 {
                    break;
                }
                self.leave(word[0]);
            }
            if self.answers.len() >= self.fifo_words() {
                return;
            }
            let Some(word) = self.commands.pop_front() else {
                return;
            };
            self.core.send(&[word]);
        }
    }

    /// Puts a word into the FIFO to the host. The second word of an answer is its length.
    fn leave(&mut self, word: u32) {
        match self.came {
            0 => self.header = word,
            1 => self.length = Some(HEAD_WORDS + word as usize),
            _ => {}
        }
        self.came += 1;
        let is_last = self.length == Some(self.came);
        self.answers.push_back((word, is_last));
        if is_last {
            if answer_status(self.header) != Status::Ok as u8 {
                self.errors |= ERROR_ANSWER_STATUS;
                self.fault = self.header;
            }
            (self.came, self.length) = (0, None);
        }
    }

    /// Whether a word is held, or a command has not been answered completely.
    pub fn is_busy(&self) -> bool {
        !self.commands.is_empty() || !self.answers.is_empty() || self.came > 0 || self.core.is_busy()
    }

    /// Resets the core and both FIFOs. Whatever was in progress is lost; the counters are kept.
    pub fn reset(&mut self) {
        self.core.reset();
        self.commands.clear();
        self.answers.clear();
        (self.came, self.length) = (0, None);
    }

    /// Reads the register at this byte offset.
    ///
    /// # Errors
    /// There is no register at this offset.
    pub fn read(&mut self, offset: u32) -> Result<u32, BusError> {
        let identity = &self.identity;
        Ok(match register_at(offset).ok_or(BusError)? {
            StreamRegister::Magic => identity.magic,
            StreamRegister::StreamVersion => STREAM_VERSION,
            StreamRegister::ProtocolVersion => identity.protocol_version,
            StreamRegister::CoreVersion => identity.core_version,
            StreamRegister::CoordBits => identity.coord_bits,
            StreamRegister::Capacity => identity.capacity,
            StreamRegister::Contexts => identity.contexts_word(),
            StreamRegister::Ring => identity.ring_capacity,
            StreamRegister::BeatBits => 32 * self.width as u32,
            StreamRegister::FifoBeats => STREAM_FIFO_BEATS,
            StreamRegister::Status => self.status(),
            StreamRegister::Errors => self.errors,
            StreamRegister::Fault => self.fault,
            StreamRegister::CommandBeats => self.command_beats,
            StreamRegister::AnswerBeats => self.answer_beats,
            StreamRegister::Answers => self.answers_ended,
            // The model has no clock to count.
            StreamRegister::Control
            | StreamRegister::ClocksLow
            | StreamRegister::ClocksHigh
            | StreamRegister::CommandWaits
            | StreamRegister::AnswerWaits => 0,
        })
    }

    fn status(&self) -> u32 {
        let mut status = STREAM_STATUS_RUNS;
        if self.is_busy() {
            status |= STREAM_STATUS_BUSY;
        }
        if self.errors != 0 {
            status |= STREAM_STATUS_ERROR;
        }
        status
    }

    /// Writes the register at this byte offset.
    ///
    /// # Errors
    /// There is no register at this offset, or it is read-only.
    pub fn write(&mut self, offset: u32, value: u32) -> Result<(), BusError> {
        match register_at(offset) {
            Some(StreamRegister::Control) => {
                if value & CONTROL_RESET != 0 {
                    self.reset();
                }
            }
            Some(StreamRegister::Errors) => self.errors &= !value,
            _ => return Err(BusError),
        }
        Ok(())
    }
}

/// The register at this byte offset. The lowest two bits of an offset have no meaning.
fn register_at(offset: u32) -> Option<StreamRegister> {
    StreamRegister::ALL.into_iter().find(|register| register.offset() == offset & !3)
}
