//! Takes command words: opcodes, arguments, and points one at a time.

use super::wires::{point, Wires};
use super::Registers;
use crate::predicate::Point;
use incircle_protocol::{command_opcode, Config, Opcode};

/// What the next word means, or what is awaited.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum State {
    #[default]
    Command,
    First,
    Count,
    Points,
    /// The last point is taken; the engine finishes.
    Settle,
    Answer,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CommandPort {
    pub state: State,
    pub opcode: u8,
    pub first: u32,
    /// Second argument of a read; points still to come of an insert.
    pub count: u32,
    pub arrived: u32,
    pub refused: u32,
    pub point_valid: bool,
    pub point_id: u32,
    pub point: Point,
    /// The mesh is forgotten at the next edge.
    pub clears: bool,
    /// Between a job's first point and its last lock released.
    pub inserting: bool,
    /// Between a read accepted and its last word taken.
    pub reading: bool,
}

impl CommandPort {
    pub(super) fn is_ready(&self, was: &Registers) -> bool {
        // The fourth point waits until the first three are known to span a triangle.
        let start_is_open = self.arrived == 3 && !was.context.seeded && !was.context.collinear;
        match self.state {
            State::Command => !was.release.sweeps,
            State::First | State::Count => true,
            State::Points => self.count != 0 && !self.point_valid && !start_is_open,
            State::Settle | State::Answer => false,
        }
    }

    /// Points are taken in, not refused.
    pub(super) fn stores_points(&self, was: &Registers, config: Config) -> bool {
        !was.context.collinear && self.arrived < config.points
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, config: Config) {
        self.clears = false;
        if wires.takes_point {
            self.point_valid = false;
        }
        let answer_taken = !was.responder.valid || wires.response_ready;
        if self.state != State::Answer && was.responder.is_idle() && answer_taken {
            self.reading = false;
        }
        match (self.state, wires.word) {
            (State::Command, Some(word)) => self.take_command(command_opcode(word)),
            (State::First, Some(word)) => {
                self.first = word;
                self.state = State::Count;
            }
            (State::Count, Some(word)) => {
                self.count = word;
                let inserts = self.opcode == Opcode::Insert as u8;
                self.reading |= !inserts;
                self.state = if inserts { State::Points } else { State::Answer };
            }
            (State::Points, Some(word)) => self.take_point(word, was, config),
            (State::Points, None) if self.count == 0 => self.state = State::Settle,
            (State::Settle, _) if wires.is_quiet => {
                self.inserting = false;
                self.state = State::Answer;
            }
            (State::Answer, _) if wires.answer_ends => self.state = State::Command,
            _ => {}
        }
        if was.command.clears {
            self.arrived = 0;
            self.refused = 0;
        }
    }

    fn take_command(&mut self, opcode: u8) {
        self.opcode = opcode;
        self.clears = opcode == Opcode::Clear as u8;
        self.state = match Opcode::from_u8(opcode) {
            Some(Opcode::Insert) => State::Count,
            Some(Opcode::Read) => State::First,
            _ => State::Answer,
        };
    }

    fn take_point(&mut self, word: u32, was: &Registers, config: Config) {
        self.count -= 1;
        self.inserting = true;
        if self.stores_points(was, config) {
            self.point_valid = true;
            self.point_id = self.arrived;
            self.point = point(word);
            self.arrived += 1;
        } else {
            self.refused += 1;
        }
    }
}
