//! The step from the records of the model to the canonical mesh.

use incircle_geometry::{Duplicate, Mesh, Point};
use incircle_model::Record;
use incircle_protocol::{infinite_vertex, MAX_MODEL_POINTS};

/// The canonical mesh of the records of a mesh of [`MAX_MODEL_POINTS`], in which vertex `v` is the point with
/// the index `order[v]`. O(n).
pub fn canonical(records: &[Record], order: &[u32], points: &[Point], duplicates: Vec<Duplicate>) -> Mesh {
    let infinite = infinite_vertex(MAX_MODEL_POINTS);
    let index = |vertex: u32| order[vertex as usize];
    let mut triangles = Vec::with_capacity(records.len());
    let mut following = vec![u32::MAX; points.len()];
    for record in records {
        match record.v.iter().position(|&vertex| vertex == infinite) {
            // A ghost triangle gives the hull edge from the vertex before the infinite one to the vertex after it.
            Some(slot) => {
                let v = record.rotated(slot).v;
                following[index(v[2]) as usize] = index(v[1]);
            }
            None => {
                let corners = record.v.map(index);
                let lowest = (0..3).min_by_key(|&corner| corners[corner]).unwrap_or(0);
                triangles.push([corners[lowest], corners[(lowest + 1) % 3], corners[(lowest + 2) % 3]]);
            }
        }
    }
    let triangles = sorted(&triangles, points.len());
    Mesh::new(points.to_vec(), triangles, around(&following), duplicates)
}

/// The hull from its lowest index on.
fn around(following: &[u32]) -> Vec<u32> {
    let start = following.iter().position(|&next| next != u32::MAX).map_or(u32::MAX, |index| index as u32);
    let mut hull = Vec::new();
    let mut index = start;
    while index != u32::MAX {
        hull.push(index);
        index = following[index as usize];
        if index == start {
            break;
        }
    }
    hull
}

/// Sorts triangles by counting their first corners, then sorts the few triangles of each corner.
fn sorted(triangles: &[[u32; 3]], points: usize) -> Vec<[u32; 3]> {
    let mut starts = vec![0u32; points];
    triangles.iter().for_each(|triangle| starts[triangle[0] as usize] += 1);
    let mut sum = 0;
    for start in &mut starts {
        sum += std::mem::replace(start, sum);
    }
    let mut sorted = vec![[0; 3]; triangles.len()];
    for triangle in triangles {
        let slot = &mut starts[triangle[0] as usize];
        sorted[*slot as usize] = *triangle;
        *slot += 1;
    }
    sorted.chunk_by_mut(|one, other| one[0] == other[0]).for_each(|corner| corner.sort_unstable());
    sorted
}
