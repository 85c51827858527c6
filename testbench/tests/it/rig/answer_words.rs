//! Answers of a core as `incircle-protocol` states them, for the blocks that put answers together.

use incircle_protocol::{
    Identity, InsertReport, Layout, Opcode, ShortIds, Status, CORE_COORD_BITS, CORE_VERSION, COUNTER_WORDS,
    FEATURE_SHORT_IDS, LATENCY_BUCKETS, MAGIC, MAX_CONTEXTS, PROTOCOL_VERSION,
};
use incircle_testkit::SplitMix64;

/// Returns true `times` times in a hundred.
pub fn percent(random: &mut SplitMix64, times: u64) -> bool {
    random.below(100) < times
}

/// Returns a random word of 32 bits, often one of the extremes.
pub fn word(random: &mut SplitMix64) -> u32 {
    [0, 1, u32::MAX, 1 << 31, random.next_u64() as u32, random.below(8) as u32][random.below(6) as usize]
}

/// Status, payload length and payload of an answer; for a read the payload is left open.
pub struct Answer {
    pub opcode: u8,
    pub status: Status,
    pub length: u32,
    pub payload: Option<Vec<u32>>,
}

/// Inputs of `AnswerWords` by name.
pub struct Asked {
    pub opcode: u8,
    pub first: u32,
    pub count: u32,
    pub short_ids: Option<ShortIds>,
    pub is_refused: bool,
    pub engine: u8,
    pub tag: u8,
    pub capacity: u32,
    pub contexts: u32,
    pub engines: u32,
    pub ring: u32,
    pub collinear: bool,
    pub stuck: bool,
    pub report: InsertReport,
    pub counter: u32,
    pub latency: u32,
}

impl Asked {
    pub fn random(random: &mut SplitMix64) -> Self {
        let records = random.below(1 << 15) as u32;
        let first = if percent(random, 50) { word(random) } else { records / 2 };
        let rest = records.wrapping_sub(first);
        Self {
            opcode: 0,
            first,
            count: match random.below(3) {
                0 => word(random),
                // Exactly up to the last record, one less, or one more.
                _ => rest.wrapping_add(random.below(3) as u32).wrapping_sub(1),
            },
            short_ids: [None, Some(ShortIds::Ten), Some(ShortIds::Twelve)][random.below(3) as usize],
            is_refused: false,
            engine: word(random) as u8,
            tag: word(random) as u8,
            capacity: 1 << (2 + random.below(13)),
            contexts: 1 + random.below(MAX_CONTEXTS.into()) as u32,
            engines: 1 + random.below(255) as u32,
            ring: 3 + random.below(62) as u32,
            collinear: percent(random, 20),
            stuck: percent(random, 20),
            report: InsertReport {
                arrived: random.below(1 << 15) as u32,
                inserted: word(random),
                duplicates: word(random),
                refused: word(random),
                records,
            },
            counter: word(random),
            latency: word(random),
        }
    }

    pub fn answer(&self) -> Answer {
        let end = u64::from(self.first) + u64::from(self.count);
        let (status, length, payload) = match Opcode::of_every_device(self.opcode) {
            Some(Opcode::Clear) if self.is_refused => (Status::BadContexts, 0, Some(vec![])),
            Some(Opcode::Clear) => (Status::Ok, 0, Some(vec![])),
            Some(Opcode::Read | Opcode::Triangles) if end > u64::from(self.report.records) => {
                (Status::BadRange, 0, None)
            }
            Some(Opcode::Read) => {
                let words = Layout::of(CORE_COORD_BITS, self.capacity).record_words as u32;
                (Status::Ok, words * self.count, None)
            }
            Some(Opcode::Triangles) => {
                let layout = Layout::of(CORE_COORD_BITS, self.capacity);
                let words = match self.short_ids {
                    None => layout.triangles_words(self.count).expect("a range of records"),
                    Some(ids) => ids.words(self.count) as u32,
                };
                (Status::Ok, words, None)
            }
            Some(Opcode::Counters) => {
                let words = vec![self.counter; COUNTER_WORDS];
                (Status::Ok, COUNTER_WORDS as u32, Some(words))
            }
            Some(Opcode::Latencies) => {
                let words = vec![self.latency; LATENCY_BUCKETS];
                (Status::Ok, LATENCY_BUCKETS as u32, Some(words))
            }
            Some(Opcode::Hello) => {
                let identity = Identity {
                    magic: MAGIC,
                    protocol_version: PROTOCOL_VERSION,
                    core_version: CORE_VERSION,
                    coord_bits: CORE_COORD_BITS,
                    capacity: self.capacity,
                    contexts: self.contexts,
                    engines: self.engines,
                    ring_capacity: self.ring,
                    features: FEATURE_SHORT_IDS,
                };
                (Status::Ok, 7, Some(identity.to_words().to_vec()))
            }
            Some(Opcode::Insert) => {
                let status = if self.stuck {
                    Status::Stuck
                } else if self.collinear {
                    Status::Collinear
                } else if self.report.refused > 0 {
                    Status::Full
                } else {
                    Status::Ok
                };
                (status, 5, Some(self.report.to_words().to_vec()))
            }
            // The core does not have the runs.
            Some(_) | None => (Status::UnknownOpcode, 0, Some(vec![])),
        };
        Answer { opcode: self.opcode, status, length, payload }
    }
}

/// Random opcodes, each for some clocks: the opcode, whether the command is refused, the number of clocks.
pub fn commands(random: &mut SplitMix64) -> Vec<(u8, bool, usize)> {
    let opcode = |random: &mut SplitMix64| {
        if percent(random, 80) {
            random.below(9) as u8
        } else {
            word(random) as u8
        }
    };
    (0..600).map(|_| (opcode(random), percent(random, 50), 4 + random.below(12) as usize)).collect()
}
