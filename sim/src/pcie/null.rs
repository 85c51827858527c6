//! A device that does nothing, as fast as it can. The time of a job on it is the time of the driver and the host.

use std::collections::VecDeque;

use incircle_model::serial::core_identity;
use incircle_model::stream::{BusError, Given};
use incircle_protocol::{
    answer_header, signed_header, Command, CommandReader, Config, Identity, InsertReport, Layout, Opcode, Status,
    StreamRegister, CONTROL_RESET, STREAM_FIFO_BEATS, STREAM_STATUS_RUNS, STREAM_VERSION,
};

use super::beats::Beats;

/// Number of bytes of a word.
const WORD: usize = 4;

/// An answer, or the rest of one.
#[derive(Debug)]
struct Answer {
    head: VecDeque<u32>,
    /// Number of zero bytes behind the head, up to the end of the last beat.
    zeros: usize,
}

/// A device that counts points but forgets them, and reads out zeros.
#[derive(Debug)]
pub struct NullDevice {
    identity: Identity,
    layout: Layout,
    beat: usize,
    commands: CommandReader,
    /// Number of words of points that the current `Insert` still expects.
    left: Option<u64>,
    /// Tag of the last `Clear`.
    tag: u8,
    /// Number of points since the last `Clear`.
    points: u32,
    answers: VecDeque<Answer>,
}

impl NullDevice {
    /// A device with the identity of this core, and with beats of 64 or 128 bits.
    pub fn new(config: Config, beat_bits: u32) -> Self {
        let identity = core_identity(config);
        Self {
            layout: Layout::of(identity.coord_bits, identity.capacity),
            identity,
            beat: if beat_bits >= 128 { 16 } else { 8 },
            commands: CommandReader::default(),
            left: None,
            tag: 0,
            points: 0,
            answers: VecDeque::new(),
        }
    }

    fn answer(&mut self, opcode: Opcode, payload: &[u32], zeros: usize) {
        let words = payload.len() + zeros;
        let head: VecDeque<u32> = [signed_header(answer_header(opcode as u8, Status::Ok), 0, self.tag), words as u32]
            .into_iter()
            .chain(payload.iter().copied())
            .collect();
        let bytes = (WORD * (2 + words)).next_multiple_of(self.beat);
        self.answers.push_back(Answer { zeros: bytes - WORD * head.len(), head });
    }

    /// Answers a command. An `Insert` is answered later, when its points have come.
    fn begin(&mut self, command: Command<()>) {
        match command {
            Command::Hello => self.answer(Opcode::Hello, &self.identity.to_words(), 0),
            Command::Clear(clear) => {
                (self.tag, self.points) = (clear.tag, 0);
                self.answer(Opcode::Clear, &[], 0);
            }
            Command::Insert { count, .. } => {
                self.points = self.points.wrapping_add(count);
                self.left = Some(command.point_words(self.layout));
            }
            Command::Read(_)
            | Command::Triangles(_)
            | Command::ShortTriangles(..)
            | Command::Counters
            | Command::Latencies => {
                self.answer(command.opcode(), &[], command.payload_words(self.layout) as usize);
            }
            // The identity does not offer runs.
            Command::Run { kind, .. } => self.refuse(kind.opcode() as u8),
        }
    }

    fn refuse(&mut self, opcode: u8) {
        let head = [answer_header(opcode, Status::UnknownOpcode)].into();
        self.answers.push_back(Answer { head, zeros: self.beat - WORD });
    }

    /// Answers an `Insert` whose points have all come.
    fn report(&mut self) {
        let report = InsertReport {
            arrived: self.points,
            inserted: self.points,
            records: (2 * self.points).saturating_sub(2),
            ..InsertReport::default()
        };
        self.answer(Opcode::Insert, &report.to_words(), 0);
    }

    /// Takes as many bytes of points as there are, and returns the bytes behind them.
    fn take_points<'b>(&mut self, left: u64, bytes: &'b [u8]) -> &'b [u8] {
        let here = left.min((bytes.len() / WORD) as u64);
        self.left = Some(left - here).filter(|&left| left > 0);
        if self.left.is_none() {
            self.report();
        }
        // No more words are taken than the slice has, so the product fits.
        &bytes[here as usize * WORD..]
    }
}

impl Beats for NullDevice {
    fn take(&mut self, bytes: &[u8]) -> usize {
        let mut rest = bytes;
        loop {
            if let Some(left) = self.left {
                rest = self.take_points(left, rest);
            }
            let Some((word, after)) = rest.split_first_chunk() else {
                break;
            };
            rest = after;
            match self.commands.take(u32::from_le_bytes(*word)) {
                Some(Ok(command)) => self.begin(command),
                Some(Err(opcode)) => self.refuse(opcode),
                None => {}
            }
        }
        bytes.len()
    }

    fn give(&mut self, bytes: &mut [u8]) -> Given {
        let room = bytes.len() / self.beat * self.beat;
        let Some(answer) = self.answers.front_mut().filter(|_| room > 0) else {
            return Given::default();
        };
        let mut given = 0;
        while let Some(word) = answer.head.front().filter(|_| given < room) {
            bytes[given..given + WORD].copy_from_slice(&word.to_le_bytes());
            given += WORD;
            answer.head.pop_front();
        }
        let zeros = answer.zeros.min(room - given);
        bytes[given..given + zeros].fill(0);
        answer.zeros -= zeros;
        let is_end = answer.zeros == 0 && answer.head.is_empty();
        if is_end {
            self.answers.pop_front();
        }
        Given { bytes: given + zeros, is_end }
    }

    fn read(&mut self, offset: u32) -> Result<u32, BusError> {
        let words = self.identity.to_words();
        Ok(match offset {
            0x00 => words[0],
            0x04 => STREAM_VERSION,
            0x08..=0x1c => words[offset as usize / WORD - 1],
            _ if offset == StreamRegister::BeatBits.offset() => 8 * self.beat as u32,
            _ if offset == StreamRegister::FifoBeats.offset() => STREAM_FIFO_BEATS,
            _ if offset == StreamRegister::Status.offset() => STREAM_STATUS_RUNS,
            _ => 0,
        })
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), BusError> {
        if offset == StreamRegister::Control.offset() && value & CONTROL_RESET != 0 {
            self.answers.clear();
            (self.commands, self.left, self.points) = (CommandReader::default(), None, 0);
        }
        Ok(())
    }

    fn beat_bytes(&self) -> usize {
        self.beat
    }
}
