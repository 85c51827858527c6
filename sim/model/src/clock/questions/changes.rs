//! The changes of a mesh that stands: how the items of an `InsertAs`, and the points of an `Insert` that comes after
//! one, reach the insertion engine and end.
//!
//! Hardware twin: the block `Changes`, with `VertexCheck`, `ChangeEnds` and `LatePoints` in it.

use super::part_queue::Part;
use super::signals::{Events, Item, ItemEnd};
use crate::clock::memory::Memory;
use crate::predicate::Point;
use incircle_protocol::{Located, Outcome};
use std::collections::VecDeque;

/// The next step for the item on offer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Idle,
    Look,
    Fetch,
    Judge,
    Raise,
    Offer,
    Refuse(Outcome),
}

#[derive(Clone, Debug)]
pub(super) struct Changes {
    /// Whether an item of a change has begun since the last clear.
    pub has_changed: bool,
    state: State,
    /// A bit for each vertex: it is in use. Bits from `known` on are arbitrary.
    in_use: Vec<bool>,
    known: u32,
    /// Number of vertices that are still to be marked after a clear.
    seeding: u32,
    /// The bit that was read last, and the point of the vertex on offer if that is deleted.
    read: bool,
    place: Option<Point>,
    /// The point of an `Insert` that waits, and the context of the next one.
    late: Option<(usize, Item)>,
    turn: usize,
    /// Number of the item that each context has handed over; number and vertex of the items that are done and whose
    /// parts are not given.
    handed: Vec<u32>,
    done: VecDeque<(u32, u32)>,
}

/// The state of the blocks around at an edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Around {
    /// A run is under way, and it changes the mesh.
    pub is_active: bool,
    pub is_change: bool,
    pub deletes: bool,
    pub moves: bool,
    /// The item on offer, its vertex, and whether the queues take the item that is offered to them.
    pub dealt: Option<(usize, Item)>,
    pub vertex: u32,
    pub accepted: bool,
    /// Whether there is room for the part of an item that has not begun.
    pub has_room: bool,
    pub contexts: usize,
    pub clears: bool,
}

/// The result of an edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Done {
    /// The item on offer is done with.
    pub taken: bool,
    pub came: Option<Part>,
    /// The part that comes is that of an item that has not begun.
    pub is_noted: bool,
    /// A vertex is in the mesh.
    pub raised: Option<u32>,
}

impl Changes {
    pub(super) fn new(contexts: usize, points: u32) -> Self {
        Self {
            has_changed: false,
            state: State::Idle,
            in_use: vec![false; points as usize],
            known: 0,
            seeding: 2,
            read: false,
            place: None,
            late: None,
            turn: 0,
            handed: vec![0; contexts],
            done: VecDeque::new(),
        }
    }

    /// The item that is offered to the queues, given the item on offer of the run under way, if one is.
    pub(super) fn offered(&self, run: Option<Option<(usize, Item)>>, is_change: bool) -> Option<(usize, Item)> {
        match run {
            None => self.late,
            Some(dealt) if !is_change => dealt,
            Some(dealt) => dealt.filter(|_| self.state == State::Offer).map(|(context, item)| {
                let place = self.place.unwrap_or(item.place);
                (context, Item { place, target: item.place, ..item })
            }),
        }
    }

    /// The vertex that falls out of use with these events, because its point is that of another one.
    pub(super) fn unmarked(events: &Events, moves: bool) -> Option<u32> {
        early_end(events).filter(|end| end.duplicate.is_some() && !moves).map(|end| end.vertex)
    }

    /// Whether a point of an `Insert` waits for its context.
    pub(super) fn point_waits(&self) -> bool {
        self.late.is_some()
    }

    /// Simulates one edge; `numbers` has the number of the item of each context.
    pub(super) fn clock(&mut self, around: &Around, events: &Events, numbers: &[Item], memory: &Memory) -> Done {
        let mut done = Done { raised: events.committed.map(|(_, vertex)| vertex), ..Done::default() };
        let number = |end: ItemEnd| numbers[end.context].number;
        let ends = events.ends.or(events.fill_ends);
        let early = early_end(events);
        if let Some(end) = ends.filter(|end| !stays(end)) {
            self.handed[end.context] = number(end);
        }
        if let Some(end) = events.solo_ends.filter(|end| end.duplicate.is_none()) {
            done.raised = Some(end.vertex);
        }
        let runs = around.is_active && around.is_change;
        self.done.extend(events.committed.filter(|_| runs).map(|(context, vertex)| (self.handed[context], vertex)));
        let refusal = match self.state {
            State::Refuse(outcome) => Some(outcome),
            _ => None,
        };
        done.came = match early {
            Some(end) => {
                let outcome = if end.duplicate.is_some() { Outcome::Duplicate } else { Outcome::Done };
                let outcome = end.early.unwrap_or(outcome);
                Some(part(number(end), outcome, end.duplicate.unwrap_or(end.vertex)))
            }
            None => self.done.pop_front().map(|(number, vertex)| part(number, Outcome::Done, vertex)),
        };
        if done.came.is_none() && around.has_room {
            if let (Some(outcome), Some((_, item))) = (refusal, around.dealt) {
                done.came = Some(part(item.number, outcome, around.vertex));
                done.is_noted = true;
            }
        }
        done.came = done.came.filter(|_| runs);
        done.taken = around.is_active && around.accepted || done.is_noted;
        self.check(around, events, early, &done, memory);
        self.take_late(around, events);
        self.has_changed |= events.launch.is_some();
        if around.clears {
            self.has_changed = false;
            (self.state, self.known, self.seeding) = (State::Idle, 0, 2);
            (self.late, self.turn) = (None, 0);
        }
        done
    }

