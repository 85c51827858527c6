//! The model by commands as a device: words in, words out.
//!
//! Hardware twin: the core behind its command port and responder, without clocks.

mod awaited;
mod read_out;
mod runs;

use crate::mesh::Mesh;
use crate::predicate::Point;
use awaited::{Awaited, Range, Reading};
use incircle_protocol as protocol;
use protocol::{
    answer_header, signed_header, Counter, Identity, InsertReport, Layout, Opcode, RunKind, ShortIds, Status,
};
use std::collections::VecDeque;
use std::fmt;

/// Version of the model, and of the core that it predicts: `major << 16 | minor << 8 | patch`.
pub const CORE_VERSION: u32 = protocol::CORE_VERSION;

/// A parameter with which the model cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelError {
    /// The width of coordinates is outside 1 to 31 bits.
    CoordBits(u32),
    /// The capacity is outside 4 to [`protocol::MAX_MODEL_POINTS`] points.
    Capacity(u32),
    /// The length of the boundary list is outside 3 to 64 entries.
    Ring(u32),
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::CoordBits(given) => write!(
                f,
                "the model cannot take coordinates of {given} bits: choose {} to {}",
                protocol::MIN_COORD_BITS,
                protocol::MAX_COORD_BITS
            ),
            Self::Capacity(given) => {
                write!(
                    f,
                    "the model cannot hold {given} points: choose a number from {} to {}",
                    protocol::MIN_POINTS,
                    protocol::MAX_MODEL_POINTS
                )
            }
            Self::Ring(given) => {
                write!(
                    f,
                    "a boundary list cannot hold {given} edges: choose a number from {} to {}",
                    protocol::MIN_RING,
                    protocol::MAX_RING
                )
            }
        }
    }
}

impl std::error::Error for ModelError {}

/// A model that is driven by whole commands. Each command is carried out when its last word arrives.
#[derive(Debug)]
pub struct CommandModel {
    identity: Identity,
    layout: Layout,
    mesh: Mesh,
    awaited: Awaited,
    /// The tag of the last `Clear`, refused or not.
    tag: u8,
    /// The number of the engine that answers.
    engine: u8,
    /// First word of a point of two words, if a piece of the command stream ended between them.
    half_point: Option<u32>,
    answers: VecDeque<u32>,
    reading: Reading,
}

impl CommandModel {
    /// A model with an empty mesh. Memory is allocated as points arrive, not for the whole capacity.
    pub fn new(coord_bits: u32, capacity: u32, ring_capacity: u32) -> Result<Self, ModelError> {
        if !(protocol::MIN_COORD_BITS..=protocol::MAX_COORD_BITS).contains(&coord_bits) {
            return Err(ModelError::CoordBits(coord_bits));
        }
        if !(protocol::MIN_POINTS..=protocol::MAX_MODEL_POINTS).contains(&capacity) {
            return Err(ModelError::Capacity(capacity));
        }
        if !(protocol::MIN_RING..=protocol::MAX_RING).contains(&ring_capacity) {
            return Err(ModelError::Ring(ring_capacity));
        }
        let layout = Layout::of(coord_bits, capacity);
        let is_narrow = layout.record_words == 3;
        Ok(Self {
            identity: Identity {
                magic: protocol::MAGIC,
                protocol_version: protocol::PROTOCOL_VERSION,
                core_version: CORE_VERSION,
                coord_bits,
                capacity,
                contexts: 1,
                engines: 1,
                ring_capacity,
                features: if is_narrow { protocol::FEATURE_SHORT_IDS } else { 0 },
            },
            layout,
            mesh: Mesh::new(capacity, ring_capacity),
            awaited: Awaited::Command,
            tag: 0,
            engine: 0,
            half_point: None,
            answers: VecDeque::new(),
            reading: Reading::NONE,
        })
    }

    /// The same model with this many contexts, 1 to 255. A batch may then have up to as many jobs, but its points are
    /// still inserted one after the other.
    #[must_use]
    pub fn with_contexts(mut self, contexts: u32) -> Self {
        self.identity.contexts = contexts.clamp(1, 255);
        self
    }

