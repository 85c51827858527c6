//! The state of an attempt as plain numbers.

use super::stepper::bundles::{pack, Layout};
use incircle_testkit::SplitMix64;

/// Widths of `drains`, `outstanding`, `count`, `inners`, `logged`, and the two halves of `half_open`.
const ATTEMPT: Layout<7> = [1, 7, 7, 7, 7, 32, 32];

/// State of an attempt, field by field.
#[derive(Clone, Copy, Debug, Default)]
pub struct State {
    pub drains: bool,
    pub outstanding: u64,
    pub count: u64,
    pub inners: u64,
    pub logged: u64,
    pub half_open: u64,
}

impl State {
    pub fn random(random: &mut SplitMix64) -> Self {
        let most = [1, 3, 126][random.below(3) as usize];
        Self {
            drains: random.below(4) == 0,
            outstanding: 1 + random.below(most),
            count: random.below(64),
            inners: random.below(64),
            logged: random.below(127),
            half_open: random.next_u64(),
        }
    }

    /// The state packed as an `Attempt`.
    pub fn packed(self) -> u128 {
        let Self { drains, outstanding, count, inners, logged, half_open } = self;
        pack(ATTEMPT, [drains.into(), outstanding, count, inners, logged, half_open & 0xffff_ffff, half_open >> 32])
    }

    /// Passes an edge of the triangle of entry `y`. Returns true if no further edge of that triangle is open.
    pub fn passes(&mut self, y: u64) -> bool {
        // The root brings three edges, all other triangles two.
        let places: &[u64] = if y == 0 { &[0, 1] } else { &[y] };
        match places.iter().find(|place| self.half_open >> **place & 1 == 0) {
            Some(place) => {
                self.half_open |= 1 << place;
                false
            }
            None => true,
        }
    }
}
