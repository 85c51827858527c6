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

/// Brings triangles into canonical order, by counting their first corners. Takes the memory of a second list.
pub fn sorted(mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    let firsts = || triangles.iter().map(|triangle| triangle[0]);
    let (Some(low), Some(high)) = (firsts().min(), firsts().max()) else {
        return triangles;
    };
    let span = (high - low) as usize + 1;
    if span > triangles.len().saturating_mul(2) {
        triangles.sort_unstable();
        return triangles;
    }
    let mut places = vec![0u32; span];
    firsts().for_each(|first| places[(first - low) as usize] += 1);
    let mut sum = 0;
    for place in &mut places {
        sum += std::mem::replace(place, sum);
    }
    let mut list = vec![[0; 3]; triangles.len()];
    for triangle in &triangles {
        let place = &mut places[(triangle[0] - low) as usize];
        list[*place as usize] = *triangle;
        *place += 1;
    }
    list.chunk_by_mut(|one, other| one[0] == other[0]).for_each(<[_]>::sort_unstable);
    list
}
