//! Sends answers: header and length in one beat, then the payload.
//!
//! Hardware twin: the block `Responder`.

use super::answer::Answer;
use super::beat::Beat;
use super::command_port::State as CommandState;
use super::counters::Latencies;
use super::record_reads::{Event, Form, RecordReads};
use super::wires::{Registers, Wires};
use incircle_protocol::{Config, Opcode};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum State {
    #[default]
    Idle,
    /// Status and length are computed.
    Prepare,
    Header,
    /// A word of the payload is chosen.
    Choose,
    Payload,
    Records,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Responder {
    state: State,
    /// Whether the first of the two clocks of `Prepare` or `Choose` is over.
    waited: bool,
    /// Number of this engine on the chip; a constant.
    pub engine: u8,
    pub answer: Answer,
    pub valid: bool,
    /// The beat that is offered. While no beat is offered, the last one stays.
    pub offered: Beat,
    /// Number of words still to be loaded, of a payload other than a read-out.
    left: u32,
    /// Number of words of that payload that are loaded.
    index: usize,
    records: RecordReads,
}

/// Whether the payload has only the vertices of records.
fn packs(was: &Registers) -> bool {
    was.command.opcode == Opcode::Triangles as u8
}

/// The form of the payload of a read-out.
fn form(was: &Registers) -> Form {
    match was.command.short_ids {
        _ if !packs(was) => Form::Whole,
        None => Form::Vertices,
        Some(ids) => Form::Short(ids),
    }
}

impl Responder {
    pub(super) fn is_idle(&self) -> bool {
        self.state == State::Idle
    }

    pub(super) fn read_request(&self) -> Option<u32> {
        self.records.request().filter(|_| self.state == State::Records)
    }

    /// Index of the payload word that is wanted from the next clock on.
    fn index_ahead(&self) -> usize {
        match self.state {
            State::Header => 0,
            State::Payload => self.index + 1,
            _ => self.index,
        }
    }

    fn loads(&self, response_ready: bool) -> bool {
        !self.valid || response_ready
    }

    /// Whether the last word is loaded at this edge.
    pub(super) fn ends(&self, response_ready: bool) -> bool {
        self.loads(response_ready) && self.next_beat(0).is_some_and(|beat| beat.last)
    }

    /// The beat that is loaded at this edge, in a job with this tag, if the beat before it is taken.
    fn next_beat(&self, tag: u8) -> Option<Beat> {
        match self.state {
            State::Idle | State::Prepare | State::Choose => None,
            State::Header => {
                let length = self.answer.length();
                Some(Beat { low: self.answer.header(self.engine, tag), high: length, both: true, last: length == 0 })
            }
            State::Payload => Some(Beat { last: self.left == 1, ..Beat::of(self.answer.word()) }),
            State::Records => self.records.beat(),
        }
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, latencies: &Latencies, config: Config) {
        self.answer.clock(was, was.responder.index_ahead());
        if was.responder.state == State::Choose {
            self.answer.choose(was, latencies, config, was.responder.index);
        }
        self.wait(was, latencies);
        let beat = was.responder.next_beat(was.command.tag).filter(|_| was.responder.loads(wires.response_ready));
        self.records.clock(Event {
            form: form(was),
            asks: wires.read.is_some(),
            done: wires.record_read,
            is_free: wires.read_is_free,
            takes: was.responder.state == State::Records && beat.is_some(),
        });
        if !was.responder.loads(wires.response_ready) {
            return;
        }
        self.valid = beat.is_some();
        if let Some(beat) = beat {
            self.offered = beat;
            self.load(was);
        }
        if wires.answer_ends {
            self.state = State::Idle;
        }
    }

    /// Takes the steps that load no word.
    fn wait(&mut self, was: &Registers, latencies: &Latencies) {
        let after = match was.responder.state {
            State::Idle => {
                if was.command.state == CommandState::Answer && !latencies.sweeps() && !was.command.is_clearing() {
                    self.state = State::Prepare;
                }
                return;
            }
            State::Prepare => State::Header,
            State::Choose => State::Payload,
            _ => return,
        };
        self.waited = !was.responder.waited;
        if was.responder.waited {
            self.state = after;
        }
    }

    /// Takes the step after the beat that is loaded at this edge.
    fn load(&mut self, was: &Registers) {
        match was.responder.state {
            State::Header => {
                self.left = was.responder.answer.length();
                self.index = 0;
                match was.skips_free && packs(was) {
                    true => self.records.start_living(was.command.first, was.command.count),
                    false => self.records.start(was.command.first, was.command.count),
                }
                let reads = was.command.opcode == Opcode::Read as u8 || packs(was);
                self.state = if reads { State::Records } else { State::Choose };
            }
            State::Payload => {
                self.left -= 1;
                self.index += 1;
                self.state = State::Choose;
            }
            _ => {}
        }
    }
}
