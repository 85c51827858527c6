//! The mesh of the living points, as the CPU triangulator gives it.

use alloc::vec;
use alloc::vec::Vec;

use super::triangulation::Triangulation;
use crate::mesh::{smallest_first, Mesh};
use crate::plane_point::PlanePoint;
use crate::point::Duplicate;

impl<P: PlanePoint> Triangulation<P> {
    /// The indices of all living points, duplicates included, in rising order. O(n log n).
    pub fn indices(&self) -> Vec<u32> {
        if self.next as usize == self.len() {
            return (0..self.next).collect();
        }
        let mut indices: Vec<u32> = self.names.iter().map(|(index, _)| index).collect();
        indices.sort_unstable();
        indices
    }

    /// The canonical mesh of the living points: the same as [`cpu::triangulate`](crate::cpu::triangulate) gives for
    /// them in the order of their indices.
    ///
    /// While there are constraints, it is the canonical constrained mesh of all triangles of the hull, as
    /// [`constrain`](crate::constraints::constrain) makes it. To take the triangles of a domain, give that function
    /// this mesh with the constraints.
    ///
    /// Indices in the mesh count the living points: index `k` in the mesh is that of the point
    /// [`indices()`](Self::indices)`[k]`. O(n log n).
    ///
    /// ```
    /// use incircle_geometry::Triangulation;
    ///
    /// let mut changing = Triangulation::from([[0, 0], [9, 9], [4, 0], [0, 4]])?;
    /// changing.delete(1)?;
    /// assert_eq!(changing.mesh().triangles, [[0, 1, 2]]);
    /// assert_eq!(changing.indices(), [0, 2, 3]);
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    pub fn mesh(&self) -> Mesh<P> {
        let indices = self.indices();
        let base = self.base();
        let mut ranks = vec![0u32; base.vertices.len()];
        let mut points = Vec::with_capacity(indices.len());
        let mut duplicates = Vec::new();
        for (rank, &index) in (0u32..).zip(&indices) {
            let Some(vertex) = self.names.get(index) else { continue };
            let own = &base.vertices[vertex as usize];
            points.push(own.point);
            if own.name == index {
                ranks[vertex as usize] = rank;
            } else {
                duplicates.push(Duplicate { index: rank, of: ranks[vertex as usize] });
            }
        }
        let rank = |vertex: u32| ranks[vertex as usize];
        let finite = self.shown().plane.iter().filter(|(_, triangle)| triangle.infinite_slot().is_none());
        let triangles = finite.map(|(_, triangle)| smallest_first(triangle.vertices.map(rank))).collect();
        Mesh::new(points, sorted(triangles, indices.len()), self.hull_ranks(rank), duplicates)
    }

    fn hull_ranks(&self, rank: impl Fn(u32) -> u32) -> Vec<u32> {
        let base = self.base();
        let corners = base.ghosts(base.plane.ghost).map(|ghost| base.hull_vertex(ghost));
        let mut hull: Vec<u32> = corners.chain(base.line.values().copied()).map(rank).collect();
        if base.is_plane() {
            let first = (0..hull.len()).min_by_key(|&place| hull[place]).unwrap_or(0);
            hull.rotate_left(first);
        }
        hull
    }
}

/// Sorts triangles whose smallest index comes first: into one list for each first index, and then each list. O(n) if
/// few triangles share a first index.
pub(super) fn sorted(triangles: Vec<[u32; 3]>, points: usize) -> Vec<[u32; 3]> {
    let mut ends = vec![0usize; points + 1];
    triangles.iter().for_each(|triangle| ends[triangle[0] as usize + 1] += 1);
    for place in 1..ends.len() {
        ends[place] += ends[place - 1];
    }
    let mut sorted = vec![[0; 3]; triangles.len()];
    for triangle in triangles {
        let end = &mut ends[triangle[0] as usize];
        sorted[*end] = triangle;
        *end += 1;
    }
    sorted.chunk_by_mut(|one, other| one[0] == other[0]).for_each(<[_]>::sort_unstable);
    sorted
}
