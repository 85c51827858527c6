//! Half-edges with numbers of 16 bits, for up to 10,922 vertices.

use alloc::boxed::Box;
use core::marker::PhantomData;

use bytemuck::{Pod, Zeroable};

use super::super::conquer::{conquer, Waiting};
use super::super::edges::{is_used, Edges, Half, Halves, SiteList, HALVES};
use super::super::merge::Part;
use super::super::view::{Integers, Site, Width};
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

/// Every number of 16 bits is an index of this list too.
impl SiteList<Site> for [Site; NUMBERS] {
    #[inline(always)]
    fn site(&self, v: u32) -> Site {
        self[usize::from(v as u16)]
    }
}

/// The memory for a set or a subtree of up to [`MOST`] vertices: two lists of half a megabyte each. Of both, a small set
/// touches only the beginning.
#[derive(Debug)]
pub(super) struct ShortEdges {
    pub(super) halves: Box<[Short; NUMBERS]>,
    sites: Box<[Site; NUMBERS]>,
}

impl ShortEdges {
    pub(super) fn new() -> Self {
        Self { halves: table(), sites: table() }
    }

    /// Triangulates up to [`MOST`] sites, which stand along the curve. Returns the part and the first unused pair.
    pub(super) fn conquer<W: Width>(&mut self, sites: &[Site], waiting: &mut Waiting) -> Option<(Part, u32)> {
        let Self { halves, sites: table } = self;
        halves[..HALVES * sites.len()].fill(Short::zeroed());
        table[..sites.len()].copy_from_slice(sites);
        let mut edges =
            Edges::<Integers<W>, _, _> { kernel: PhantomData, sites: &**table, halves: &mut **halves, unused: 0 };
        let part = conquer(&mut edges, sites, waiting, &mut |_| true)?;
        Some((part, edges.unused))
    }

    /// Copies the half-edges to the range of the subtree in a list of longer ones, given the subtree's first vertex.
    pub(super) fn copy_to(&self, range: &mut [Half], vertex: u32) {
        let by = HALVES as u32 * vertex;
        for (pair, (to, from)) in
            (0..).step_by(2).zip(range.as_chunks_mut::<2>().0.iter_mut().zip(self.halves.as_chunks::<2>().0))
        {
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
}

/// Makes a list of zeros for all numbers of 16 bits.
fn table<T: Zeroable>() -> Box<[T; NUMBERS]> {
    let list = pages::zeros(NUMBERS).into_boxed_slice();
    list.try_into().unwrap_or_else(|_| unreachable!("the list has one item for each number"))
}
