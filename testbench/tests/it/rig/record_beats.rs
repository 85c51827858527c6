//! Records of a read-out, and the beats that carry them.

use std::collections::VecDeque;

use crate::rig::stepper::{NamedPorts, Stepper};
use incircle_protocol::{Layout, ShortIds, CORE_COORD_BITS, MAX_POINTS};
use incircle_testkit::SplitMix64;

/// Layout of the words of the largest core.
pub const LAYOUT: Layout = Layout::of(CORE_COORD_BITS, MAX_POINTS);

/// A beat, field by field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Beat {
    pub low: u32,
    pub high: u32,
    pub both: bool,
    pub last: bool,
}

impl Beat {
    pub fn of(number: u128) -> Self {
        Self {
            low: number as u32,
            high: (number >> 32) as u32,
            both: number >> 64 & 1 == 1,
            last: number >> 65 & 1 == 1,
        }
    }
}

/// A record, with its lock.
#[derive(Clone, Copy, Debug)]
pub struct Columns {
    pub v: [u32; 3],
    pub n: [u32; 3],
    pub lock: bool,
}

impl Columns {
    pub fn random(random: &mut SplitMix64) -> Self {
        let mut ids = || [(); 3].map(|()| [0, 0x7fff, random.below(1 << 15) as u32][random.below(3) as usize]);
        Self { v: ids(), n: ids(), lock: random.below(2) == 0 }
    }

    /// A record whose columns are made from its id.
    pub fn of(id: u32) -> Self {
        let column = |k: u32| (id ^ (0x1357 * k)) & 0x7fff;
        Self { v: [1, 2, 3].map(column), n: [4, 5, 6].map(column), lock: id.is_multiple_of(3) }
    }

    /// Sets the ports of a block that takes a record.
    pub fn set<U: NamedPorts>(&self, block: &mut Stepper<U>) {
        for (port, value) in ["v0", "v1", "v2", "n0", "n1", "n2"].into_iter().zip([self.v, self.n].concat()) {
            block.set(port, value);
        }
        block.set("was_set", self.lock);
    }

    /// The words of the record, by the protocol's layout.
    pub fn words(&self) -> [u32; 3] {
        let words = LAYOUT.record_to_words(self.v, self.n, self.lock);
        [words[0], words[1], words[2]]
    }
}

/// The form of a payload of records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Whole,
    Vertices,
    Short(ShortIds),
}

impl Form {
    pub const ALL: [Self; 4] = [Self::Whole, Self::Vertices, Self::Short(ShortIds::Ten), Self::Short(ShortIds::Twelve)];

    pub fn random(random: &mut SplitMix64) -> Self {
        Self::ALL[random.below(4) as usize]
    }

    pub fn has_vertices_alone(self) -> bool {
        self != Self::Whole
    }

    pub fn has_short_ids(self) -> bool {
        matches!(self, Self::Short(_))
    }

    pub fn has_rests(self) -> bool {
        self == Self::Short(ShortIds::Twelve)
    }

    /// Sets the ports that choose the form of a payload of records.
    pub fn set<U: NamedPorts>(self, block: &mut Stepper<U>) {
        block.set("vertices_alone", self.has_vertices_alone());
        block.set("has_short_ids", self.has_short_ids());
        block.set("has_rests", self.has_rests());
    }

    /// The bits for the ports that choose the form where a command asks for it: the vertices alone, short ids, and those
    /// of 12 bits. A bit that must not matter is `any`.
    pub fn asked(self, any: bool) -> [bool; 3] {
        match self {
            Self::Whole => [false, any, any],
            Self::Vertices => [true, false, any],
            Self::Short(ids) => [true, true, ids == ShortIds::Twelve],
        }
    }
}

/// The payload of these records in this form, by the protocol's layout.
pub fn payload_of(records: &[Columns], form: Form) -> Vec<u32> {
    let length = match form {
        Form::Whole => return records.iter().flat_map(Columns::words).collect(),
        Form::Short(ids) => return short_payload_of(records, ids),
        Form::Vertices => LAYOUT.triangles_words(records.len() as u32).expect("few records"),
    };
    let mut words = vec![0; length as usize];
    for (place, record) in records.iter().enumerate() {
        LAYOUT.vertices_to_words(record.v, &mut words, place);
    }
    words
}

/// The payload with short ids, bit by bit as `protocol/README.md` says it.
fn short_payload_of(records: &[Columns], ids: ShortIds) -> Vec<u32> {
    let mut words = Vec::new();
    for group in records.chunks(8) {
        let mut rests = 0;
        for Columns { v: [a, b, c], .. } in group {
            words.push(a & 0x3ff | (b & 0x3ff) << 10 | (c & 0x3ff) << 20 | (a >> 10 & 3) << 30);
            rests = rests >> 4 | (b >> 10 & 3) << 28 | (c >> 10 & 3) << 30;
        }
        words.extend((ids == ShortIds::Twelve).then_some(rests));
    }
    words
}

/// The beats of that payload.
pub fn beats_of(records: &[Columns], form: Form) -> VecDeque<Beat> {
    let words = payload_of(records, form);
    let count = words.len().div_ceil(2);
    let beat = |(place, words): (usize, &[u32])| Beat {
        low: words[0],
        high: words.get(1).copied().unwrap_or(0),
        both: words.len() == 2,
        last: place + 1 == count,
    };
    words.chunks(2).enumerate().map(beat).collect()
}

/// Whether the record at this place may have a successor in the next clock.
pub fn leaves_no_rest(place: usize, form: Form) -> bool {
    form.has_vertices_alone() || place.is_multiple_of(2)
}
