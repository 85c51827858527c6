//! The points nearest to a place, and those in a circle.

use alloc::collections::{BTreeSet, BinaryHeap};
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Ordering;

use super::triangulation::Triangulation;
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// A vertex in a heap that gives the nearest first.
#[derive(Clone, Copy)]
struct Candidate<S> {
    place: S,
    site: S,
    vertex: u32,
}

impl<S: Site> Ord for Candidate<S> {
    fn cmp(&self, other: &Self) -> Ordering {
        S::compare_nearness(self.place, other.site, self.site)
    }
}

impl<S: Site> PartialOrd for Candidate<S> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<S: Site> PartialEq for Candidate<S> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<S: Site> Eq for Candidate<S> {}

impl<P: PlanePoint> Triangulation<P> {
    /// The indices of the `count` places nearest to a place, the nearest first; of places at the same distance, the one
    /// with the smaller x, then y, comes first. Fewer if there are not so many; none if a coordinate is infinite or not
    /// a number.
    ///
    /// O(k log k) beside the search for the first: each next one is a neighbour of one before.
    ///
    /// ```
    /// let mesh = incircle_geometry::Triangulation::from((0..25).map(|k| [k % 5, k / 5]))?;
    /// assert_eq!(mesh.k_nearest([2, 2], 5), [12, 11, 7, 17, 13]);
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    pub fn k_nearest(&self, point: P, count: usize) -> Vec<u32> {
        let (place, base) = (point.site(), self.base());
        let candidate = |vertex| Candidate { place, site: base.site(vertex), vertex };
        let first = self.nearest_vertex(place).filter(|_| count > 0);
        let mut seen: BTreeSet<u32> = first.into_iter().collect();
        let mut heap: BinaryHeap<_> = first.map(candidate).into_iter().collect();
        let mut found = Vec::new();
        while let Some(Candidate { vertex, .. }) = heap.pop() {
            found.push(self.name(vertex));
            if found.len() == count {
                break;
            }
            heap.extend(base.adjacent(vertex).filter(|&next| seen.insert(next)).map(candidate));
        }
        found
    }

    /// The indices of the places at most `radius` from a place, in rising order. The radius is the exact double that it
    /// is, and no distance is rounded. None if the radius is negative or not a number, or if a coordinate is infinite
    /// or not a number.
    ///
    /// O(k log k) for `k` of them, beside the search for the nearest.
    ///
    /// ```
    /// let mesh = incircle_geometry::Triangulation::from((0..25).map(|k| [k % 5, k / 5]))?;
    /// assert_eq!(mesh.within_circle([2, 2], 1.0), [7, 11, 12, 13, 17]);
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    pub fn within_circle(&self, center: P, radius: f64) -> Vec<u32> {
        let (q, base) = (center.site(), self.base());
        let is_inside = |&vertex: &u32| P::Site::is_within(q, base.site(vertex), radius);
        // From each vertex in the circle a path of ever nearer vertices leads to the nearest.
        let first = self.nearest_vertex(q).filter(is_inside);
        let mut seen: BTreeSet<u32> = first.into_iter().collect();
        let mut open: Vec<u32> = first.map_or(Vec::new(), |vertex| vec![vertex]);
        while let Some(vertex) = open.pop() {
            open.extend(base.adjacent(vertex).filter(is_inside).filter(|&next| seen.insert(next)));
        }
        let mut names: Vec<u32> = seen.into_iter().map(|vertex| self.name(vertex)).collect();
        names.sort_unstable();
        names
    }
}
