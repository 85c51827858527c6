//! The second step: all processes take a sample of the set together, and each makes the same cuts from it.

use std::num::NonZeroUsize;

use incircle::order::z_curve::position;
use incircle::tiles::Tree;
use incircle_cli::scattered;

use crate::slice::Slice;
use crate::world::World;

/// The tiles of a process, if nobody says how large a tile is, and if all tiles have as many points as they may. Most
/// sets have up to twice as many. With more tiles the processes have more equal work, and longer borders.
const TILES_EACH: usize = 16;
/// The points of the sample for each process. With 256 for a tile, most tiles are within 13 % of their size.
const SAMPLE_EACH: u64 = 256 * TILES_EACH as u64;
/// The fewest points of the sample of a large set.
const LEAST_SAMPLE: u64 = 1 << 17;

/// The cuts of a set.
pub struct Cuts {
    /// The tiles and the joins.
    pub tree: Tree,
    /// The process of each tile. Ranks ascend.
    pub owners: Vec<usize>,
}

/// Cuts the set of all processes. A point is in the sample or not by its index alone.
pub fn cut(world: &World, slice: &Slice, most: Option<NonZeroUsize>) -> Cuts {
    let wanted = LEAST_SAMPLE.max(SAMPLE_EACH * world.size() as u64);
    let limit = match slice.total {
        total if total <= wanted => u64::MAX,
        total => ((u128::from(wanted) << u64::BITS) / u128::from(total)) as u64,
    };
    let chosen = (slice.first..).zip(&slice.points).filter(|&(index, _)| scattered(index) <= limit);
    let own: Vec<u64> = chosen.map(|(_, point)| position(point.x, point.y)).collect();
    let mut sample = world.gather(&own).concat();
    sample.sort_unstable();
    of_sample(&sample, slice.total, most, world.size())
}

/// The cuts for positions of a sample in ascending order.
fn of_sample(sample: &[u64], total: u64, most: Option<NonZeroUsize>, size: usize) -> Cuts {
    let of_tile = match most {
        None => sample.len().div_ceil(TILES_EACH * size),
        Some(most) => (sample.len() as u128 * most.get() as u128 / u128::from(total.max(1))) as usize,
    };
    let tree = Tree::of_positions(sample, NonZeroUsize::new(of_tile).unwrap_or(NonZeroUsize::MIN));
    // A tile belongs to the process whose equal part of the sample holds the middle of the tile.
    let owner = |middle: usize| (middle * size / sample.len().max(1)).min(size - 1);
    let owners = tree.tiles().map(|(_, points)| owner(points.start.midpoint(points.end))).collect();
    Cuts { tree, owners }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn processes_get_equal_stretches_of_tiles() {
        let sample: Vec<u64> = (0..10_000u64).map(scattered).collect();
        let mut sorted = sample;
        sorted.sort_unstable();
        for size in [1, 2, 3, 7] {
            let cuts = of_sample(&sorted, 1_000_000, None, size);
            let mut points = vec![0; size];
            for (&owner, (_, range)) in cuts.owners.iter().zip(cuts.tree.tiles()) {
                points[owner] += range.len();
            }
            assert!(cuts.owners.is_sorted());
            let even = 10_000 / size;
            assert!(points.iter().all(|&count| count.abs_diff(even) < even / 4), "{points:?}");
        }
        assert_eq!(of_sample(&[], 0, None, 3).owners, [0]);
        let all_equal = of_sample(&[5; 100], 100, NonZeroUsize::new(3), 4);
        assert_eq!(all_equal.owners, [2]);
    }
}
