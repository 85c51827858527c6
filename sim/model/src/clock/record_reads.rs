//! The payload of a read-out: reads records, packs their words or the ids of their vertices without gaps, and keeps
//! the beats until they are taken.
//!
//! Hardware twin: the block `RecordReads`.

use super::beat::Beat;
use incircle_protocol::{ShortIds, NARROW_ID_BITS};

/// Largest number of waiting beats with which more records are asked for.
const ROOM: usize = 4;
/// Number of beats that the queue holds.
const QUEUE: usize = 16;
/// Number of halves of a word, 16 bits each, in a full beat.
const FULL: usize = 4;
/// Number of records whose rests share a word, with short ids of 12 bits.
const GROUP: u32 = 8;
/// Most halves that a record brings.
const MOST_BROUGHT: usize = 6;

/// The words of a record that a payload has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Form {
    /// All of them.
    #[default]
    Whole,
    /// The vertices, 16 bits each.
    Vertices,
    /// The vertices, with short ids.
    Short(ShortIds),
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RecordReads {
    record_id: u32,
    /// Number of records still to be read, or still to come if free ones are left out.
    left: u32,
    /// Whether free records are left out, and the number of others that are passed over first.
    skips: bool,
    passes: u32,
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
    pub form: Form,
    /// Whether a record is asked for.
    pub asks: bool,
    /// The record that comes, if one does.
    pub done: Option<[u32; 3]>,
    /// Whether that record is free.
    pub is_free: bool,
    /// Whether the offered beat is taken.
    pub takes: bool,
}

impl RecordReads {
    /// Begins a payload of `count` records that are not free, from the one of number `first` on.
    pub(super) fn start_living(&mut self, first: u32, count: u32) {
        self.start(0, count);
        self.skips = true;
        self.passes = first;
    }

    /// Begins a payload of `count` records from `first` on.
    pub(super) fn start(&mut self, first: u32, count: u32) {
        self.record_id = first;
        self.left = count;
        self.is_second = false;
        (self.skips, self.passes) = (false, 0);
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
        let Event { form, asks, done, is_free, takes } = event;
        self.pauses = asks && was.is_second && form == Form::Whole;
        if asks {
            self.record_id += 1;
            self.left -= u32::from(!was.skips);
            self.is_second = !was.is_second;
        }
        self.buffer = done.filter(|_| !was.skips || self.counts(is_free));
        let mut pops = false;
        if takes || was.head.is_none() {
            self.head = was.queue.first().or(was.packer.filled);
            pops = self.head.is_some();
        }
        self.has_room = was.queue.waiting <= ROOM;
        self.queue.clock(was.packer.filled, pops);
        self.packer.clock(was.buffer, form);
    }
}

impl RecordReads {
    /// Whether a record that comes belongs to the payload, from which free ones are left out.
    fn counts(&mut self, is_free: bool) -> bool {
        if is_free || self.left == 0 {
            return false;
        }
        if self.passes > 0 {
            self.passes -= 1;
            return false;
        }
        self.left -= 1;
        true
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
    /// With short ids of 12 bits, the rests of the records of the group so far, the last one on top, and the number of
    /// these records.
    rests: u32,
    in_group: u32,
    /// A beat that is full, or the last one.
    filled: Option<Beat>,
}

impl Packer {
    /// Simulates one edge, at which a record comes or not.
    fn clock(&mut self, record: Option<[u32; 3]>, form: Form) {
        let was = *self;
        (self.filled, self.flushes) = (None, false);
        if was.flushes {
            assert!(record.is_none(), "a record comes in the clock of the rest");
            let last = was.left == 0;
            (self.held, self.count) = ([0; FULL], 0);
            self.filled = Some(beat_of(was.held, was.count, last));
        }
        let Some(words) = record else {
            return;
        };
        self.left = self.left.wrapping_sub(1);
        let mut halves = [0; FULL + MOST_BROUGHT];
        halves[..FULL].copy_from_slice(&was.held);
        let (brought, number) = self.halves(words, form);
        let end = was.count + number;
        halves[was.count..end].copy_from_slice(&brought[..number]);
        let sent = if end < FULL { 0 } else { FULL };
        self.count = end - sent;
        self.held = [0, 1, 2, 3].map(|place| halves[sent + place]);
        self.flushes = self.count == FULL || self.left == 0 && self.count != 0;
        let last = self.left == 0 && !self.flushes;
        self.filled = (sent != 0).then(|| beat_of([0, 1, 2, 3].map(|place| halves[place]), FULL, last));
    }

    /// The halves that a record brings, and their number.
    fn halves(&mut self, words: [u32; 3], form: Form) -> ([u32; MOST_BROUGHT], usize) {
        let [v0, v1, v2] = words.map(|word| word & ((1 << NARROW_ID_BITS) - 1));
        let ids = match form {
            Form::Whole => {
                let [a, b, c] = words.map(|word| [word & 0xffff, word >> 16]);
                return ([a[0], a[1], b[0], b[1], c[0], c[1]], 6);
            }
            Form::Vertices => return ([v0, v1, v2, 0, 0, 0], 3),
            Form::Short(ids) => ids,
        };
        let low = v0 & 0x3ff | (v1 & 0x3ff) << 10 | (v2 & 0x3ff) << 20 | (v0 >> 10 & 3) << 30;
        let own = [low & 0xffff, low >> 16, 0, 0, 0, 0];
        if ids == ShortIds::Ten {
            return (own, 2);
        }
        self.rests = self.rests >> 4 | (v1 >> 10 & 3 | (v2 >> 10 & 3) << 2) << 28;
        self.in_group += 1;
        if self.in_group < GROUP && self.left > 0 {
            return (own, 2);
        }
        let rests = std::mem::take(&mut self.rests);
        self.in_group = 0;
        ([own[0], own[1], rests & 0xffff, rests >> 16, 0, 0], 4)
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
