//! Takes command words: opcodes, arguments, and points one at a time.
//!
//! Hardware twin: the block `CommandPort`.

use super::wires::{Registers, Wires};
use incircle_protocol::{
    command_contexts, command_meshes, command_opcode, command_starts_batch, command_tag, Config, Opcode, FIRST_ROUND,
    PADDING,
};

/// The meaning of the next word, or the event that is awaited.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum State {
    #[default]
    Command,
    First,
    Count,
    Points,
    /// The last point is taken, and the insertion engine finishes.
    Settle,
    Answer,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CommandPort {
    pub state: State,
    pub opcode: u8,
    pub first: u32,
    /// Second argument of a read, or number of points still to come of an insert.
    pub count: u32,
    pub arrived: u32,
    pub refused: u32,
    /// Whether a point came at the edge before, and is being stored.
    pub came: bool,
    pub came_id: u32,
    /// Number of contexts that work.
    pub contexts: u32,
    /// Whether each context has a mesh of its own.
    pub batch: bool,
    /// Whether a `Clear` asked for what cannot be had.
    pub is_refused: bool,
    /// The tag of the last `Clear`, refused or not.
    pub tag: u8,
    /// Whether the mesh is forgotten at the next edge.
    pub clears: bool,
    /// Set from a job's first point until its last lock is released.
    pub inserting: bool,
    /// Set from the acceptance of a read until its last word is taken.
    pub reading: bool,
}

impl CommandPort {
    pub(super) fn is_ready(&self, was: &Registers, sweeps: bool) -> bool {
        // The fourth point waits until the first three are known to span a triangle; in a batch, the point after the
        // first three of every job waits.
        let start_is_open = was.seeder.has_triple && !was.seeder.seeded && !was.seeder.collinear;
        match self.state {
            State::Command => !sweeps,
            State::First | State::Count => true,
            State::Points => self.count != 0 && !self.came && (!start_is_open || was.watchdog.stuck),
            State::Settle | State::Answer => false,
        }
    }

    /// Whether points are accepted and not refused.
    pub(super) fn stores_points(&self, was: &Registers, config: Config) -> bool {
        !was.seeder.collinear && !was.watchdog.stuck && self.arrived < config.points
    }

    /// The first of the vertices that are dealt to the contexts in turn.
    pub(super) fn dealt_from(&self) -> u32 {
        if self.batch {
            3 * self.contexts
        } else {
            FIRST_ROUND
        }
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, config: Config) {
        self.clears = false;
        self.came = false;
        let answer_taken = !was.responder.valid || wires.response_ready;
        if self.state != State::Answer && was.responder.is_idle() && answer_taken {
            self.reading = false;
        }
        match (self.state, wires.word) {
            (State::Command, Some(PADDING)) => {}
            (State::Command, Some(word)) => self.take_command(word, config),
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
            (State::Points, Some(_)) => self.take_point(was, config),
            (State::Points, None) if self.count == 0 => self.state = State::Settle,
            (State::Settle, _) if wires.is_quiet || was.watchdog.stuck => {
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

    fn take_command(&mut self, word: u32, config: Config) {
        let opcode = command_opcode(word);
        let contexts = command_contexts(word);
        self.opcode = opcode;
        let is_clear = opcode == Opcode::Clear as u8;
        let shares_contexts = command_starts_batch(word) && command_meshes(word) != 0;
        self.is_refused = is_clear && (contexts > config.contexts || shares_contexts);
        self.clears = is_clear && !self.is_refused;
        if is_clear {
            self.tag = command_tag(word);
        }
        if self.clears {
            self.contexts = if contexts == 0 { config.contexts } else { contexts };
            self.batch = command_starts_batch(word);
        }
        self.state = match Opcode::from_u8(opcode) {
            Some(Opcode::Insert) => State::Count,
            Some(Opcode::Read | Opcode::Triangles) => State::First,
            _ => State::Answer,
        };
    }

    fn take_point(&mut self, was: &Registers, config: Config) {
        self.count -= 1;
        self.inserting = true;
        if self.stores_points(was, config) {
            self.came = true;
            self.came_id = self.arrived;
            self.arrived += 1;
        } else {
            self.refused += 1;
        }
    }
}
