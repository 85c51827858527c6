//! The payload of a read-out: reads records, packs their words or the ids of their vertices without gaps, and keeps
//! the beats until they are taken.
//!
//! Hardware twin: the block `RecordReads`.

use super::beat::Beat;
use incircle_protocol::NARROW_ID_BITS;

/// Largest number of waiting beats with which more records are asked for.
const ROOM: usize = 4;
/// Number of beats that the queue holds.
const QUEUE: usize = 16;
/// Number of halves of a word, 16 bits each, in a full beat.
const FULL: usize = 4;

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RecordReads {
    record_id: u32,
    /// Number of records still to be read.
    left: u32,
    /// Whether the next record is the second of a pair. Two whole records fill three beats.
    is_second: bool,
    /// Whether no record may be asked for, because the pair before needs a clock for its third beat.
    pauses: bool,
    /// The record that has come.
    buffer: Option<[u32; 3]>,
    /// Whether a record may be asked for, since few beats wait.
    has_room: bool,
    packer: Packer,
    queue: Queue,
    /// The beat that is offered.
    head: Option<Beat>,
}

/// The events of one edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Event {
    /// Whether the payload has only vertices.
    pub packs: bool,
    /// Whether a record is asked for.
    pub asks: bool,
    /// The record that comes, if one does.
    pub done: Option<[u32; 3]>,
    /// Whether the offered beat is taken.
    pub takes: bool,
}

impl RecordReads {
    /// Begins a payload of `count` records from `first` on.
    pub(super) fn start(&mut self, first: u32, count: u32) {
        self.record_id = first;
        self.left = count;
        self.is_second = false;
        self.packer = Packer { left: count, ..Packer::default() };
    }

    /// The record that is wanted.
    pub(super) fn request(&self) -> Option<u32> {
        (self.left != 0 && self.has_room && !self.pauses).then_some(self.record_id)
    }

    /// The beat that is offered.
    pub(super) fn beat(&self) -> Option<Beat> {
        self.head
    }

    pub(super) fn clock(&mut self, event: Event) {
        let was = *self;
        let Event { packs, asks, done, takes } = event;
        self.pauses = asks && was.is_second && !packs;
        if asks {
            self.record_id += 1;
            self.left -= 1;
            self.is_second = !was.is_second;
        }
        self.buffer = done;
        let mut pops = false;
        if takes || was.head.is_none() {
            self.head = was.queue.first().or(was.packer.filled);
            pops = self.head.is_some();
        }
        self.has_room = was.queue.waiting <= ROOM;
        self.queue.clock(was.packer.filled, pops);
        self.packer.clock(was.buffer, packs);
    }
}

/// Packs halves of words without gaps.
#[derive(Clone, Copy, Debug, Default)]
struct Packer {
    /// Number of records still to come.
    left: u32,
    /// Halves that are in no beat yet, and zeros behind them.
    held: [u32; FULL],
    count: usize,
    /// Whether the held halves become a beat although no record comes.
    flushes: bool,
    /// A beat that is full, or the last one.
    filled: Option<Beat>,
}

impl Packer {
    /// Simulates one edge, at which a record comes or not.
    fn clock(&mut self, record: Option<[u32; 3]>, packs: bool) {
        let was = *self;
        (self.filled, self.flushes) = (None, false);
        if was.flushes {
            assert!(record.is_none(), "a record comes in the clock of the rest");
            let last = was.left == 0;
            *self = Self { left: was.left, filled: Some(beat_of(was.held, was.count, last)), ..Self::default() };
        }
        let Some(words) = record else {
            return;
        };
        let mut halves = [0; FULL + 6];
        halves[..FULL].copy_from_slice(&was.held);
        let mut end = was.count;
        for word in words {
            let ids = [word & ((1 << NARROW_ID_BITS) - 1)];
            let both = [word & 0xffff, word >> 16];
            for &half in if packs { &ids[..] } else { &both[..] } {
                halves[end] = half;
                end += 1;
            }
        }
        self.left = self.left.wrapping_sub(1);
        let sent = if end < FULL { 0 } else { FULL };
        self.count = end - sent;
        self.held = [0, 1, 2, 3].map(|place| halves[sent + place]);
        self.flushes = self.count == FULL || self.left == 0 && self.count != 0;
        let last = self.left == 0 && !self.flushes;
        self.filled = (sent != 0).then(|| beat_of([0, 1, 2, 3].map(|place| halves[place]), FULL, last));
    }
}

/// The beat of the first `count` halves.
fn beat_of([a, b, c, d]: [u32; FULL], count: usize, last: bool) -> Beat {
    Beat { low: a | b << 16, high: c | d << 16, both: count > 2, last }
}

/// The beats that wait. A beat may come and go at the same edge.
#[derive(Clone, Copy, Debug, Default)]
struct Queue {
    beats: [Beat; QUEUE],
    oldest: usize,
    waiting: usize,
}

impl Queue {
    fn first(&self) -> Option<Beat> {
        (self.waiting != 0).then(|| self.beats[self.oldest])
    }

    fn clock(&mut self, pushed: Option<Beat>, pops: bool) {
        if let Some(beat) = pushed {
            assert!(self.waiting < QUEUE, "beats are packed faster than there is room");
            self.beats[(self.oldest + self.waiting) % QUEUE] = beat;
            self.waiting += 1;
        }
        if pops {
            self.oldest = (self.oldest + 1) % QUEUE;
            self.waiting -= 1;
        }
    }
}