    /// The same model with the commands for a mesh that stands, the runs, which its identity then offers.
    #[must_use]
    pub fn with_runs(mut self) -> Self {
        self.identity.features |= protocol::FEATURE_RUNS;
        self
    }

    /// The same model with the runs that a core with runs has. Its identity offers them one by one, as that of a core
    /// does.
    #[must_use]
    pub fn with_core_runs(mut self) -> Self {
        self.identity.features |= protocol::CORE_RUNS;
        self
    }

    /// The same model as the engine of this number on a device that has `engines` of them.
    #[must_use]
    pub fn as_engine(mut self, number: u8, engines: u32) -> Self {
        (self.engine, self.identity.engines) = (number, engines);
        self
    }

    /// The mesh in its current state.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Whether a command has begun and its answer has not been handed out completely.
    pub fn is_busy(&self) -> bool {
        !self.is_between_commands() || !self.answers.is_empty() || self.reading.left != 0
    }

    /// Whether the next word begins a command.
    pub fn is_between_commands(&self) -> bool {
        matches!(self.awaited, Awaited::Command)
    }

    /// Takes a piece of the command stream, of any length.
    pub fn send(&mut self, words: &[u32]) {
        let mut rest = words;
        while let Some((&word, after)) = rest.split_first() {
            rest = match self.awaited {
                Awaited::Points { left } => self.take_points(left, rest),
                Awaited::Command => {
                    self.take_command(word);
                    after
                }
                Awaited::InsertCount => {
                    self.mesh.reserve(word);
                    self.await_points(word);
                    after
                }
                Awaited::ReadFirst(range) => {
                    self.awaited = Awaited::ReadCount(range, word);
                    after
                }
                Awaited::ReadCount(range, first) => {
                    self.awaited = Awaited::Command;
                    self.take_read(range, first, word);
                    after
                }
                Awaited::RunCount(kind) => {
                    self.begin_run(kind, word);
                    after
                }
                Awaited::Items(run) => {
                    self.take_item_word(run, word);
                    after
                }
            };
        }
    }

    /// Hands out answer words that are ready, and returns their number.
    pub fn receive(&mut self, buffer: &mut [u32]) -> usize {
        let mut filled = 0;
        while filled < buffer.len() {
            let ready = self.answers.len().min(buffer.len() - filled);
            for (place, word) in buffer[filled..filled + ready].iter_mut().zip(self.answers.drain(..ready)) {
                *place = word;
            }
            filled += ready;
            if self.answers.is_empty() && !self.read_on() {
                break;
            }
        }
        filled
    }

    fn take_command(&mut self, word: u32) {
        if word == protocol::PADDING {
            return;
        }
        self.finish_reading();
        let opcode = protocol::command_opcode(word);
        let is_taken = |&known: &Opcode| RunKind::of(known).is_none_or(|kind| self.identity.takes(kind));
        let known = Opcode::from_u8(opcode).filter(is_taken);
        match known {
            Some(Opcode::Hello) => {
                let words = self.identity.to_words();
                self.answer(opcode, Status::Ok, &words);
            }
            Some(Opcode::Clear) => self.clear(word),
            Some(Opcode::Insert) => self.awaited = Awaited::InsertCount,
            Some(Opcode::Read) => self.awaited = Awaited::ReadFirst(Range::Records),
            Some(Opcode::Triangles) => {
                let short =
                    ShortIds::of_word(word).filter(|_| self.identity.features & protocol::FEATURE_SHORT_IDS != 0);
                self.awaited = Awaited::ReadFirst(short.map_or(Range::Vertices, Range::ShortVertices));
            }
            Some(Opcode::Counters) => {
                let words = self.counter_words();
                self.answer(opcode, Status::Ok, &words);
            }
            // In the model by commands, insertions take no time.
            Some(Opcode::Latencies) => self.answer(opcode, Status::Ok, &[0; protocol::LATENCY_BUCKETS]),
            Some(other) => match RunKind::of(other) {
                Some(kind) => self.awaited = Awaited::RunCount(kind),
                None => self.answer(opcode, Status::UnknownOpcode, &[]),
            },
            None => self.answer(opcode, Status::UnknownOpcode, &[]),
        }
    }