    /// Looks whether the vertex of the item on offer can be inserted.
    fn check(&mut self, around: &Around, events: &Events, early: Option<ItemEnd>, done: &Done, memory: &Memory) {
        let finds = around.deletes || around.moves;
        let unmarked = Self::unmarked(events, around.moves);
        // A vertex that cannot be deleted is in use again, and so is one that has moved.
        let has_moved = |part: &Part| part.outcome != Outcome::Duplicate && around.moves && !done.is_noted;
        let moved = done.came.filter(has_moved).map(|part| part.located.vertices[0]);
        let remarked = early.filter(|end| end.early.is_some()).map(|end| end.vertex).or(moved);
        // The vertex of an item of a run has been marked by its check.
        let launched = events.launch.filter(|_| !around.is_active).map(|launch| launch.item.vertex);
        let marked = remarked.or(launched).or(events.taken);
        let is_taken = unmarked.is_some() || marked.is_some();
        let (was_known, was_seeding, vertex) = (self.known, self.seeding, around.vertex);
        if let Some(vertex) = unmarked {
            self.in_use[vertex as usize] = false;
        }
        if let Some(vertex) = marked {
            self.in_use[vertex as usize] = true;
        }
        if self.seeding > 0 && !is_taken {
            self.seeding -= 1;
            self.in_use[self.seeding as usize] = true;
        }
        self.known = self.known.max(events.arrived);
        self.state = match self.state {
            State::Idle if around.dealt.is_some() && around.is_change && was_seeding == 0 => State::Look,
            State::Idle => State::Idle,
            State::Look if is_taken || events.fetches => State::Look,
            State::Look => {
                self.place = finds.then(|| memory.vertex(vertex & 0x7fff));
                self.read = self.in_use.get(vertex as usize).copied().unwrap_or(false);
                State::Fetch
            }
            State::Fetch => State::Judge,
            State::Judge if finds => self.judge_deletion(vertex, was_known, is_taken),
            State::Judge if vertex as usize >= self.in_use.len() => State::Refuse(Outcome::Full),
            State::Judge if vertex >= was_known => State::Raise,
            State::Judge if self.read => State::Refuse(Outcome::InUse),
            State::Judge if is_taken => State::Judge,
            State::Judge => {
                self.in_use[vertex as usize] = true;
                State::Offer
            }
            State::Raise if is_taken => State::Raise,
            State::Raise => {
                self.in_use[was_known as usize] = was_known == vertex;
                self.known = was_known + 1;
                if was_known == vertex {
                    State::Offer
                } else {
                    State::Raise
                }
            }
            State::Offer if around.accepted => State::Idle,
            State::Offer => State::Offer,
            State::Refuse(_) if done.is_noted => State::Idle,
            State::Refuse(outcome) => State::Refuse(outcome),
        };
    }

    /// Decides whether a vertex can be deleted or moved. From then on it is not in use.
    fn judge_deletion(&mut self, vertex: u32, known: u32, is_taken: bool) -> State {
        match () {
            () if vertex >= known || !self.read => State::Refuse(Outcome::Missing),
            () if is_taken => State::Judge,
            () => {
                self.in_use[vertex as usize] = false;
                State::Offer
            }
        }
    }

    /// Keeps a point of an `Insert` until its context takes it.
    fn take_late(&mut self, around: &Around, events: &Events) {
        if around.accepted && !around.is_active {
            self.late = None;
        }
        if let Some((vertex, place)) = events.arrival.filter(|_| self.has_changed) {
            self.late = Some((self.turn, Item { number: 0, place, vertex, target: place }));
            self.turn = (self.turn + 1) % around.contexts;
        }
    }
}

/// Whether an item ends without a commit: its vertex is a duplicate, or stays where it is, or has moved in place.
fn stays(end: &ItemEnd) -> bool {
    end.duplicate.is_some() || end.early.is_some()
}

/// The item that ends without a commit, or with its solo insertion.
fn early_end(events: &Events) -> Option<ItemEnd> {
    events.ends.or(events.fill_ends).filter(stays).or(events.solo_ends)
}

/// A part that names one vertex.
fn part(number: u32, outcome: Outcome, vertex: u32) -> Part {
    Part { number, outcome, located: Located { vertices: [vertex, 0, 0], weights: [0; 3] } }
}
