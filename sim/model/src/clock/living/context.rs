//! The state of a context: its items, its walk, and the lists of its attempt.

use super::item::Item;
use super::sight::Sight;
use crate::mesh::hole::{Corner, Hole, RingEdge};
use crate::mesh::Record;
use std::collections::VecDeque;

/// What a context does when it is next given a place in the queue of visits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Next {
    /// It takes an item.
    #[default]
    Item,
    /// It walks from this record.
    Walk(u32),
    /// It visits this root, under its lock.
    Root(u32),
}

/// An entry of the ring of an insertion.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Entry {
    pub first_vertex: u32,
    pub outside: u32,
    pub slot: usize,
    pub cavity_record: u32,
    pub after: u8,
}

/// The cavity of an insertion.
#[derive(Clone, Debug, Default)]
pub(super) struct Cavity {
    pub entries: Vec<Entry>,
    /// Bit `y` says that the boundary has moved across one of the two edges that the cavity record of entry `y`
    /// brought. The root uses bits 0 and 1.
    half_open: u64,
    /// Cavity records without an edge on the boundary.
    pub inner: Vec<u32>,
}

impl Cavity {
    /// Begins with the three edges of the root.
    pub(super) fn start(&mut self) {
        self.entries.clear();
        self.entries.resize(3, Entry::default());
        self.inner.clear();
        self.half_open = 0;
    }

    /// Splits an entry, so that the boundary moves across its edge, and returns the number of the new one.
    pub(super) fn split(&mut self, cavity_entry: u8, cavity_record: u32) -> u8 {
        let bit = 1 << cavity_entry;
        let half = self.half_open & bit != 0;
        let root_half = cavity_entry == 0 && half && self.half_open & 2 == 0;
        self.half_open |= bit | u64::from(root_half) << 1;
        if half && !root_half {
            self.inner.push(cavity_record);
        }
        self.entries.push(Entry::default());
        self.entries.len() as u8 - 1
    }
}

/// One of the two chains of visits that go round a star.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Chain {
    /// The record that is being visited.
    pub target: Option<u32>,
    /// The record that was visited last.
    pub last: u32,
}

impl Chain {
    /// Whether the other chain, which wants to go on to `id`, meets this one there.
    pub(super) fn is_met_at(&self, id: u32) -> bool {
        self.target == Some(id) || self.last == id
    }
}

/// The star of a vertex, as far as it has been visited.
#[derive(Clone, Debug, Default)]
pub(super) struct Star {
    /// The ring edges from the root on: those to the left, counter-clockwise, and those to the right.
    left: Vec<RingEdge>,
    right: Vec<RingEdge>,
    /// The last corner on each side.
    pub end: [u32; 2],
    /// The chains to the right and to the left.
    pub chains: [Chain; 2],
    /// Whether the vertex that moves keeps its edges, as far as is known.
    pub keeps: bool,
}

impl Star {
    /// Begins with the root, turned so that the vertex comes first.
    pub(super) fn start(&mut self, root: u32, record: &Record) {
        let [_, a, b] = record.v;
        self.left.clear();
        self.right.clear();
        let chain = |target: u32| Chain { target: Some(target), last: root };
        self.chains = [chain(record.n[2]), chain(record.n[1])];
        self.end = [a, b];
        self.left.push(RingEdge { from: a, record: root, outside: record.n[0], ..RingEdge::default() });
    }

    /// Adds the record that a chain has visited, turned so that the vertex comes first, and returns its place.
    pub(super) fn add(&mut self, left: bool, id: u32, record: &Record) -> i8 {
        let [_, a, b] = record.v;
        let edge = RingEdge { from: a, record: id, outside: record.n[0], ..RingEdge::default() };
        self.end[usize::from(left)] = if left { b } else { a };
        if left {
            self.left.push(edge);
            self.left.len() as i8 - 1
        } else {
            self.right.push(edge);
            -(self.right.len() as i8)
        }
    }

    /// The edge at a place: 0 is the root, and places to the left are positive.
    pub(super) fn edge_mut(&mut self, place: i8) -> Option<&mut RingEdge> {
        match place {
            0.. => self.left.get_mut(place as usize),
            _ => self.right.get_mut((-1 - i16::from(place)) as usize),
        }
    }

    /// Number of records.
    pub(super) fn len(&self) -> usize {
        self.left.len() + self.right.len()
    }

    /// All edges, counter-clockwise.
    pub(super) fn ring(&self) -> impl Iterator<Item = RingEdge> + '_ {
        self.right.iter().rev().chain(&self.left).copied()
    }
}

/// The part of a hole that is being filled.
#[derive(Clone, Debug, Default)]
pub(super) struct Filler {
    pub hole: Hole,
    pub part: Vec<Corner>,
    /// Places of the best apex so far, and of the vertex that is tested against it.
    pub best: usize,
    pub tested: usize,
}

/// The state of a context.
#[derive(Clone, Debug, Default)]
pub(super) struct Context {
    /// Items that wait for this context.
    pub items: VecDeque<Item>,
    pub item: Option<Item>,
    pub sight: Sight,
    /// The clock in which the context took its item.
    pub since: u64,
    /// Whether the walk is that of an insertion, as the second half of a move is.
    pub inserts: bool,
    pub next: Next,
    /// The clock in which the context is ready again after an abort.
    pub rests_until: Option<u64>,
    /// The root that is visited when the locks of the last attempt are released.
    pub held_root: Option<u32>,
    /// The record at which the next walk begins.
    pub hint: u32,
    /// A record that names the vertex of the next item, if the last attempt met one: outside its ring, or in its star.
    pub near: [Option<u32>; 2],
    /// Number of visits of the attempt in flight.
    pub in_flight: u32,
    pub drains: bool,
    /// Number of commits and releases that are due.
    pub due: u32,
    pub aborts: u32,
    /// Whether the context rests when its locks are released.
    pub will_rest: bool,
    pub overflows: bool,
    pub log: Vec<u32>,
    pub root: u32,
    pub cavity: Cavity,
    pub star: Star,
    pub filler: Filler,
    /// Ghost triangle and hull edge of the search for the first visible edge.
    pub hull: [u32; 2],
    /// The chains of the search for the nearest vertex, the record at which they began, and the record where a nearer
    /// vertex was found.
    pub chains: [Chain; 2],
    pub closer: Option<(u32, Record, usize, [bool; 2])>,
}

impl Context {
    /// Whether the context has nothing to do.
    pub(super) fn is_idle(&self) -> bool {
        self.item.is_none() && self.items.is_empty() && self.due == 0
    }
}
