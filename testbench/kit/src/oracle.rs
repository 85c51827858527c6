//! The canonical Delaunay triangulation by its definition: for small sets, and for nothing but comparison.
//!
//! A triangle belongs to the answer if no point conflicts with it. The tie rule decides points on the circle: of the
//! four cocircular points the lexicographically smallest is lowered on the paraboloid by an infinitely small amount, so
//! each set of points has exactly one answer.

/// Twice the area of `a b c`: positive if the three turn counter-clockwise, 0 if they lie on a line, and
/// exact for all coordinates.
pub fn orient2d<P: Into<[u32; 2]>>(a: P, b: P, c: P) -> i128 {
    let [a, b, c] = [a.into(), b.into(), c.into()];
    let from_a = |point: [u32; 2], axis: usize| i128::from(point[axis]) - i128::from(a[axis]);
    from_a(b, 0) * from_a(c, 1) - from_a(b, 1) * from_a(c, 0)
}

/// Whether `d` lies inside the circle of the counter-clockwise `a b c`, by the tie rule if `d` lies on the circle.
/// Exact for coordinates of up to 31 bits: the sum is below 3 * 2^125.
pub fn conflicts<P: Copy + Into<[u32; 2]>>(a: P, b: P, c: P, d: P) -> bool {
    let [a, b, c, d] = [a, b, c, d].map(Into::into);
    let lift = |point: [u32; 2]| {
        let [x, y] = [0, 1].map(|axis| i128::from(point[axis]) - i128::from(d[axis]));
        x * x + y * y
    };
    let inside = lift(a) * orient2d(d, b, c) + lift(b) * orient2d(d, c, a) + lift(c) * orient2d(d, a, b);
    if inside != 0 {
        return inside > 0;
    }
    // Lowering a corner changes the determinant by minus the factor of the corner's lift. If `d` is
    // lowered, `d` moves inside.
    match [a, b, c, d].into_iter().min() {
        Some(smallest) if smallest == a => orient2d(d, b, c) < 0,
        Some(smallest) if smallest == b => orient2d(d, c, a) < 0,
        Some(smallest) if smallest == c => orient2d(d, a, b) < 0,
        _ => true,
    }
}

/// The canonical triangles: all counter-clockwise triples that no point conflicts with. O(n^4).
///
/// Corners are places in `points`, the smallest first, and the list is sorted. Of equal points the first counts.
pub fn delaunay<P: Copy + Into<[u32; 2]>>(points: &[P]) -> Vec<[u32; 3]> {
    let points: Vec<[u32; 2]> = points.iter().map(|&point| point.into()).collect();
    let is_first = |place: usize| points.iter().position(|point| *point == points[place]) == Some(place);
    let distinct: Vec<usize> = (0..points.len()).filter(|&place| is_first(place)).collect();
    let mut triangles = Vec::new();
    for (done, &i) in distinct.iter().enumerate() {
        for &j in &distinct[done + 1..] {
            for &k in &distinct[done + 1..] {
                let [a, b, c] = [i, j, k].map(|place| points[place]);
                let is_harmless = |&m: &usize| [i, j, k].contains(&m) || !conflicts(a, b, c, points[m]);
                if orient2d(a, b, c) > 0 && distinct.iter().all(is_harmless) {
                    triangles.push([i as u32, j as u32, k as u32]);
                }
            }
        }
    }
    triangles.sort_unstable();
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_points_of_a_square_are_cut_by_the_tie_rule() {
        // (0, 0) is lowered, so the circles of both triangles at (0, 0) stay empty: the diagonal starts there.
        assert_eq!(delaunay(&[[0, 0], [1, 0], [1, 1], [0, 1]]), [[0, 1, 2], [0, 2, 3]]);
        // Points in another order: the places in the answer change, the diagonal stays.
        assert_eq!(delaunay(&[[1, 1], [0, 1], [0, 0], [1, 0]]), [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn small_and_flat_sets_have_no_triangle() {
        let none: [[u32; 3]; 0] = [];
        assert_eq!(delaunay::<[u32; 2]>(&[]), none);
        assert_eq!(delaunay(&[[3, 3], [3, 3], [4, 4]]), none);
        assert_eq!(delaunay(&[[0, 0], [1, 1], [2, 2], [3, 3]]), none);
    }

    #[test]
    fn of_equal_points_the_first_counts() {
        assert_eq!(delaunay(&[[5, 5], [0, 0], [5, 5], [9, 0], [0, 0]]), [[0, 1, 3]]);
    }

    #[test]
    fn the_widest_coordinates_are_exact() {
        let last = (1 << 31) - 1;
        let corners = [[0, 0], [last, 0], [last, last], [0, last]];
        assert_eq!(delaunay(&corners), [[0, 1, 2], [0, 2, 3]]);
        // One grid step inside the circle of the others there is no tie any more.
        let inside = [[1, 1], [last, 0], [last, last], [0, last]];
        assert_eq!(delaunay(&inside), [[0, 1, 2], [0, 2, 3]]);
        assert!(conflicts(inside[1], inside[2], inside[3], inside[0]));
    }

    #[test]
    fn triangles_cover_the_hull() {
        let mut random = crate::SplitMix64::new(3);
        for _ in 0..200 {
            let points: Vec<[u32; 2]> = random.points(9, 6);
            let area: i128 = delaunay(&points).iter().map(|t| orient2d_of(&points, t)).sum();
            // The same area by the hull: the points in angular order around any direction, by Andrew's chain.
            assert_eq!(area, hull_area(&points), "{points:?}");
        }
    }

    fn orient2d_of(points: &[[u32; 2]], triangle: &[u32; 3]) -> i128 {
        let [a, b, c] = triangle.map(|corner| points[corner as usize]);
        orient2d(a, b, c)
    }

    /// Twice the area of the convex hull (A. M. Andrew's two chains, 1979).
    fn hull_area(points: &[[u32; 2]]) -> i128 {
        let mut sorted = points.to_vec();
        sorted.sort_unstable();
        let chain = |points: &mut dyn Iterator<Item = [u32; 2]>| {
            let mut chain: Vec<[u32; 2]> = Vec::new();
            for point in points {
                while chain.len() > 1 && orient2d(chain[chain.len() - 2], chain[chain.len() - 1], point) <= 0 {
                    chain.pop();
                }
                chain.push(point);
            }
            chain
        };
        let lower = chain(&mut sorted.iter().copied());
        let upper = chain(&mut sorted.iter().rev().copied());
        let hull: Vec<[u32; 2]> = lower.into_iter().chain(upper).collect();
        hull.windows(2).map(|edge| orient2d(hull[0], edge[0], edge[1])).sum()
    }
}
