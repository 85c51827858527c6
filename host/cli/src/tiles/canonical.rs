//! The canonical order of triangles, each of which has its smallest index first.

/// The number that orders triangles. Each directed edge has one triangle on its left, so two corners do.
#[inline]
pub fn key(triangle: &[u32; 3]) -> u64 {
    u64::from(triangle[0]) << u32::BITS | u64::from(triangle[1])
}

/// Whether triangles are in canonical order.
pub fn is_ordered(triangles: &[[u32; 3]]) -> bool {
    triangles.is_sorted_by_key(key)
}

/// The triangles of all lists in canonical order.
///
/// If they are about as many as the indices between their least and greatest first corners, they are counted by first
/// corner, which takes less time than a general sort.
pub fn sorted(lists: &[&[[u32; 3]]]) -> Vec<[u32; 3]> {
    let all = || lists.iter().copied().flatten();
    let firsts = || all().map(|triangle| triangle[0]);
    let (Some(low), Some(high)) = (firsts().min(), firsts().max()) else {
        return Vec::new();
    };
    let count: usize = lists.iter().map(|list| list.len()).sum();
    let span = (high - low) as usize + 1;
    if span > count.saturating_mul(4) || u32::try_from(count).is_err() {
        let mut list = lists.concat();
        list.sort_unstable();
        return list;
    }
    let mut places = vec![0u32; span];
    firsts().for_each(|first| places[(first - low) as usize] += 1);
    let mut sum = 0;
    for place in &mut places {
        sum += std::mem::replace(place, sum);
    }
    let mut list = vec![[0; 3]; count];
    for triangle in all() {
        let place = &mut places[(triangle[0] - low) as usize];
        list[*place as usize] = *triangle;
        *place += 1;
    }
    list.chunk_by_mut(|one, other| one[0] == other[0]).for_each(<[_]>::sort_unstable);
    list
}

#[cfg(test)]
mod tests {
    use incircle_testkit::SplitMix64;

    use super::*;

    #[test]
    fn both_ways_of_sorting_agree() {
        let mut random = SplitMix64::new(5);
        for (count, points) in [(0, 1), (1, u32::MAX), (1000, 300), (1000, 1), (1000, 1 << 20)] {
            let mut triangles: Vec<[u32; 3]> =
                (0..count).map(|_| [0; 3].map(|_: u32| random.below_u32(points))).collect();
            let (one, other) = triangles.split_at(triangles.len() / 3);
            let found = sorted(&[one, &[], other]);
            triangles.sort_unstable();
            assert_eq!(found, triangles, "{count} triangles of {points} points");
        }
    }
}
