//! The tree of regions: which tiles a set is cut into, and in which order they are joined.

use alloc::vec::Vec;
use core::num::NonZeroUsize;
use core::ops::Range;

use super::region::Region;
use crate::order::z_curve::point_at;
use crate::point::Point;

/// One step of the work on a set. The steps run like the words of a stack machine: a tile puts its border onto the
/// stack, and a join takes the last borders from the stack and puts that of their union there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// Triangulate the points of a tile, and find out what is final ([`local`](super::local)).
    Tile {
        /// The region of the tile.
        region: Region,
        /// The points, as places along the Z-curve. If the tree was made of a sample, the places in the sample.
        points: Range<usize>,
    },
    /// Join the last borders ([`join`](super::join())).
    Join {
        /// The joined region.
        region: Region,
        /// The number of borders to take from the stack: 2 to 4.
        children: usize,
    },
}

/// The cuts of the plane into tiles, and the steps from the points to the mesh.
///
/// The cuts lie between cells of the Z-curve. So a tile has a contiguous stretch of the points along the curve, and all
/// duplicates of a point are in one tile. The regions of all tiles together are the whole plane, and those of the
/// children of a join are a rectangle. A join has up to four children, and the stack never holds more than 3 borders
/// for each of up to 32 levels of squares.
///
/// ```
/// use core::num::NonZeroUsize;
/// use incircle_geometry::order::z_curve::position;
/// use incircle_geometry::tiles::{Step, Tree};
///
/// let mut positions: Vec<u64> = (0..100).map(|k| position(k % 10, k / 10)).collect();
/// positions.sort_unstable();
/// let tree = Tree::of_positions(&positions, NonZeroUsize::new(64).unwrap());
/// let sizes: Vec<usize> = tree.tiles().map(|(_, points)| points.len()).collect();
/// assert_eq!(sizes, [64, 16, 20]);
/// assert!(matches!(tree.steps().last(), Some(Step::Join { children: 3, .. })));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tree {
    steps: Vec<Step>,
    cuts: Vec<Cut>,
    root: Side,
}

/// A vertical or horizontal line, and what is on its two sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Cut {
    is_vertical: bool,
    /// The least coordinate on the second side.
    at: u32,
    sides: [Side; 2],
}

/// The next cut or the tile on one side of a cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    /// A further cut, by its place in the list.
    Cut(usize),
    /// A tile, by its place in the sequence of tiles.
    Tile(usize),
}

impl Tree {
    /// The tree for points with these positions along the Z-curve, in ascending order, and tiles of at most `most`
    /// points. Only a tile whose points are all at one place may have more. O(t log n) for `t` tiles.
    ///
    /// Positions of a sample will do, too, with `most` in proportion: [`Tree::tile_of`] finds the tile of any point.
    pub fn of_positions(positions: &[u64], most: NonZeroUsize) -> Self {
        let before = |position: u64| positions.partition_point(|&other| other < position);
        Builder::build(positions.len(), u64::BITS, most.get(), &before)
    }

    /// The tree for a histogram: the numbers of points in cells of equal size along the Z-curve, whose number is a
    /// power of two (further cells count as empty). Only a tile of one cell may have more than `most` points.
    ///
    /// Cell `k` of `2^b` has the points whose [positions](crate::order::z_curve::position) begin with the `b` bits of
    /// `k`.
    pub fn of_histogram(counts: &[usize], most: NonZeroUsize) -> Self {
        let mut sum = 0usize;
        let mut sums: Vec<usize> = counts
            .iter()
            .map(|&count| {
                let before = sum;
                sum = sum.saturating_add(count);
                before
            })
            .collect();
        let bits = counts.len().next_power_of_two().ilog2();
        sums.resize(1 << bits, sum);
        let before = |position: u64| position.checked_shr(u64::BITS - bits).map_or(0, |cell| sums[cell as usize]);
        Builder::build(sum, bits, most.get(), &before)
    }

