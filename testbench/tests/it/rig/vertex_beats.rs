//! The vertices of a read-out as the beats that carry them.

use std::collections::VecDeque;

use crate::rig::stepper::{NamedPorts, Stepper};
use incircle_protocol::{Layout, CORE_COORD_BITS, MAX_POINTS};
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

/// Beats of these vertices, by the protocol's layout.
pub fn beats_of(records: &[[u32; 3]]) -> VecDeque<Beat> {
    let length = LAYOUT.triangles_words(records.len() as u32).expect("few records");
    let mut words = vec![0; length as usize];
    for (place, &vertices) in records.iter().enumerate() {
        LAYOUT.vertices_to_words(vertices, &mut words, place);
    }
    let count = words.len().div_ceil(2);
    let beat = |(place, words): (usize, &[u32])| Beat {
        low: words[0],
        high: words.get(1).copied().unwrap_or(0),
        both: words.len() == 2,
        last: place + 1 == count,
    };
    words.chunks(2).enumerate().map(beat).collect()
}

pub fn vertices(random: &mut SplitMix64) -> [u32; 3] {
    [(); 3].map(|()| [0, 0x7fff, random.below(1 << 15) as u32][random.below(3) as usize])
}

pub fn set_vertices<U: NamedPorts>(block: &mut Stepper<U>, vertices: [u32; 3]) {
    for (port, vertex) in ["v0", "v1", "v2"].into_iter().zip(vertices) {
        block.set(port, vertex);
    }
}

/// A record whose columns are made from its id.
pub fn columns(id: u32) -> ([u32; 3], [u32; 3], bool) {
    let column = |k: u32| (id ^ (0x1357 * k)) & 0x7fff;
    ([column(1), column(2), column(3)], [column(4), column(5), column(6)], id.is_multiple_of(3))
}
