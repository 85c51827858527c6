//! A device that does nothing, as fast as it can: what is left of a job's time is the driver's.

use std::collections::VecDeque;

use incircle_model::serial::core_identity;
use incircle_model::stream::{BusError, Given};
use incircle_protocol::{
    answer_header, command_opcode, Config, Identity, InsertReport, Layout, Opcode, Status, StreamRegister,
    COUNTER_WORDS, LATENCY_BUCKETS, PADDING, STREAM_FIFO_BEATS, STREAM_STATUS_RUNS, STREAM_VERSION,
};

use super::beats::Beats;

/// Bytes of a word.
const WORD: usize = 4;

/// What the next word is.
#[derive(Clone, Copy, Debug)]
enum Awaited {
    Command,
    Points,
    Coordinates(usize),
    First(Opcode),
    Count(Opcode),
}

/// An answer, or what is left of it.
#[derive(Debug)]
struct Answer {
    head: VecDeque<u32>,
    /// Bytes of zeros behind that, up to the end of the last beat.
    zeros: usize,
}

/// It forgets points, counts them, and reads out zeros.
#[derive(Debug)]
pub struct NullDevice {
    identity: Identity,
    layout: Layout,
    beat: usize,
    awaited: Awaited,
    /// Points since the last `Clear`.
    points: u32,
    answers: VecDeque<Answer>,
}

impl NullDevice {
    /// A device that says it is such a core, with beats of 64 or 128 bits.
    pub fn new(config: Config, beat_bits: u32) -> Self {
        let identity = core_identity(config);
        Self {
            layout: Layout::of(identity.coord_bits, identity.capacity),
            identity,
            beat: if beat_bits >= 128 { 16 } else { 8 },
            awaited: Awaited::Command,
            points: 0,
            answers: VecDeque::new(),
        }
    }

    fn answer(&mut self, opcode: Opcode, payload: &[u32], zeros: usize) {
        let words = payload.len() + zeros;
        let head: VecDeque<u32> = [answer_header(opcode as u8, Status::Ok), words as u32]
            .into_iter()
            .chain(payload.iter().copied())
            .collect();
        let bytes = (WORD * (2 + words)).next_multiple_of(self.beat);
        self.answers.push_back(Answer { zeros: bytes - WORD * head.len(), head });
    }

    fn begin(&mut self, word: u32) -> Awaited {
        match Opcode::from_u8(command_opcode(word)) {
            None if word == PADDING => {}
            Some(Opcode::Insert) => return Awaited::Points,
            Some(opcode @ (Opcode::Read | Opcode::Triangles)) => return Awaited::First(opcode),
            Some(Opcode::Hello) => self.answer(Opcode::Hello, &self.identity.to_words(), 0),
            Some(Opcode::Clear) => {
                self.points = 0;
                self.answer(Opcode::Clear, &[], 0);
            }
            Some(Opcode::Counters) => self.answer(Opcode::Counters, &[], COUNTER_WORDS),
            Some(Opcode::Latencies) => self.answer(Opcode::Latencies, &[], LATENCY_BUCKETS),
            None => self.answers.push_back(Answer {
                head: [answer_header(command_opcode(word), Status::UnknownOpcode)].into(),
                zeros: self.beat - WORD,
            }),
        }
        Awaited::Command
    }

    fn await_points(&mut self, left: usize) -> Awaited {
        if left > 0 {
            return Awaited::Coordinates(left);
        }
        let report = InsertReport {
            arrived: self.points,
            inserted: self.points,
            records: (2 * self.points).saturating_sub(2),
            ..InsertReport::default()
        };
        self.answer(Opcode::Insert, &report.to_words(), 0);
        Awaited::Command
    }

    fn read_out(&mut self, opcode: Opcode, records: u32) -> Awaited {
        let words = match opcode {
            Opcode::Triangles => self.layout.triangles_words(records).unwrap_or(0) as usize,
            _ => records as usize * self.layout.record_words,
        };
        self.answer(opcode, &[], words);
        Awaited::Command
    }
}

impl Beats for NullDevice {
    fn take(&mut self, bytes: &[u8]) -> usize {
        let mut rest = bytes;
        while let Some((word, after)) = rest.split_first_chunk() {
            rest = after;
            let word = u32::from_le_bytes(*word);
            self.awaited = match self.awaited {
                Awaited::Command => self.begin(word),
                Awaited::Points => {
                    self.points = self.points.wrapping_add(word);
                    self.await_points(word as usize * self.layout.point_words)
                }
                Awaited::Coordinates(left) => {
                    let here = left.min(1 + rest.len() / WORD);
                    rest = &rest[(here - 1) * WORD..];
                    self.await_points(left - here)
                }
                Awaited::First(opcode) => Awaited::Count(opcode),
                Awaited::Count(opcode) => self.read_out(opcode, word),
            };
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

    fn write(&mut self, offset: u32, _: u32) -> Result<(), BusError> {
        if offset == StreamRegister::Control.offset() {
            self.answers.clear();
            (self.awaited, self.points) = (Awaited::Command, 0);
        }
        Ok(())
    }

    fn beat_bytes(&self) -> usize {
        self.beat
    }
}
