//! The result of a contestant.

/// The seconds of a run, and the triangles in canonical order.
pub(super) struct Run {
    pub seconds: f64,
    pub triangles: Vec<[u32; 3]>,
}

/// Turns triangles so that their smallest numbers come first, and sorts them.
pub(super) fn canonical(mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    for triangle in &mut triangles {
        let smallest = (0..3).min_by_key(|&corner| triangle[corner]).unwrap_or(0);
        triangle.rotate_left(smallest);
    }
    triangles.sort_unstable();
    triangles
}
