//! Cutting a clip down to a cell, neighbour by neighbour.

use alloc::vec::Vec;
use core::mem;

use super::clip::Clip;
use super::clipped::ClippedCell;
use super::cut::{Bend, Cutter, Side, View};
use super::place::Place;
use crate::point::Point;

/// The rings of one clipped cell, and the memory in which they are made.
pub(crate) struct Clipper<'a> {
    points: &'a [Point],
    clip: &'a Clip,
    cutter: Cutter,
    /// The rings of the cell, one behind the other, and how many corners each has.
    bends: Vec<Bend>,
    counts: Vec<usize>,
    spare_bends: Vec<Bend>,
    spare_counts: Vec<usize>,
}

impl<'a> Clipper<'a> {
    pub(crate) fn new(points: &'a [Point], clip: &'a Clip) -> Self {
        Self {
            points,
            clip,
            cutter: Cutter::default(),
            bends: Vec::new(),
            counts: Vec::new(),
            spare_bends: Vec::new(),
            spare_counts: Vec::new(),
        }
    }

    pub(super) fn clip(&self) -> &'a Clip {
        self.clip
    }

    /// Forgets the last cell.
    pub(crate) fn clear(&mut self) {
        self.bends.clear();
        self.counts.clear();
    }

    /// Takes a ring as it is.
    pub(super) fn take(&mut self, ring: impl Iterator<Item = Bend>) {
        self.bends.extend(ring);
        self.counts.push(self.bends.len());
    }

    /// Cuts the clip by the border of the cell of `p` with each neighbour. The corners that are left do not depend on
    /// the order of the neighbours, nor on further points whose cells meet that of `p` in a corner alone.
    pub(crate) fn cut(&mut self, p: Point, neighbors: impl Iterator<Item = u32>) {
        let view = View { p, points: self.points, clip: self.clip };
        let bend =
            |(edge, &corner): (usize, &Point)| Bend { place: Place::Corner(corner), side: Side::Clip(edge as u32) };
        self.bends.extend(self.clip.corners().iter().enumerate().map(bend));
        self.counts.extend(self.clip.rings().map(<[Point]>::len));
        for neighbor in neighbors {
            self.spare_bends.clear();
            self.spare_counts.clear();
            let rings = (&self.bends[..], &self.counts[..]);
            self.cutter.cut(rings, view, neighbor, &mut self.spare_bends, &mut self.spare_counts);
            mem::swap(&mut self.bends, &mut self.spare_bends);
            mem::swap(&mut self.counts, &mut self.spare_counts);
            if self.counts.is_empty() {
                return;
            }
        }
    }

    /// The last cell, as that of point `p`, whose index is given.
    pub(crate) fn cell(&self, p: Point, point: u32) -> ClippedCell<'_> {
        ClippedCell { p, point, points: self.points, clip: self.clip, bends: &self.bends, counts: &self.counts }
    }
}
