//! The sixth step: the canonical order of all triangles, a stretch of it in each process.
//!
//! The method is a sample sort: all processes put keys of some of their triangles together, choose the same bounds from
//! them, and send each triangle to the process between whose bounds it lies.

use incircle_cli::canonical::{key, sorted};
use incircle_cli::scattered;

use crate::world::World;

/// The keys of the sample for each process. The stretches of most processes are within 10 % of an equal share.
const KEYS_EACH: u64 = 1024;
/// The fewest keys of a large mesh.
const LEAST_KEYS: u64 = 1 << 16;

/// Sorts the triangles of all processes. Those of process 0 come first, then those of process 1, and so on.
///
/// Each triangle must have its smallest index first.
pub fn sort(world: &World, mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    if world.size() == 1 {
        return sorted(&[&triangles]);
    }
    let bounds = bounds(world, &triangles);
    let room = triangles.len() / world.size() * 3;
    let list = |rank| Vec::with_capacity(if rank == world.rank() { 0 } else { room });
    let mut lists: Vec<Vec<u32>> = (0..world.size()).map(list).collect();
    triangles.retain(|triangle| {
        let rank = bounds.partition_point(|&bound| bound <= key(triangle));
        if rank != world.rank() {
            lists[rank].extend_from_slice(triangle);
        }
        rank == world.rank()
    });
    lists[world.rank()] = triangles.into_flattened();
    let lists = world.exchange(lists);
    sorted(&lists.iter().map(|list| list.as_chunks::<3>().0).collect::<Vec<_>>())
}

/// The lowest keys of all processes but the first.
fn bounds(world: &World, triangles: &[[u32; 3]]) -> Vec<u64> {
    let size = world.size() as u64;
    let total = world.sum(&[triangles.len() as u64])[0];
    let wanted = LEAST_KEYS.max(KEYS_EACH * size);
    let limit = match total {
        total if total <= wanted => u64::MAX,
        total => ((u128::from(wanted) << u64::BITS) / u128::from(total)) as u64,
    };
    // The places of the triangles of different processes must not give the same sequence of choices.
    let first = (world.rank() as u64) << 40;
    let chosen = (first..).zip(triangles).filter(|&(place, _)| scattered(place) <= limit);
    let own: Vec<u64> = chosen.map(|(_, triangle)| key(triangle)).collect();
    let mut keys = world.gather(&own).concat();
    keys.sort_unstable();
    (1..size).map(|rank| keys.get(keys.len() * rank as usize / size as usize).copied().unwrap_or(u64::MAX)).collect()
}
