//! The edges of a clip, sorted into slabs by their height, so that few are asked about a cell.

use alloc::vec;
use alloc::vec::Vec;

use crate::point::Point;

/// The most slabs.
const MOST_SLABS: u64 = 4096;

/// The edges of rings in slabs of equal height.
#[derive(Clone, Debug)]
pub(super) struct Border {
    low: u32,
    high: u32,
    /// The height of a slab.
    height: u64,
    slabs: Vec<Vec<u32>>,
    /// The smallest and largest x and y of each edge.
    boxes: Vec<[[u32; 2]; 2]>,
}

impl Border {
    /// The border of edges, each with its two ends; an edge begins at every corner.
    pub(super) fn of(edges: &[[Point; 2]]) -> Self {
        let boxes: Vec<_> =
            edges.iter().map(|[a, b]| [[a.x.min(b.x), a.x.max(b.x)], [a.y.min(b.y), a.y.max(b.y)]]).collect();
        let low = edges.iter().map(|[corner, _]| corner.y).min().unwrap_or(0);
        let high = edges.iter().map(|[corner, _]| corner.y).max().unwrap_or(0);
        // An edge that is high counts in many slabs: with few slabs all of them together have 8 entries an edge.
        let span = u128::from(high - low) + 1;
        let heights: u128 = boxes.iter().map(|[_, [bottom, top]]| u128::from(top - bottom) + 1).sum();
        let fitting = (8 * edges.len() as u128 * span / heights.max(1)).max(1);
        let count = (edges.len() as u64).clamp(1, MOST_SLABS).min(u64::try_from(fitting).unwrap_or(MOST_SLABS));
        let height = (u64::from(high - low) + 1).div_ceil(count);
        let mut border = Self { low, high, height, slabs: vec![Vec::new(); count as usize], boxes };
        for edge in 0..edges.len() {
            let [bottom, top] = border.boxes[edge][1];
            for slab in border.slab(bottom)..=border.slab(top) {
                border.slabs[slab].push(edge as u32);
            }
        }
        border
    }

    fn slab(&self, y: u32) -> usize {
        ((u64::from(y.saturating_sub(self.low)) / self.height) as usize).min(self.slabs.len() - 1)
    }

    /// The edges that may have a place at this height.
    pub(super) fn at_height(&self, y: u32) -> impl Iterator<Item = u32> + '_ {
        let is_beyond = y < self.low || y > self.high;
        self.slabs[self.slab(y)].iter().copied().filter(move |_| !is_beyond)
    }

    /// Whether the box of an edge and a box of doubles have a place in common. The box may be infinite.
    pub(super) fn may_touch(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        if high[1] < f64::from(self.low) || low[1] > f64::from(self.high) {
            return false;
        }
        // The conversion cuts off at both ends.
        let slabs = self.slab(low[1] as u32)..=self.slab(high[1] as u32);
        let mut edges = self.slabs[slabs].iter().flatten();
        edges.any(|&edge| {
            let [x, y] = self.boxes[edge as usize];
            let overlap =
                |axis: usize, [from, to]: [u32; 2]| low[axis] <= f64::from(to) && high[axis] >= f64::from(from);
            overlap(0, x) && overlap(1, y)
        })
    }
}