    fn clear(&mut self, word: u32) {
        self.tag = protocol::command_tag(word);
        match self.jobs_of(word) {
            Some(jobs) => {
                self.mesh.clear_for(jobs);
                self.answer(Opcode::Clear as u8, Status::Ok, &[]);
            }
            None => self.answer(Opcode::Clear as u8, Status::BadContexts, &[]),
        }
    }

    /// Number of jobs that a `Clear` begins. `None` if it names more contexts than there are, or a number of jobs that
    /// does not divide that of the contexts.
    fn jobs_of(&self, word: u32) -> Option<u32> {
        let built = self.identity.contexts;
        let contexts = match protocol::command_contexts(word) {
            0 => built,
            asked => asked,
        };
        let jobs = match protocol::command_meshes(word) {
            _ if !protocol::command_starts_batch(word) => 1,
            0 => contexts,
            asked => asked,
        };
        (contexts <= built && contexts.is_multiple_of(jobs)).then_some(jobs)
    }

    fn answer(&mut self, opcode: u8, status: Status, payload: &[u32]) {
        self.begin_answer(opcode, status, payload.len() as u32);
        self.answers.extend(payload);
    }

    fn begin_answer(&mut self, opcode: u8, status: Status, length: u32) {
        self.answers.extend([signed_header(answer_header(opcode, status), self.engine, self.tag), length]);
    }

    fn await_points(&mut self, left: u32) {
        self.awaited = Awaited::Points { left };
        if left == 0 {
            self.awaited = Awaited::Command;
            self.report_insert();
        }
    }

    /// Inserts the points in `words`, at most `left` of them, and returns the words behind them.
    fn take_points<'a>(&mut self, left: u32, words: &'a [u32]) -> &'a [u32] {
        let mask = u32::MAX >> (32 - self.identity.coord_bits);
        let mut left = left;
        let mut rest = words;
        while left > 0 {
            let Some((&word, after)) = rest.split_first() else {
                break;
            };
            rest = after;
            let (x, y) = match (self.layout.point_words, self.half_point.take()) {
                (1, _) => (word & 0xffff, word >> 16),
                (_, Some(x)) => (x, word),
                (_, None) => {
                    self.half_point = Some(word);
                    continue;
                }
            };
            let point = Point { x: x & mask, y: y & mask };
            self.mesh.insert(point);
            left -= 1;
        }
        self.await_points(left);
        rest
    }

    fn report_insert(&mut self) {
        let counts = self.mesh.counts();
        let report = InsertReport {
            arrived: counts.arrived,
            inserted: self.mesh.vertices(),
            duplicates: counts.duplicates,
            refused: counts.refused,
            records: self.mesh.live_records(),
        };
        let status = match (self.mesh.is_collinear(), counts.refused) {
            (true, _) => Status::Collinear,
            (false, 0) => Status::Ok,
            (false, _) => Status::Full,
        };
        self.answer(Opcode::Insert as u8, status, &report.to_words());
    }

    fn counter_words(&self) -> [u32; protocol::COUNTER_WORDS] {
        let counts = self.mesh.counts();
        let mut words = [0; protocol::COUNTER_WORDS];
        for (counter, value) in [
            (Counter::Insertions, counts.insertions),
            (Counter::Duplicates, counts.duplicates),
            (Counter::Refused, counts.refused),
            (Counter::WalkVisits, counts.walk_visits),
            (Counter::Tests, counts.tests),
            (Counter::CavityTriangles, counts.cavity_triangles),
            (Counter::Overflows, counts.overflows),
            (Counter::Flips, counts.flips),
        ] {
            words[counter as usize] = value;
        }
        words
    }
}
