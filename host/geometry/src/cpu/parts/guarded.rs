//! Half-edges of parts that come from outside, for merges that must end whatever the parts say.

use core::cell::Cell;

use bytemuck::Zeroable;

use super::super::edges::{Half, Halves};

/// Steps of the merges for each half-edge. On sound parts a merge takes a few steps for each vertex of its seam, and a
/// vertex is at the seam of at most 64 merges, one for each level of the cuts.
const STEPS: u64 = 64;

/// A range of a list of half-edges, without panics: what lies outside the range reads as zero and is not written. After
/// more steps than sound parts need, the merges end.
pub(super) struct Guarded<'a> {
    halves: &'a mut [Half],
    /// The number of the first half-edge of the range.
    first: u32,
    /// Steps that are left.
    steps: Cell<u64>,
}

impl<'a> Guarded<'a> {
    /// The range that begins with the half-edge of this number.
    pub(super) fn new(halves: &'a mut [Half], first: u32) -> Self {
        let steps = Cell::new(STEPS * (halves.len() as u64 + 1));
        Self { halves, first, steps }
    }

    #[inline(always)]
    fn get_mut(&mut self, e: u32) -> Option<&mut Half> {
        self.halves.get_mut(e.wrapping_sub(self.first) as usize)
    }

    /// Whether the merges ended because they had taken too many steps.
    pub(super) fn is_spent(&self) -> bool {
        self.steps.get() == 0
    }
}

impl Halves for Guarded<'_> {
    const MASK: u32 = <[Half]>::MASK;
    const GAP: u32 = <[Half]>::GAP;

    #[inline(always)]
    fn half(&self, e: u32) -> Half {
        self.halves.get(e.wrapping_sub(self.first) as usize).copied().unwrap_or_else(Half::zeroed)
    }

    #[inline(always)]
    fn put(&mut self, e: u32, half: Half) {
        if let Some(own) = self.get_mut(e) {
            *own = half;
        }
    }

    #[inline(always)]
    fn set_next(&mut self, e: u32, next: u32) {
        if let Some(own) = self.get_mut(e) {
            own.next = next;
        }
    }

    #[inline(always)]
    fn set_previous(&mut self, e: u32, previous: u32) {
        if let Some(own) = self.get_mut(e) {
            own.previous = previous;
        }
    }

    #[inline(always)]
    fn set_end(&mut self, e: u32, end: u32) {
        if let Some(own) = self.get_mut(e) {
            own.end = end;
        }
    }

    #[inline(always)]
    fn may_go_on(&self) -> bool {
        let left = self.steps.get().saturating_sub(1);
        self.steps.set(left);
        left > 0
    }
}
