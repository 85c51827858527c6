//! Takes command words: opcodes, arguments, and points one at a time.
//!
//! Hardware twin: the block `CommandPort`.

use super::wires::{Registers, Wires};
use incircle_protocol::{
    command_contexts, command_meshes, command_opcode, command_starts_batch, command_tag, Config, Opcode, ShortIds,
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

/// The check whether the number of jobs divides that of the contexts. Each clock counts one more member of every team,
/// so it adds the number of jobs to the sum. The numbers divide if the sum meets that of the contexts.
#[derive(Clone, Copy, Debug, Default)]
struct Check {
    contexts: u32,
    jobs: u32,
    /// Contexts that are counted.
    sum: u32,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CommandPort {
    pub state: State,
    pub opcode: u8,
    /// The form of the ids that a `Triangles` asks for.
    pub short_ids: Option<ShortIds>,
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
    /// Number of jobs side by side, each with a mesh of its own and a team of contexts; 1 outside a batch.
    pub jobs: u32,
    /// The `Clear` whose numbers are being checked.
    checked: Option<Check>,
    /// Whether a `Clear` asked for more contexts than there are, or for a number of jobs that does not divide them.
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
    pub(super) fn is_ready(&self, was: &Registers, sweeps: bool, point_waits: bool) -> bool {
        // The fourth point waits until the first three are known to span a triangle; in a batch, the point after the
        // first three of every job waits.
        let start_is_open = was.seeder.has_triple && !was.seeder.seeded && !was.seeder.collinear;
        match self.state {
            State::Command => !sweeps,
            State::First | State::Count => true,
            State::Points => self.count != 0 && !self.came && !point_waits && (!start_is_open || was.watchdog.stuck),
            State::Settle | State::Answer => false,
        }
    }

    /// Whether points are accepted and not refused.
    pub(super) fn stores_points(&self, was: &Registers, config: Config) -> bool {
        !was.seeder.collinear && !was.watchdog.stuck && self.arrived < config.points
    }

    /// Whether a `Clear` is being carried out.
    pub(super) fn is_clearing(&self) -> bool {
        self.clears || self.checked.is_some()
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, config: Config) {
        self.clears = false;
        self.came = false;
        self.check();
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

    /// Takes note that an item of a change has put this vertex into the mesh: later points have higher ids.
    pub(super) fn raise(&mut self, vertex: u32) {
        self.arrived = self.arrived.max(vertex + 1);
    }

    /// Counts one more member of each team.
    fn check(&mut self) {
        let Some(Check { contexts, jobs, sum }) = self.checked.take() else {
            return;
        };
        let sum = sum + jobs;
        if sum == contexts {
            self.clears = true;
            (self.contexts, self.jobs) = (contexts, jobs);
        } else if sum > contexts {
            self.is_refused = true;
        } else {
            self.checked = Some(Check { contexts, jobs, sum });
        }
    }

    fn take_command(&mut self, word: u32, config: Config) {
        let opcode = command_opcode(word);
        let asked = command_contexts(word);
        self.opcode = opcode;
        self.short_ids = ShortIds::of_word(word);
        let is_clear = opcode == Opcode::Clear as u8;
        self.is_refused = is_clear && asked > config.contexts;
        if is_clear {
            self.tag = command_tag(word);
        }
        if is_clear && !self.is_refused {
            let contexts = if asked == 0 { config.contexts } else { asked };
            self.checked = Some(match command_meshes(word) {
                // Outside a batch nothing has to be counted.
                _ if !command_starts_batch(word) => Check { contexts, jobs: 1, sum: contexts - 1 },
                0 => Check { contexts, jobs: contexts, sum: 0 },
                jobs => Check { contexts, jobs, sum: 0 },
            });
        }
        self.state = match Opcode::of_every_device(opcode) {
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