    /// The steps, in an order that keeps few borders on the stack: tiles come along the curve, and each join comes as
    /// soon as all its children are there.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The tiles along the curve, with their points.
    pub fn tiles(&self) -> impl Iterator<Item = (Region, Range<usize>)> + '_ {
        self.steps.iter().filter_map(|step| match step {
            Step::Tile { region, points } => Some((*region, points.clone())),
            Step::Join { .. } => None,
        })
    }

    /// The tile whose region contains a point, by its place in [`Tree::tiles`]. O(log t) comparisons for `t` tiles, if
    /// these are of about equal size, and never more than 64.
    pub fn tile_of(&self, point: Point) -> usize {
        let mut side = self.root;
        loop {
            match side {
                Side::Tile(tile) => return tile,
                Side::Cut(place) => {
                    let cut = &self.cuts[place];
                    let value = if cut.is_vertical { point.x } else { point.y };
                    side = cut.sides[usize::from(value >= cut.at)];
                }
            }
        }
    }
}

/// A rectangle on its way to become tiles.
#[derive(Clone)]
struct Area {
    /// The lowest position of the cell that has the points, and the number of leading bits that its positions share.
    first: u64,
    depth: u32,
    /// The region: the cell, or the cell and places around it where no points are.
    region: Region,
    points: Range<usize>,
}

/// An area cut in two, with points on both sides.
struct Halves {
    is_vertical: bool,
    at: u32,
    areas: [Area; 2],
}

struct Builder<'a> {
    tree: Tree,
    tiles: usize,
    /// The number of leading bits of the smallest cells.
    deepest: u32,
    most: usize,
    /// The number of points whose positions are lower than this one.
    before: &'a dyn Fn(u64) -> usize,
}

impl<'a> Builder<'a> {
    fn build(count: usize, deepest: u32, most: usize, before: &'a dyn Fn(u64) -> usize) -> Tree {
        let tree = Tree { steps: Vec::new(), cuts: Vec::new(), root: Side::Tile(0) };
        let mut builder = Self { tree, tiles: 0, deepest, most, before };
        builder.tree.root = builder.add(Area { first: 0, depth: 0, region: Region::WHOLE, points: 0..count });
        builder.tree
    }

    /// Adds the steps of an area, which leave one border.
    fn add(&mut self, area: Area) -> Side {
        let Some(halves) = self.halves(&area) else {
            return self.add_tile(area);
        };
        let mut children = 0;
        let side = self.add_cut(halves, &mut |builder, half| match builder.halves(&half) {
            None => {
                children += 1;
                builder.add_tile(half)
            }
            Some(quarters) => builder.add_cut(quarters, &mut |builder, quarter| {
                children += 1;
                builder.add(quarter)
            }),
        });
        self.tree.steps.push(Step::Join { region: area.region, children });
        side
    }

    fn add_tile(&mut self, area: Area) -> Side {
        self.tree.steps.push(Step::Tile { region: area.region, points: area.points });
        self.tiles += 1;
        Side::Tile(self.tiles - 1)
    }

    fn add_cut(&mut self, halves: Halves, add: &mut dyn FnMut(&mut Self, Area) -> Side) -> Side {
        let Halves { is_vertical, at, areas } = halves;
        let sides = areas.map(|area| add(self, area));
        self.tree.cuts.push(Cut { is_vertical, at, sides });
        Side::Cut(self.tree.cuts.len() - 1)
    }

    /// Cuts an area with too many points at the first line between two cells that has points on both sides. `None` if
    /// the area is a tile.
    fn halves(&self, area: &Area) -> Option<Halves> {
        let (points, mut first, mut depth) = (&area.points, area.first, area.depth);
        while points.len() > self.most && depth < self.deepest {
            // Positions begin with a bit of x, and bits of x and y take turns.
            let is_vertical = depth % 2 == 0;
            let second = first | 1 << (u64::BITS - 1 - depth);
            let middle = (self.before)(second).clamp(points.start, points.end);
            depth += 1;
            if middle == points.start {
                first = second;
            } else if middle < points.end {
                let corner = point_at(second);
                let at = if is_vertical { corner.x } else { corner.y };
                let regions = match is_vertical {
                    true => area.region.split_at_x(at.into()),
                    false => area.region.split_at_y(at.into()),
                };
                let half = |first, region, points| Area { first, depth, region, points };
                let areas =
                    [half(first, regions[0], points.start..middle), half(second, regions[1], middle..points.end)];
                return Some(Halves { is_vertical, at, areas });
            }
        }
        None
    }
}
