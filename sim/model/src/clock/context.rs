//! The context: the phases of an insertion, the first triangle, and the bundle it pushes.

use super::memory::Write;
use super::pipeline::{Bundle, Completion, Token};
use super::wires::Wires;
use super::Registers;
use crate::mesh::Record;
use crate::predicate::Point;

/// What the context does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Phase {
    #[default]
    Idle,
    /// The first three points become a triangle and its ghosts.
    Seed,
    Walk,
    /// The located triangle is locked and its three neighbours are tested.
    Root,
    Cavity,
    Commit,
    /// The list has overflowed: tokens run out.
    Drain,
    Solo,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Context {
    pub phase: Phase,
    pub id: u32,
    pub position: Point,
    /// Where the next walk starts.
    start: u32,
    pub seeded: bool,
    pub collinear: bool,
    /// Records so far: the next fresh id.
    pub records: u32,
    /// Step of `Seed` (0: the look at the triple) and of `Root`.
    step: u32,
    /// The first three points turn left.
    turns_left: bool,
    pub root_id: u32,
    pub root: Record,
    /// The bundle that enters the queue in this clock.
    pub push: Option<Bundle>,
    pub write: Write,
}

impl Context {
    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires) {
        self.push = wires.split.or(wires.solo_push);
        self.write.valid = false;
        self.records += u32::from(was.commit.takes_fresh(was));
        match was.context.phase {
            Phase::Idle => self.take_point(was, wires),
            Phase::Seed => self.seed(was, wires),
            Phase::Walk => {
                if let Some(done) = wires.done {
                    self.walk(&done);
                }
            }
            Phase::Root => self.start_cavity(was),
            Phase::Cavity => {
                if wires.overflows {
                    self.phase = Phase::Drain;
                } else if was.cavity.outstanding == 0 {
                    self.phase = Phase::Commit;
                }
            }
            Phase::Commit => {
                if wires.commit_ends {
                    self.phase = Phase::Idle;
                    self.start = was.context.root_id;
                }
            }
            Phase::Drain => {
                if wires.drained {
                    self.phase = Phase::Solo;
                }
            }
            Phase::Solo => {
                if wires.solo_ends {
                    self.phase = Phase::Idle;
                    self.start = was.context.root_id;
                    self.records += 2;
                }
            }
        }
        if was.command.clears {
            self.seeded = false;
            self.collinear = false;
            self.records = 0;
            self.start = 0;
        }
    }

    fn take_point(&mut self, was: &Registers, wires: &Wires) {
        if !wires.takes_point {
            return;
        }
        self.id = was.command.point_id;
        self.position = was.command.point;
        if was.context.seeded {
            self.push = Some(Bundle::look(was.context.start));
            self.phase = Phase::Walk;
        } else if self.id == 2 {
            self.push = Some(Bundle::look(0));
            self.phase = Phase::Seed;
            self.step = 0;
        } else if self.id == 0 {
            // The look at the triple needs a record with the first three vertices.
            self.write = Write::record(0, [0, 1, 2], [0; 3]);
        }
    }

    /// Looks which way the first three points turn, then writes the triangle and its ghosts.
    fn seed(&mut self, was: &Registers, wires: &Wires) {
        let (b, c) = if was.context.turns_left { (1, 2) } else { (2, 1) };
        let inf = wires.infinite;
        match (was.context.step, wires.done) {
            (0, None) => return,
            (0, Some(done)) if done.turn == 0 => {
                self.collinear = true;
                self.phase = Phase::Idle;
            }
            (0, Some(done)) => self.turns_left = done.turn > 0,
            (1, _) => self.write = Write::record(0, [0, b, c], [1, 2, 3]),
            (2, _) => self.write = Write::record(1, [c, b, inf], [3, 2, 0]),
            (3, _) => self.write = Write::record(2, [0, c, inf], [1, 3, 0]),
            _ => {
                self.write = Write::record(3, [b, 0, inf], [2, 1, 0]);
                self.seeded = true;
                self.records = 4;
                self.start = 0;
                self.phase = Phase::Idle;
            }
        }
        self.step += 1;
    }

    fn walk(&mut self, done: &Completion) {
        if !done.located {
            self.push = Some(Bundle::look(done.walk_next));
            return;
        }
        self.root_id = done.token.u;
        self.root = done.record;
        self.step = 0;
        self.phase = Phase::Root;
        if done.falls_onto_corner {
            self.start = done.token.u;
            self.phase = Phase::Idle;
        }
    }

    /// Locks the root, then tests its neighbours, once the locks of the insertion before are released.
    fn start_cavity(&mut self, was: &Registers) {
        if was.release.is_busy {
            return;
        }
        let (id, n) = (was.context.root_id, was.context.root.n);
        let test = |x, u| Token { rotates: true, locks: true, x, next: (x + 1) % 3, f_entry: 0, f: id, u };
        self.push = Some(match was.context.step {
            0 => Bundle { first: Token { locks: true, u: id, ..Token::default() }, second: None },
            1 => Bundle { first: test(0, n[0]), second: Some((n[1], 1, 2)) },
            _ => Bundle { first: test(2, n[2]), second: None },
        });
        self.step += 1;
        if was.context.step == 2 {
            self.phase = Phase::Cavity;
        }
    }

    /// Visits pushed at this edge by `Root`.
    pub(super) fn root_visits(&self, was: &Registers) -> u32 {
        match (was.release.is_busy, self.step) {
            (true, _) => 0,
            (false, 1) => 2,
            (false, _) => 1,
        }
    }

    /// The last ghost is written at this edge.
    pub(super) fn seeds(&self) -> bool {
        self.step == 4
    }
}
