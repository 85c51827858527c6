//! The port that takes the words of a run, and deals its items to the contexts in turn.
//!
//! Hardware twin: the block `RunPort`, with `ItemDealer` and `RunAnswer` in it.

use super::part_queue::Head;
use super::signals::{Item, Signals};
use crate::predicate::Point;
use incircle_protocol::{part_item, RunKind, Status};

/// The meaning of the next word, or the event that is awaited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Idle,
    Count,
    Judge,
    Items,
    Refused,
    Settle,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct RunPort {
    state: State,
    /// The kind of the run under way, or of the last one.
    kind: RunKind,
    count: u32,
    left: u32,
    /// The status of a run that is refused.
    refusal: Option<Status>,
    /// Whether the head of the answer is given in this clock.
    answers: bool,
    held: Option<(usize, Item)>,
    /// The first word of the item of two words that is coming, and that of the item on offer.
    first: Option<u32>,
    vertex: u32,
    context: usize,
    number: u32,
}

impl RunPort {
    pub(super) fn new() -> Self {
        Self {
            state: State::Idle,
            kind: RunKind::Locate,
            count: 0,
            left: 0,
            refusal: None,
            answers: false,
            held: None,
            first: None,
            vertex: 0,
            context: 0,
            number: 0,
        }
    }

    pub(super) fn is_active(&self) -> bool {
        self.state != State::Idle
    }

    /// The kind of the run under way, or of the last one.
    pub(super) fn kind(&self) -> RunKind {
        self.kind
    }

    pub(super) fn is_ready(&self) -> bool {
        match self.state {
            State::Count => true,
            State::Items => self.left > 0 && self.held.is_none(),
            State::Refused => self.left > 0,
            State::Idle | State::Judge | State::Settle => false,
        }
    }

    /// Whether the run under way changes the mesh, or the last one did.
    pub(super) fn is_change(&self) -> bool {
        self.kind.is_change()
    }

    /// The vertex of the item on offer, which can be any word.
    pub(super) fn vertex(&self) -> u32 {
        self.vertex
    }

    /// The item on offer to its context.
    pub(super) fn dealt(&self) -> Option<(usize, Item)> {
        self.held
    }

    /// The head of the answer, if it is given in this clock.
    pub(super) fn head(&self, signature: u32) -> Option<Head> {
        let status = self.refusal.map_or(0, |status| status as u32);
        let parts = if self.refusal.is_none() { self.count } else { 0 };
        let words = self.kind.part_words();
        let header = (self.kind.opcode() as u32) << 24 | status << 16 | signature;
        self.answers.then_some(Head { header, length: parts * words as u32, parts, beats: words / 2 })
    }

    /// Simulates one edge; `is_over` says that the answer has been taken.
    pub(super) fn clock(&mut self, signals: &Signals, taken: bool, is_over: bool) {
        let was = *self;
        let word = signals.word.filter(|_| was.is_ready());
        if taken {
            self.held = None;
        }
        self.answers = false;
        match was.state {
            State::Idle => {
                if let Some(kind) = signals.begins {
                    *self = Self { state: State::Count, kind, ..*self };
                    (self.context, self.number, self.first) = (0, 0, None);
                }
            }
            State::Count => {
                if let Some(count) = word {
                    (self.count, self.left, self.state) = (count, count, State::Judge);
                }
            }
            State::Judge => self.judge(signals.has_mesh),
            State::Items => {
                if let Some(word) = word {
                    match self.first.take() {
                        None if self.kind.has_vertex() && self.kind.has_point() => self.first = Some(word),
                        first => self.hold(first, word, signals.contexts),
                    }
                }
                if was.left == 0 && was.held.is_none() && !was.answers {
                    self.state = State::Settle;
                }
            }
            State::Refused => {
                if let Some(word) = word {
                    match self.first.take() {
                        None if self.kind.has_vertex() && self.kind.has_point() => self.first = Some(word),
                        _ => self.left -= 1,
                    }
                }
                if was.left == 0 {
                    (self.answers, self.state) = (true, State::Settle);
                }
            }
            State::Settle => {
                if is_over && !was.answers {
                    self.state = State::Idle;
                }
            }
        }
    }

    /// Decides whether the run is done.
    fn judge(&mut self, has_mesh: bool) {
        let is_too_long = self.count.checked_mul(self.kind.part_words() as u32).is_none();
        self.refusal = match has_mesh {
            false => Some(Status::NoMesh),
            true => is_too_long.then_some(Status::BadRange),
        };
        self.answers = self.refusal.is_none();
        self.state = if self.answers { State::Items } else { State::Refused };
    }

    fn hold(&mut self, first: Option<u32>, word: u32, contexts: usize) {
        let place = Point { x: word & 0xffff, y: word >> 16 };
        // The item of a `Delete` has no point: its word is the vertex.
        self.vertex = first.unwrap_or(word);
        self.held = Some((self.context, Item { number: self.number, place, vertex: self.vertex, target: place }));
        self.number = part_item(self.number + 1);
        self.context = (self.context + 1) % contexts;
        self.left -= 1;
    }
}
