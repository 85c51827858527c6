//! The payload of a read-out: reads records, one at a time for all their words, or one in each clock
//! for their vertices only.
//!
//! Hardware twin: the block `RecordReads`.

use super::beat::Beat;
use incircle_protocol::NARROW_ID_BITS;

/// Largest number of waiting beats with which more records are asked for.
const ROOM: usize = 4;
/// Number of beats that the queue holds.
const QUEUE: usize = 16;
/// Number of records that fill whole beats.
const GROUP: usize = 4;

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RecordReads {
    record_id: u32,
    /// Number of records still to be read.
    left: u32,
    /// Whether a record has been asked for and has not come.
    fetching: bool,
    buffer_valid: bool,
    buffer: [u32; 3],
    /// The word of the buffer that is sent next.
    column: usize,
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
        self.packer.place = 0;
        self.packer.left = count;
    }

    /// The record that is wanted.
    pub(super) fn request(&self, packs: bool) -> Option<u32> {
        let may_ask = if packs { self.has_room } else { !self.fetching && !self.buffer_valid };
        (self.left != 0 && may_ask).then_some(self.record_id)
    }

    /// The beat that is offered.
    pub(super) fn beat(&self) -> Option<Beat> {
        self.head
    }

    /// The beat that is offered next.
    fn next_beat(&self, packs: bool) -> Option<Beat> {
        if packs {
            return self.queue.first().or(self.packer.filled);
        }
        let last = self.column == 2 && self.left == 0;
        self.buffer_valid.then(|| Beat { last, ..Beat::of(self.buffer[self.column]) })
    }

    pub(super) fn clock(&mut self, event: Event) {
        let was = *self;
        let Event { packs, asks, done, takes } = event;
        if asks {
            self.fetching = true;
            self.record_id += 1;
            self.left -= 1;
        }
        let packed = packs && was.buffer_valid;
        if packed {
            self.buffer_valid = false;
        }
        if let Some(words) = done {
            self.fetching = false;
            self.buffer = words;
            self.buffer_valid = true;
        }
        let mut moves = false;
        if takes || was.head.is_none() {
            self.head = was.next_beat(packs);
            moves = self.head.is_some();
        }
        if moves && !packs {
            self.column = (was.column + 1) % 3;
            self.buffer_valid = self.column != 0;
        }
        self.has_room = was.queue.waiting <= ROOM;
        self.queue.clock(was.packer.filled, moves && packs);
        self.packer.clock(packed.then(|| was.buffer.map(|word| word & ((1 << NARROW_ID_BITS) - 1))));
    }
}

/// Packs ids of 16 bits without gaps.
#[derive(Clone, Copy, Debug, Default)]
struct Packer {
    /// Number of records still to come.
    left: u32,
    /// Number of records of the current group that have come.
    place: usize,
    /// Ids that are in no beat yet.
    held: [u32; 3],
    /// Whether the rest of the last record is due.
    flushes: bool,
    /// A beat that is full, or the last one.
    filled: Option<Beat>,
}

impl Packer {
    /// Simulates one edge, at which a record comes or not.
    fn clock(&mut self, record: Option<[u32; 3]>) {
        let was = *self;
        let is_last = was.left == 1;
        let ends_full = is_last && was.place == GROUP - 1;
        (self.filled, self.flushes) = (None, record.is_some() && is_last && !ends_full);
        if record.is_some() {
            self.left = self.left.wrapping_sub(1);
        }
        // The rest is packed as if a record of zeros had come.
        let Some([a, b, c]) = record.or(was.flushes.then_some([0; 3])) else {
            return;
        };
        let [x, y, z] = was.held;
        let (halves, held) = match was.place {
            0 => (None, [a, b, c]),
            1 => (Some([x, y, z, a]), [b, c, z]),
            2 => (Some([x, y, a, b]), [c, y, z]),
            _ => (Some([x, a, b, c]), [c, y, z]),
        };
        self.held = held;
        self.place = (was.place + 1) % GROUP;
        self.filled = halves.map(|[x, y, z, w]| Beat {
            low: x | y << 16,
            high: z | w << 16,
            both: !was.flushes || was.place == 1,
            last: was.flushes || ends_full,
        });
    }
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
