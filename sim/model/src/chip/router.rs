//! Gives each job to an engine. A job is the words from a `Clear` up to the next one, also those of a batch.
//!
//! Hardware twin: the block `JobRouter`.

use super::places::{in_turn, MOST};
use incircle_protocol::{command_opcode, Opcode, PADDING};

/// The meaning of the word that the router holds, or of the next one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum State {
    #[default]
    Command,
    First,
    Count,
    Points,
}

/// The state of the engines, for the router.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight {
    /// The engine owes no answer.
    pub is_free: [bool; MOST],
    /// The engine has said `Stuck`, or there is none of this number.
    pub is_stuck: [bool; MOST],
    /// The engine's queue has room for a word.
    pub has_room: [bool; MOST],
}

impl Sight {
    /// The next engine in turn behind `current` that may get a job.
    fn next_free(&self, current: usize) -> Option<usize> {
        let all_are_stuck = self.is_stuck.iter().all(|&stuck| stuck);
        in_turn(current).find(|&engine| self.is_free[engine] && (all_are_stuck || !self.is_stuck[engine]))
    }
}

/// A word on its way to an engine.
#[derive(Clone, Copy, Debug)]
pub(super) struct Push {
    pub engine: usize,
    pub word: u32,
    /// The word is the first of a command.
    pub begins: bool,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct JobRouter {
    state: State,
    held: Option<u32>,
    /// Opcode of the command whose arguments come.
    opcode: u8,
    /// Number of points that are still to come.
    left: u32,
    /// The engine of the present job.
    current: usize,
    /// The engine for the next job, as of the clock before.
    target: Option<usize>,
}

impl JobRouter {
    pub(super) fn is_ready(&self) -> bool {
        self.held.is_none()
    }

    /// The word that goes to an engine at this edge.
    pub(super) fn push(&self, sight: &Sight) -> Option<Push> {
        let word = self.held?;
        let begins = self.state == State::Command;
        let engine = match begins {
            true if word == PADDING => return None,
            true if is(word, Opcode::Clear) => self.target?,
            _ => Some(self.current).filter(|&engine| sight.has_room[engine])?,
        };
        Some(Push { engine, word, begins })
    }

    /// Simulates one clock, in which this word is offered.
    pub(super) fn clock(&mut self, sight: &Sight, offered: Option<u32>) {
        let push = self.push(sight);
        self.target = sight.next_free(self.current);
        let Some(word) = self.held else {
            self.held = offered;
            return;
        };
        let is_padding = self.state == State::Command && word == PADDING;
        if push.is_some() || is_padding {
            self.held = None;
        }
        if let Some(push) = push {
            self.current = push.engine;
            self.pass(word);
        }
    }

    /// Notes what follows the word that has gone.
    fn pass(&mut self, word: u32) {
        self.state = match self.state {
            State::Command => {
                self.opcode = command_opcode(word);
                match Opcode::of_every_device(self.opcode) {
                    Some(Opcode::Insert) => State::Count,
                    Some(Opcode::Read | Opcode::Triangles) => State::First,
                    _ => State::Command,
                }
            }
            State::First => State::Count,
            State::Count if self.opcode == Opcode::Insert as u8 && word > 0 => {
                self.left = word;
                State::Points
            }
            State::Count => State::Command,
            State::Points => {
                self.left -= 1;
                if self.left == 0 {
                    State::Command
                } else {
                    State::Points
                }
            }
        };
    }
}

fn is(word: u32, opcode: Opcode) -> bool {
    command_opcode(word) == opcode as u8
}
