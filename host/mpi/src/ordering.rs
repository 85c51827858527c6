//! The sixth step: the canonical order of all triangles, a stretch of it in each process.
//!
//! This is a sample sort: all processes put keys of some of their triangles together, choose the same bounds from them,
//! and send each triangle to the process between whose bounds it lies.

use std::ops::RangeInclusive;

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
        return sorted(vec![triangles.into_flattened()]);
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
    sorted(world.exchange(lists))
}

/// The first two corners. They are enough: each directed edge has one triangle on its left.
fn key(triangle: &[u32; 3]) -> u64 {
    u64::from(triangle[0]) << u32::BITS | u64::from(triangle[1])
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

/// Sorts the triangles of some lists. Most stretches have about as many triangles as there are indices between their
/// bounds, and then two passes by the smallest index and a sort of the few triangles with the same one take less time
/// than a general sort.
fn sorted(lists: Vec<Vec<u32>>) -> Vec<[u32; 3]> {
    let all = || lists.iter().flat_map(|list| list.as_chunks::<3>().0);
    let firsts = || all().map(|triangle| triangle[0]);
    let (Some(low), Some(high)) = (firsts().min(), firsts().max()) else { return Vec::new() };
    let count = lists.iter().map(|list| list.len() / 3).sum();
    if (high - low) as usize <= 4 * count && u32::try_from(count).is_ok() {
        return by_first(all, count, low..=high);
    }
    let mut list: Vec<[u32; 3]> = all().copied().collect();
    list.sort_unstable();
    list
}

/// Sorts so many triangles, fewer than 2^32, whose smallest indices lie in a range.
fn by_first<'a, T>(all: impl Fn() -> T, count: usize, range: RangeInclusive<u32>) -> Vec<[u32; 3]>
where
    T: Iterator<Item = &'a [u32; 3]>,
{
    let low = *range.start();
    let mut ends = vec![0u32; (range.end() - low) as usize + 1];
    all().for_each(|triangle| ends[(triangle[0] - low) as usize] += 1);
    let mut sum = 0;
    for end in &mut ends {
        let count = std::mem::replace(end, sum);
        sum += count;
    }
    let mut list = vec![[0; 3]; count];
    all().for_each(|triangle| {
        let place = &mut ends[(triangle[0] - low) as usize];
        list[*place as usize] = *triangle;
        *place += 1;
    });
    let mut first = 0;
    for end in ends.into_iter().map(|end| end as usize) {
        list[first..end].sort_unstable();
        first = end;
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_of_sorting_agree() {
        for (count, most) in [(0, 1), (1, u64::MAX), (1000, 300), (1000, 1), (1000, 1 << 20)] {
            let number = |k: u64| (scattered(k) % most) as u32;
            let triangles: Vec<[u32; 3]> = (0..count).map(|k| [number(k), number(k + count), k as u32]).collect();
            let mut expected = triangles.clone();
            expected.sort_unstable();
            let (one, other) = triangles.split_at(triangles.len() / 3);
            let lists = [one, &[], other].map(|list| list.as_flattened().to_vec()).to_vec();
            assert_eq!(sorted(lists), expected, "{count} triangles of {most} points");
        }
    }
}
