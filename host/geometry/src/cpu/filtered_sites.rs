//! The distinct points of doubles or long integers along a Z-curve.
//!
//! A grid of up to 2^31 cells a side lies over all points, and the points stand along the Z-curve through its cells.
//! Points of one cell stand in lexicographic order. The grid is as fine as the words that are sorted allow (`sites`),
//! or finer if many points share cells. Rounding affects only the cell of a point. The number of a cell never falls as
//! the coordinate rises, so cuts between cells separate the points.

use alloc::vec;
use alloc::vec::Vec;

use super::filtered::Place;
use super::parallel::in_parallel;
use super::sites::{self, Sites};
use crate::double::Coordinate;
use crate::pages;
use crate::point::{Duplicate, Point};
use crate::site::FilteredSite;

/// The finest grid has two to the power of this number of cells a side.
const MOST_BITS: u32 = 31;
/// The finest grid is taken if more than one in this number of points shares a cell with another point.
const CROWDED: usize = 16;

/// The distinct points, in the order of the tree of cuts.
pub(super) struct FilteredSites<C> {
    pub(super) sites: Vec<FilteredSite<C>>,
    /// The place of each in the tree of cuts.
    pub(super) places: Vec<Place>,
    /// The input index of each: the lowest of its place in the plane.
    pub(super) ids: Vec<u32>,
    /// Points that fell onto an earlier one, in any order.
    pub(super) duplicates: Vec<Duplicate>,
}

/// The grid over all points: the lower left corner, and cells for each unit, both for halved coordinates.
#[derive(Clone, Copy)]
struct Grid {
    corner: [f64; 2],
    scale: f64,
    /// The number of the last cell of a row.
    last: u32,
}

impl Grid {
    fn over<C: Coordinate>(points: &[[C; 2]], bits: u32) -> Self {
        let none = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let (corner, far) = points.iter().fold(none, |(low, high), point| {
            let half = point.map(C::half);
            ([low[0].min(half[0]), low[1].min(half[1])], [high[0].max(half[0]), high[1].max(half[1])])
        });
        let extent = (far[0] - corner[0]).max(far[1] - corner[1]);
        let cells = 1u32 << bits;
        Self { corner, scale: f64::from(cells) / extent, last: cells - 1 }
    }

    /// The cell of a point. The conversion of a double to an integer saturates, and makes 0 of what is not a number: so
    /// an extent of zero, or one so small that the scale is infinite, is right too.
    #[inline(always)]
    fn cell<C: Coordinate>(&self, point: [C; 2]) -> Point {
        let [x, y] = [0, 1].map(|axis| ((point[axis].half() - self.corner[axis]) * self.scale) as u32);
        Point::new(x.min(self.last), y.min(self.last))
    }

    /// The cells of all points, sorted along the Z-curve, as the distinct points of a set.
    fn sorted_cells<C: Coordinate>(points: &[[C; 2]], bits: u32, threads: usize) -> Sites {
        let grid = Self::over(points, bits);
        let mut cells = vec![Point::default(); points.len()];
        let share = points.len().div_ceil(threads).max(1);
        in_parallel(cells.chunks_mut(share).zip(points.chunks(share)), |(cells, points)| {
            cells.iter_mut().zip(points).for_each(|(cell, &point)| *cell = grid.cell(point));
        });
        sites::sort(&cells, threads)
    }
}

/// Sorts the points and takes duplicates out, on up to `threads` threads. O(n) where few points share a cell, O(n
/// log n) at worst.
pub(super) fn sort<C: Coordinate>(points: &[[C; 2]], threads: usize) -> FilteredSites<C> {
    let bits = sites::exact_bits(points.len(), threads).min(MOST_BITS);
    let mut cells = Grid::sorted_cells(points, bits, threads);
    // If crowds of points share cells of a coarse grid, the cuts between these points no longer alternate between the
    // axes.
    if bits < MOST_BITS && cells.duplicates.len() > points.len() / CROWDED {
        cells = Grid::sorted_cells(points, MOST_BITS, threads);
    }
    let Sites { sites: distinct, ids: firsts, duplicates: sharing, .. } = cells;
    let groups = Groups::of(sharing, points.len());
    let mut all =
        Taken { places: pages::with_room(points.len()), ids: pages::with_room(points.len()), duplicates: Vec::new() };
    for (cell, first) in distinct.into_iter().zip(firsts) {
        let cell = [cell.x(), cell.y()];
        let others = groups.of_first(first);
        if others.is_empty() {
            all.keep(first, Place { cell, rank: 0 });
        } else {
            all.take_cell(points, first, others, cell);
        }
    }
    let Taken { places, ids, duplicates } = all;
    let mut sites = pages::with_room(ids.len());
    // The loop is short so that the processor has many of its scattered reads under way at a time.
    sites.extend(ids.iter().map(|&id| FilteredSite::of(points[id as usize])));
    FilteredSites { sites, places, ids, duplicates }
}

/// Points that share a cell with one of a lower index.
struct Groups {
    /// Sorted by the first index of the cell, then by index.
    sharing: Vec<Duplicate>,
    /// A bit for each input index, set for the first point of a cell with several. Nearly all cells have a single
    /// point, and the bit saves them the search in `sharing`.
    is_shared: Vec<u64>,
}

impl Groups {
    fn of(mut sharing: Vec<Duplicate>, points: usize) -> Self {
        sharing.sort_unstable_by_key(|&Duplicate { index, of }| (of, index));
        let mut is_shared = vec![0; points.div_ceil(64)];
        sharing.iter().for_each(|&Duplicate { of, .. }| is_shared[of as usize / 64] |= 1 << (of % 64));
        Self { sharing, is_shared }
    }

    /// The other points of the cell whose first point is `first`.
    #[inline(always)]
    fn of_first(&self, first: u32) -> &[Duplicate] {
        if self.is_shared[first as usize / 64] >> (first % 64) & 1 == 0 {
            return &[];
        }
        let start = self.sharing.partition_point(|other| other.of < first);
        let count = self.sharing[start..].partition_point(|other| other.of == first);
        &self.sharing[start..start + count]
    }
}

/// The distinct points without their coordinates; see [`FilteredSites`].
struct Taken {
    places: Vec<Place>,
    ids: Vec<u32>,
    duplicates: Vec<Duplicate>,
}

impl Taken {
    #[inline(always)]
    fn keep(&mut self, id: u32, place: Place) {
        self.places.push(place);
        self.ids.push(id);
    }

    /// Takes all points of a cell, in lexicographic order.
    fn take_cell<C: Coordinate>(&mut self, points: &[[C; 2]], first: u32, others: &[Duplicate], cell: [u32; 2]) {
        let all = core::iter::once(first).chain(others.iter().map(|other| other.index));
        let mut sorted: Vec<(FilteredSite<C>, u32)> =
            all.map(|id| (FilteredSite::of(points[id as usize]), id)).collect();
        sorted.sort_unstable();
        for (rank, group) in sorted.chunk_by(|one, other| one.0 == other.0).enumerate() {
            let id = group[0].1;
            self.keep(id, Place { cell, rank: rank as u32 });
            self.duplicates.extend(group[1..].iter().map(|&(_, index)| Duplicate { index, of: id }));
        }
    }
}
