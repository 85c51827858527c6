//! Sends answers: header, length, payload; records are read from the triangle memory one at a time.

use super::command_port::State as CommandState;
use super::counters::Latencies;
use super::wires::Wires;
use super::Registers;
use incircle_protocol as protocol;
use protocol::{answer_header, Config, Identity, InsertReport, Opcode, Status};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum State {
    #[default]
    Idle,
    Header,
    Length,
    Payload,
    Records,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Responder {
    state: State,
    pub valid: bool,
    pub data: u32,
    /// Words still to be loaded.
    left: u32,
    /// Words of the payload loaded.
    index: usize,
    record_id: u32,
    /// A record has been asked for and has not come.
    fetching: bool,
    buffer_valid: bool,
    buffer: [u32; 3],
    /// Word of the buffer that is loaded next.
    column: usize,
}

impl Responder {
    pub(super) fn is_idle(&self) -> bool {
        self.state == State::Idle
    }

    pub(super) fn read_request(&self) -> Option<u32> {
        let asks = self.state == State::Records && !self.fetching && !self.buffer_valid;
        asks.then_some(self.record_id)
    }

    fn loads(&self, response_ready: bool) -> bool {
        !self.valid || response_ready
    }

    /// The last word is loaded at this edge.
    pub(super) fn ends(&self, was: &Registers, response_ready: bool) -> bool {
        self.loads(response_ready)
            && match self.state {
                State::Idle | State::Header => false,
                State::Length => answer(was).1 == 0,
                State::Payload => self.left == 1,
                State::Records => self.left == 1 && self.buffer_valid,
            }
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, latencies: &Latencies, config: Config) {
        if self.read_request().is_some() {
            self.fetching = true;
        }
        if let Some(words) = wires.record_read {
            self.fetching = false;
            self.buffer = words;
            self.buffer_valid = true;
            self.record_id += 1;
        }
        if was.responder.state == State::Idle
            && was.command.state == CommandState::Answer
            && !latencies.sweeps()
            && !was.command.clears
        {
            self.state = State::Header;
        }
        if !was.responder.loads(wires.response_ready) {
            return;
        }
        match self.next_word(was, latencies, config) {
            Some(word) => {
                self.valid = true;
                self.data = word;
            }
            None => self.valid = false,
        }
        if wires.answer_ends {
            self.state = State::Idle;
        }
    }

    /// The word loaded at this edge, if any, and the step to the one after it.
    fn next_word(&mut self, was: &Registers, latencies: &Latencies, config: Config) -> Option<u32> {
        match was.responder.state {
            State::Idle => None,
            State::Header => {
                self.state = State::Length;
                Some(answer_header(was.command.opcode, answer(was).0))
            }
            State::Length => {
                let length = answer(was).1;
                self.left = length;
                self.index = 0;
                self.column = 0;
                self.record_id = was.command.first;
                let reads = was.command.opcode == Opcode::Read as u8;
                self.state = if reads { State::Records } else { State::Payload };
                Some(length)
            }
            State::Payload => {
                self.left -= 1;
                self.index += 1;
                Some(payload(was, latencies, config, was.responder.index))
            }
            State::Records if !was.responder.buffer_valid => None,
            State::Records => {
                self.left -= 1;
                self.column = (self.column + 1) % 3;
                self.buffer_valid = self.column != 0;
                Some(was.responder.buffer[was.responder.column])
            }
        }
    }
}

/// Status and payload length of the answer to the command that stands in the command port.
fn answer(was: &Registers) -> (Status, u32) {
    let command = &was.command;
    match Opcode::from_u8(command.opcode) {
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
        Some(Opcode::Read) => {
            let end = u64::from(command.first) + u64::from(command.count);
            if end <= u64::from(was.commit.records) {
                (Status::Ok, 3 * command.count)
            } else {
                (Status::BadRange, 0)
            }
        }
        None => (Status::UnknownOpcode, 0),
    }
}

/// A word of a payload that is no record.
fn payload(was: &Registers, latencies: &Latencies, config: Config, index: usize) -> u32 {
    match Opcode::from_u8(was.command.opcode) {
        Some(Opcode::Hello) => Identity {
            magic: protocol::MAGIC,
            protocol_version: protocol::PROTOCOL_VERSION,
            core_version: protocol::CORE_VERSION,
            coord_bits: protocol::CORE_COORD_BITS,
            capacity: config.points,
            contexts: config.contexts,
            ring_capacity: config.ring,
        }
        .to_words()[index],
        Some(Opcode::Insert) => InsertReport {
            arrived: was.command.arrived,
            inserted: was.counters.insertions,
            duplicates: was.counters.duplicates,
            refused: was.command.refused,
            records: was.commit.records,
        }
        .to_words()[index],
        Some(Opcode::Latencies) => latencies.buckets[index],
        _ => was.counters.words(was.command.refused)[index],
    }
}
