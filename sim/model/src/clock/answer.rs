//! The contents of answers: status, length, and the words of every payload but a read-out. The hardware needs three
//! clocks for the status, and two for a word, or three for a counter.

use super::counters::Latencies;
use super::wires::Registers;
use incircle_protocol as protocol;
use protocol::{answer_header, signed_header, Config, Identity, InsertReport, Opcode, ShortIds, Status};

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Answer {
    /// Header and payload length as of one, two and three clocks ago.
    heads: [(u32, u32); 3],
    /// The counter that is wanted next, as of one clock ago.
    counter: u32,
    /// The word of the payload in its two ranks of registers.
    words: [u32; 2],
}

impl Answer {
    /// The header from this engine. The tag of the job comes in at the end, since it does not change while an answer is
    /// put together.
    pub(super) fn header(&self, engine: u8, tag: u8) -> u32 {
        signed_header(self.heads[2].0, engine, tag)
    }

    pub(super) fn length(&self) -> u32 {
        self.heads[2].1
    }

    pub(super) fn word(&self) -> u32 {
        self.words[1]
    }

    /// Simulates one clock. `index_ahead` is the index of the payload word that is wanted from the next clock on.
    pub(super) fn clock(&mut self, was: &Registers, index_ahead: usize) {
        let (status, length) = head(was);
        self.heads = [(answer_header(was.command.opcode, status), length), self.heads[0], self.heads[1]];
        self.counter = was.counted.words(was.command.refused).get(index_ahead).copied().unwrap_or(0);
    }

    /// Simulates one clock in which a word of the payload is chosen.
    pub(super) fn choose(&mut self, was: &Registers, latencies: &Latencies, config: Config, index: usize) {
        self.words = [payload(was, latencies, config, index), self.words[0]];
    }
}

/// Status and payload length of the answer to the command in the command port.
fn head(was: &Registers) -> (Status, u32) {
    let command = &was.command;
    match Opcode::of_every_device(command.opcode) {
        Some(Opcode::Hello) => (Status::Ok, protocol::IDENTITY_WORDS as u32),
        Some(Opcode::Clear) if command.is_refused => (Status::BadContexts, 0),
        Some(Opcode::Clear) => (Status::Ok, 0),
        Some(Opcode::Counters) => (Status::Ok, protocol::COUNTER_WORDS as u32),
        Some(Opcode::Latencies) => (Status::Ok, protocol::LATENCY_BUCKETS as u32),
        Some(Opcode::Insert) => {
            let status = match (was.seeder.collinear, command.refused) {
                _ if was.watchdog.stuck => Status::Stuck,
                (true, _) => Status::Collinear,
                (false, 0) => Status::Ok,
                (false, _) => Status::Full,
            };
            (status, protocol::INSERT_REPORT_WORDS as u32)
        }
        Some(Opcode::Read | Opcode::Triangles) => {
            let end = u64::from(command.first) + u64::from(command.count);
            let free = if command.opcode == Opcode::Triangles as u8 { 2 * was.kept } else { 0 };
            if end <= u64::from(was.commit.records - free) {
                let ids = 3 * command.count;
                let words = match command.short_ids {
                    _ if command.opcode == Opcode::Read as u8 => ids,
                    None => ids.div_ceil(2),
                    Some(ShortIds::Ten) => command.count,
                    Some(ShortIds::Twelve) => command.count + command.count.div_ceil(8),
                };
                (Status::Ok, words)
            } else {
                (Status::BadRange, 0)
            }
        }
        Some(_) | None => (Status::UnknownOpcode, 0),
    }
}

/// A word of a payload other than a read-out.
fn payload(was: &Registers, latencies: &Latencies, config: Config, index: usize) -> u32 {
    match Opcode::of_every_device(was.command.opcode) {
        Some(Opcode::Hello) => Identity {
            magic: protocol::MAGIC,
            protocol_version: protocol::PROTOCOL_VERSION,
            core_version: protocol::CORE_VERSION,
            coord_bits: protocol::CORE_COORD_BITS,
            capacity: config.points,
            contexts: config.contexts,
            engines: config.engines,
            ring_capacity: config.ring,
            features: was.features,
        }
        .to_words()[index],
        Some(Opcode::Insert) => InsertReport {
            arrived: was.command.arrived,
            inserted: was.counted.insertions - was.deleted,
            duplicates: was.counted.duplicates,
            refused: was.command.refused,
            records: was.commit.records - 2 * was.kept,
        }
        .to_words()[index],
        Some(Opcode::Latencies) => latencies.buckets[index],
        _ => was.responder.answer.counter,
    }
}
