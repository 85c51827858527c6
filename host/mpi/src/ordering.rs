//! The sixth step: the canonical order of all triangles, a stretch of it in each process.
//!
//! This is a sample sort: all processes put keys of some of their triangles together, choose the same bounds from them,
//! and send each triangle to the process between whose bounds it lies.

use std::ops::RangeInclusive;

use incircle_cli::scattered;

use crate::team::Team;

/// The keys of the sample for each process. The stretches of most processes are within 10 % of an equal share.
const KEYS_EACH: u64 = 1024;
/// The fewest keys of a large mesh.
const LEAST_KEYS: u64 = 1 << 16;

/// Sorts the triangles of all processes. Those of process 0 come first, then those of process 1, and so on.
///
/// Each triangle must have its smallest index first.
pub fn sort(team: &Team, triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    if team.size() == 1 {
        return sorted(triangles);
    }
    let bounds = bounds(team, &triangles);
    let mut lists = vec![Vec::new(); team.size()];
    for triangle in &triangles {
        lists[bounds.partition_point(|&bound| bound <= key(triangle))].extend_from_slice(triangle);
    }
    drop(triangles);
    let lists = team.exchange(lists);
    let mut own = Vec::with_capacity(lists.iter().map(|list| list.len() / 3).sum());
    lists.into_iter().for_each(|list| own.extend_from_slice(list.as_chunks().0));
    sorted(own)
}

/// The first two corners. They are enough: each directed edge has one triangle on its left.
fn key(triangle: &[u32; 3]) -> u64 {
    u64::from(triangle[0]) << u32::BITS | u64::from(triangle[1])
}

/// The lowest keys of all processes but the first.
fn bounds(team: &Team, triangles: &[[u32; 3]]) -> Vec<u64> {
    let size = team.size() as u64;
    let total = team.sum(&[triangles.len() as u64])[0];
    let wanted = LEAST_KEYS.max(KEYS_EACH * size);
    let limit = match total {
        total if total <= wanted => u64::MAX,
        total => ((u128::from(wanted) << u64::BITS) / u128::from(total)) as u64,
    };
    // The places of the triangles of different processes must not give the same sequence of choices.
    let first = (team.rank() as u64) << 40;
    let chosen = (first..).zip(triangles).filter(|&(place, _)| scattered(place) <= limit);
    let own: Vec<u64> = chosen.map(|(_, triangle)| key(triangle)).collect();
    let mut keys = team.gather(&own).concat();
    keys.sort_unstable();
    (1..size).map(|rank| keys.get(keys.len() * rank as usize / size as usize).copied().unwrap_or(u64::MAX)).collect()
}

/// Sorts a list. Most stretches have about as many triangles as there are indices between their bounds, and then two
/// passes by the smallest index and a sort of the few triangles with the same one take less time than a general sort.
fn sorted(mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    let firsts = || triangles.iter().map(|triangle| triangle[0]);
    let (Some(low), Some(high)) = (firsts().min(), firsts().max()) else { return triangles };
    if (high - low) as usize > 4 * triangles.len() {
        triangles.sort_unstable();
        return triangles;
    }
    by_first(&triangles, low..=high)
}

/// Sorts triangles whose smallest indices lie in a range.
fn by_first(triangles: &[[u32; 3]], range: RangeInclusive<u32>) -> Vec<[u32; 3]> {
    let low = *range.start();
    let mut ends = vec![0usize; (range.end() - low) as usize + 1];
    for triangle in triangles {
        ends[(triangle[0] - low) as usize] += 1;
    }
    let mut sum = 0;
    for end in &mut ends {
        let count = std::mem::replace(end, sum);
        sum += count;
    }
    let mut list = vec![[0; 3]; triangles.len()];
    for triangle in triangles {
        let place = &mut ends[(triangle[0] - low) as usize];
        list[*place] = *triangle;
        *place += 1;
    }
    let mut first = 0;
    for end in ends {
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
            assert_eq!(sorted(triangles), expected, "{count} triangles of {most} points");
        }
    }
}
