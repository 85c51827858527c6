//! Half-edges with numbers of 16 bits, for up to 10,922 vertices.

use alloc::boxed::Box;
use core::ops::Range;

use bytemuck::{Pod, Zeroable};

use super::conquer::{conquer, GoOn, Waiting};
use super::edges::{is_used, Edges, Half, Halves, HALVES};
use super::kernel::Kernel;
use super::merge::Part;
use super::subtrees::Own;
use crate::pages;

/// Numbers of 16 bits.
const NUMBERS: usize = 1 << 16;
/// Most vertices whose half-edges have numbers of 16 bits.
pub(super) const MOST: usize = NUMBERS / HALVES;

/// One half of an edge.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Short {
    next: u16,
    previous: u16,
    end: u16,
    /// Fills up eight bytes, for which a processor computes addresses without a multiplication.
    zero: u16,
}

/// Every number of 16 bits is an index of this list, so no access needs a check.
impl Halves for [Short; NUMBERS] {
    const MASK: u32 = 0xffff;
    const GAP: u32 = 1 << 15;

    #[inline(always)]
    fn half(&self, e: u32) -> Half {
        let Short { next, previous, end, .. } = self[usize::from(e as u16)];
        Half { next: next.into(), previous: previous.into(), end: end.into() }
    }

    #[inline(always)]
    fn put(&mut self, e: u32, Half { next, previous, end }: Half) {
        let half = &mut self[usize::from(e as u16)];
        (half.next, half.previous, half.end) = (next as u16, previous as u16, end as u16);
    }

    #[inline(always)]
    fn set_next(&mut self, e: u32, next: u32) {
        self[usize::from(e as u16)].next = next as u16;
    }

    #[inline(always)]
    fn set_previous(&mut self, e: u32, previous: u32) {
        self[usize::from(e as u16)].previous = previous as u16;
    }

    #[inline(always)]
    fn set_end(&mut self, e: u32, end: u32) {
        self[usize::from(e as u16)].end = end as u16;
    }
}

/// The memory for the half-edges of a set or a subtree of up to [`MOST`] vertices: half a megabyte, of which few
/// vertices touch only the beginning.
#[derive(Debug)]
pub(super) struct ShortHalves(Box<[Short; NUMBERS]>);

impl ShortHalves {
    pub(super) fn new() -> Self {
        let list = pages::zeros(NUMBERS).into_boxed_slice();
        Self(list.try_into().unwrap_or_else(|_| unreachable!("the list has one item for each number")))
    }

    /// Triangulates up to [`MOST`] sites; see [`conquer`]. Returns the part and the first unused pair.
    pub(super) fn conquer<K: Kernel>(
        &mut self,
        sites: &[K::Site],
        places: &[K::Place],
        waiting: &mut Waiting,
        go_on: GoOn<'_>,
    ) -> Option<(Part, u32)> {
        self.0[..HALVES * sites.len()].fill(Short::zeroed());
        let mut edges = Edges::<K, _> { sites, halves: &mut *self.0, unused: 0 };
        let part = conquer(&mut edges, places, waiting, go_on)?;
        Some((part, edges.unused))
    }

    /// Triangulates a subtree of up to [`MOST`] vertices, in the range of its sites, in a list of longer half-edges.
    pub(super) fn conquer_range<K: Kernel>(
        &mut self,
        range: Range<usize>,
        (sites, places): (&[K::Site], &[K::Place]),
        halves: &mut [Half],
        waiting: &mut Waiting,
        go_on: GoOn<'_>,
    ) -> Option<Own> {
        let (part, unused) = self.conquer::<K>(&sites[range.clone()], &places[range.clone()], waiting, go_on)?;
        self.copy_to(halves, range.start as u32);
        let by = (HALVES * range.start) as u32;
        if range.len() == 1 {
            // The pair of a single vertex begins and ends at the vertex, as unused pairs do, so it was copied as one.
            for (e, half) in (by..).zip(&mut halves[..2]) {
                *half = Half { next: e, previous: e, end: range.start as u32 };
            }
        }
        Some((part.moved(by), unused + by))
    }

    /// Copies the half-edges to the range of the subtree in a list of longer ones, given the subtree's first vertex.
    fn copy_to(&self, range: &mut [Half], vertex: u32) {
        let by = HALVES as u32 * vertex;
        let pairs = range.as_chunks_mut::<2>().0.iter_mut().zip(self.0.as_chunks::<2>().0);
        for (pair, (to, from)) in (0..).step_by(2).zip(pairs) {
            if is_used([from[0].end.into(), from[1].end.into()]) {
                *to = from.map(|Short { next, previous, end, .. }| Half {
                    next: by + u32::from(next),
                    previous: by + u32::from(previous),
                    end: vertex + u32::from(end),
                });
            } else {
                let after: u32 = pair + 2;
                let next = u32::from(from[0].next).wrapping_add(after) & <[Short; NUMBERS]>::MASK;
                *to = [Half { next: next.wrapping_sub(after), ..Half::zeroed() }, Half::zeroed()];
            }
        }
    }

    /// The half-edges of the last set.
    pub(super) fn halves(&mut self) -> &mut [Short; NUMBERS] {
        &mut self.0
    }
}
