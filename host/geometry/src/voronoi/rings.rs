//! The rings of a polygon, as lists of corners.

use alloc::vec::Vec;

use crate::point::Point;

/// The outer ring of a polygon, then its holes.
#[derive(Clone, Debug, Default)]
pub(super) struct Rings {
    /// The outer ring, counter-clockwise, then the holes, clockwise.
    pub(super) corners: Vec<Point>,
    /// The end of each ring in the list.
    pub(super) ends: Vec<usize>,
    /// The corner behind each corner in its ring.
    pub(super) next: Vec<u32>,
}

impl Rings {
    /// The two ends of an edge.
    pub(super) fn edge(&self, edge: usize) -> [Point; 2] {
        [self.corners[edge], self.corners[self.next[edge] as usize]]
    }

    /// The ends of the rings that lie in a range of corners, which has some whole rings or a part of one.
    pub(super) fn ring_ends(&self, [first, end]: [u32; 2]) -> &[usize] {
        let place = |corner: u32| self.ends.partition_point(|&other| other <= corner as usize);
        &self.ends[place(first)..place(end)]
    }

    /// Whether a ring ends before the corner of this number.
    pub(super) fn ends_ring(&self, number: u32) -> bool {
        self.ends.binary_search(&(number as usize)).is_ok()
    }

    /// The place nearest to the middle of a range of corners at which one ring follows another; `None` if all are of
    /// one ring.
    pub(super) fn ring_between(&self, [first, end]: [u32; 2]) -> Option<u32> {
        let middle = first + (end - first) / 2;
        let inner = self.ring_ends([first, end - 1]).iter().map(|&place| place as u32);
        inner.min_by_key(|place| place.abs_diff(middle))
    }

    /// Whether an edge belongs to a hole.
    pub(super) fn is_of_hole(&self, edge: u32) -> bool {
        edge as usize >= self.ends[0]
    }
}
