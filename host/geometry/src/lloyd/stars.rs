//! The triangles around each point, and the corners of cells as integers, without the lists of a diagram.

use alloc::vec;
use alloc::vec::Vec;

use super::centroid::BITS;
use super::quotient::floor_quotient;
use crate::cpu::in_parallel;
use crate::point::Point;
use crate::voronoi::center_seen;

/// Numerators and quotients of corners beyond this limit, in 2^-8 of a step, lie far beyond the grid, and are cut off.
const FAR: i64 = 1 << 50;
/// Up to so many triangles around a point, the next one is found by looking at all.
const FEW: usize = 24;

/// The triangles of a mesh by their points, and the centre of each.
pub(super) struct Stars<'a> {
    triangles: &'a [[u32; 3]],
    /// The centre of each triangle in 2^-8 of a step, rounded down; at [`FAR`] or beyond it is no more than a direction.
    centers: Vec<[i64; 2]>,
    /// The corners at point `i` are those from `starts[i]` to `starts[i + 1]`; corner `3 t + k` is that of triangle `t`.
    starts: Vec<u32>,
    corners: Vec<u32>,
}

/// The neighbours of a point, counter-clockwise, and the centres between each and the next.
#[derive(Default)]
pub(super) struct Star {
    pub(super) neighbors: Vec<u32>,
    pub(super) centers: Vec<[i64; 2]>,
    /// The triangles in the order of the list: the two other points of each, and its number.
    around: Vec<[u32; 3]>,
}

impl<'a> Stars<'a> {
    /// The stars of a mesh whose points have coordinates below 2^31. O(n).
    pub(super) fn of(points: &[Point], triangles: &'a [[u32; 3]], threads: usize) -> Self {
        let mut centers = vec![[0; 2]; triangles.len()];
        let share = triangles.len().div_ceil(threads).max(1);
        in_parallel(triangles.chunks(share).zip(centers.chunks_mut(share)), |(triangles, centers)| {
            for (triangle, center) in triangles.iter().zip(centers) {
                *center = rounded_center(triangle.map(|index| points[index as usize]));
            }
        });
        let mut starts = vec![0; points.len() + 1];
        triangles.iter().flatten().for_each(|&index| starts[index as usize + 1] += 1);
        let mut sum = 0;
        for start in &mut starts {
            sum += *start;
            *start = sum;
        }
        // Each start moves to the end of its list while the list is filled, and back afterwards.
        let mut corners = vec![0; 3 * triangles.len()];
        for (corner, &index) in triangles.iter().flatten().enumerate() {
            let place = &mut starts[index as usize];
            corners[*place as usize] = corner as u32;
            *place += 1;
        }
        starts.rotate_right(1);
        starts[0] = 0;
        Self { triangles, centers, starts, corners }
    }

    /// Fills in the star of a point. Whether triangles surround the point; if not, all its neighbours are there, in any
    /// order.
    pub(super) fn star(&self, point: u32, star: &mut Star) -> bool {
        let range = self.starts[point as usize] as usize..self.starts[point as usize + 1] as usize;
        star.around.clear();
        star.around.extend(self.corners[range].iter().map(|&corner| {
            let (triangle, k) = (corner / 3, corner as usize % 3);
            let [a, b, c] = self.triangles[triangle as usize];
            let twice = [a, b, c, a, b];
            [twice[k + 1], twice[k + 2], triangle]
        }));
        star.order(&self.centers)
    }
}

impl Star {
    /// Puts neighbours and centres in order.
    fn order(&mut self, centers: &[[i64; 2]]) -> bool {
        self.neighbors.clear();
        self.centers.clear();
        let Some(&[first, ..]) = self.around.first() else { return false };
        if self.around.len() > FEW {
            self.around.sort_unstable();
        }
        let mut at = first;
        for _ in 0..self.around.len() {
            let Some([_, next, triangle]) = self.that_begins_at(at) else { break };
            self.neighbors.push(at);
            self.centers.push(centers[triangle as usize]);
            at = next;
        }
        if at == first {
            return true;
        }
        self.neighbors.clear();
        self.neighbors.extend(self.around.iter().flat_map(|&[from, to, _]| [from, to]));
        self.neighbors.sort_unstable();
        self.neighbors.dedup();
        false
    }

    fn that_begins_at(&self, point: u32) -> Option<[u32; 3]> {
        if self.around.len() <= FEW {
            return self.around.iter().find(|[from, ..]| *from == point).copied();
        }
        let place = self.around.binary_search_by_key(&point, |[from, ..]| *from).ok()?;
        Some(self.around[place])
    }
}

/// The centre of a counter-clockwise triangle in 2^-8 of a step, rounded down; see [`Stars::centers`].
fn rounded_center(triangle: [Point; 3]) -> [i64; 2] {
    let ([x, y], d) = center_seen(triangle);
    let origin = triangle[0];
    // Numerators are below 2^96.
    let place = |from: u32, n: i128| {
        let seen = floor_quotient(n << BITS, i128::from(d)).clamp(i128::from(-FAR), i128::from(FAR));
        (i64::from(from) << BITS) + seen as i64
    };
    [place(origin.x, x), place(origin.y, y)]
}
