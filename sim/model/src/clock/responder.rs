//! Sends answers: header, length, payload; records are read from the triangle memory one at a time.

use super::answer::Answer;
use super::command_port::State as CommandState;
use super::counters::Latencies;
use super::wires::Wires;
use super::Registers;
use incircle_protocol::{Config, Opcode};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum State {
    #[default]
    Idle,
    /// Status and length are computed.
    Prepare,
    Header,
    Length,
    /// A word of the payload is chosen.
    Choose,
    Payload,
    Records,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Responder {
    state: State,
    /// The first of the two clocks of `Prepare` or `Choose` is over.
    waited: bool,
    pub answer: Answer,
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

    /// The word of the payload that is wanted from the next clock on.
    fn index_ahead(&self) -> usize {
        match self.state {
            State::Length => 0,
            State::Payload => self.index + 1,
            _ => self.index,
        }
    }

    fn loads(&self, response_ready: bool) -> bool {
        !self.valid || response_ready
    }

    /// The last word is loaded at this edge.
    pub(super) fn ends(&self, response_ready: bool) -> bool {
        self.loads(response_ready)
            && match self.state {
                State::Idle | State::Prepare | State::Header | State::Choose => false,
                State::Length => self.answer.length() == 0,
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
        self.answer.clock(was, was.responder.index_ahead());
        if was.responder.state == State::Choose {
            self.answer.choose(was, latencies, config, was.responder.index);
        }
        self.wait(was, latencies);
        if !was.responder.loads(wires.response_ready) {
            return;
        }
        match self.next_word(was) {
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

    /// Steps that load no word.
    fn wait(&mut self, was: &Registers, latencies: &Latencies) {
        let after = match was.responder.state {
            State::Idle => {
                if was.command.state == CommandState::Answer && !latencies.sweeps() && !was.command.clears {
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

    /// The word loaded at this edge, if any, and the step to the one after it.
    fn next_word(&mut self, was: &Registers) -> Option<u32> {
        match was.responder.state {
            State::Idle | State::Prepare | State::Choose => None,
            State::Header => {
                self.state = State::Length;
                Some(was.responder.answer.header())
            }
            State::Length => {
                let length = was.responder.answer.length();
                self.left = length;
                self.index = 0;
                self.column = 0;
                self.record_id = was.command.first;
                let reads = was.command.opcode == Opcode::Read as u8;
                self.state = if reads { State::Records } else { State::Choose };
                Some(length)
            }
            State::Payload => {
                self.left -= 1;
                self.index += 1;
                self.state = State::Choose;
                Some(was.responder.answer.word())
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
