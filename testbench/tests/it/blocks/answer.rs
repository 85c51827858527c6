//! What answers say: Rust, Verilog and the protocol as `incircle-protocol` states it agree, over random commands and counts of a mesh
//! that change in every clock.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::link::{AnswerHead, AnswerWords};
use incircle_protocol::{
    answer_header, Identity, InsertReport, Layout, Opcode, Status, CORE_COORD_BITS, CORE_VERSION, COUNTER_WORDS,
    LATENCY_BUCKETS, MAGIC, MAX_CONTEXTS, PROTOCOL_VERSION,
};

named_ports!(
    AnswerHead,
    [request, is_refused, records, collinear, stuck, some_refused], [head],
    clock
);
named_ports!(
    AnswerWords,
    [opcode, capacity, contexts, ring, tally, insertions, duplicates, records, index, counter, latency, chooses], [word],
    clock
);

/// True that many times in a hundred.
fn percent(random: &mut SplitMix64, times: u64) -> bool {
    random.below(100) < times
}

/// A word of 32 bits, from the corners as often as not.
fn word(random: &mut SplitMix64) -> u32 {
    [0, 1, u32::MAX, 1 << 31, random.next_u64() as u32, random.below(8) as u32][random.below(6) as usize]
}

/// Status, payload length and payload of the answer; the payload of a read is open.
struct Answer {
    opcode: u8,
    status: Status,
    length: u32,
    payload: Option<Vec<u32>>,
}

/// Inputs of `AnswerWords` by name.
struct Asked {
    opcode: u8,
    first: u32,
    count: u32,
    is_refused: bool,
    capacity: u32,
    contexts: u32,
    ring: u32,
    collinear: bool,
    stuck: bool,
    report: InsertReport,
    counter: u32,
    latency: u32,
}

impl Asked {
    fn random(random: &mut SplitMix64) -> Self {
        let records = random.below(1 << 15) as u32;
        let first = if percent(random, 50) { word(random) } else { records / 2 };
        let rest = records.wrapping_sub(first);
        Self {
            opcode: 0,
            first,
            count: match random.below(3) {
                0 => word(random),
                // Just to the last record, one less, one more.
                _ => rest.wrapping_add(random.below(3) as u32).wrapping_sub(1),
            },
            is_refused: false,
            capacity: 1 << (2 + random.below(13)),
            contexts: 1 + random.below(MAX_CONTEXTS.into()) as u32,
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

    fn answer(&self) -> Answer {
        let end = u64::from(self.first) + u64::from(self.count);
        let (status, length, payload) = match Opcode::from_u8(self.opcode) {
            None => (Status::UnknownOpcode, 0, Some(vec![])),
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
                (Status::Ok, layout.triangles_words(self.count).expect("a range of records"), None)
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
                    ring_capacity: self.ring,
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
        };
        Answer { opcode: self.opcode, status, length, payload }
    }
}

/// Random opcodes, each for some clocks: the opcode, whether the command is refused, clocks.
fn commands(random: &mut SplitMix64) -> Vec<(u8, bool, usize)> {
    let opcode = |random: &mut SplitMix64| {
        if percent(random, 80) {
            random.below(9) as u8
        } else {
            word(random) as u8
        }
    };
    (0..600).map(|_| (opcode(random), percent(random, 50), 4 + random.below(12) as usize)).collect()
}

#[test]
fn answer_heads_follow_the_protocol() {
    let mut random = SplitMix64::new(5);
    let mut block = Stepper::new("answer_head", AnswerHead::default(), 1);
    let mut bad_ranges = 0;
    for (opcode, is_refused, clocks) in commands(&mut random) {
        let mut answers: Vec<Answer> = vec![];
        for clock in 0..clocks {
            let asked = Asked { opcode, is_refused, ..Asked::random(&mut random) };
            for (port, value) in [
                ("opcode", u32::from(asked.opcode)),
                ("first", asked.first),
                ("count", asked.count),
                ("is_refused", asked.is_refused.into()),
                ("collinear", asked.collinear.into()),
                ("stuck", asked.stuck.into()),
                ("some_refused", (asked.report.refused > 0).into()),
                ("records", asked.report.records),
            ] {
                block.set(port, value);
            }
            block.settle();
            answers.push(asked.answer());
            block.expect("is_read", [Opcode::Read as u8, Opcode::Triangles as u8].contains(&opcode));
            block.expect("is_packed", opcode == Opcode::Triangles as u8);
            if clock >= 3 {
                let answer = &answers[clock - 3];
                bad_ranges += u32::from(answer.status == Status::BadRange);
                block.expect("header", answer_header(answer.opcode, answer.status));
                block.expect("length", answer.length);
                block.expect("is_empty", answer.length == 0);
            }
            block.edge();
        }
    }
    assert!(bad_ranges > 100, "{bad_ranges}");
}

#[test]
fn answer_words_follow_the_protocol() {
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("answer_words", AnswerWords::default(), 1);
    let mut compared = [0; 3];
    for (opcode, _, clocks) in commands(&mut random) {
        // Counters and buckets come from outside a clock after their index.
        let mut asked_before: Vec<(Asked, usize)> = vec![];
        let mut chosen = None;
        for clock in 0..clocks {
            let asked = Asked { opcode, ..Asked::random(&mut random) };
            let words = [8, LATENCY_BUCKETS as u64][random.below(2) as usize];
            let index = random.below(words) as usize;
            let report = asked.report;
            for (port, value) in [
                ("opcode", u32::from(asked.opcode)),
                ("capacity", asked.capacity),
                ("contexts", asked.contexts),
                ("ring", asked.ring),
                ("arrived", report.arrived),
                ("refused", report.refused),
                ("insertions", report.inserted),
                ("duplicates", report.duplicates),
                ("records", report.records),
                ("index", index as u32),
                ("counter", asked.counter),
                ("latency", asked.latency),
            ] {
                block.set(port, value);
            }
            let chooses = percent(&mut random, 70);
            block.set("chooses", chooses);
            block.settle();
            if let Some(word) = chosen {
                block.expect("word", word);
                compared[usize::from(opcode == 3) + 2 * usize::from(opcode == 1)] += 1;
            }
            if chooses && clock >= 1 {
                let (before, index) = &asked_before[clock - 1];
                let payload = Asked { counter: asked.counter, latency: asked.latency, ..*before }.answer().payload;
                chosen = payload.and_then(|words| words.get(*index).copied());
            }
            block.edge();
            asked_before.push((asked, index));
        }
    }
    assert!(compared.iter().all(|times| *times > 50), "{compared:?}");
}
