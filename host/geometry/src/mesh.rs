//! The canonical mesh of a point set.

use alloc::vec;
use alloc::vec::Vec;
use core::hint::select_unpredictable;

use crate::edges::EdgeList;
use crate::plane_point::PlanePoint;
use crate::point::{Duplicate, Point};
use crate::verify::{self, VerifyError};

/// Marks in [`Mesh::halfedges`] that there is no triangle on the other side: the edge lies on the hull.
pub const EMPTY: u32 = u32::MAX;

/// A triangle, turned so that the smallest of its indices or ids comes first.
#[inline(always)]
pub(crate) fn smallest_first<I: Copy + Ord>([a, b, c]: [I; 3]) -> [I; 3] {
    // Selections instead of branches, because no processor predicts which corner is the smallest.
    let (is_b, is_c) = ((b < a) & (b < c), (c < a) & (c < b));
    let pick = |from_a, from_b, from_c| select_unpredictable(is_b, from_b, select_unpredictable(is_c, from_c, from_a));
    [pick(a, b, c), pick(b, c, a), pick(c, a, b)]
}

/// The Delaunay triangulation of the distinct points of a set, in canonical form.
///
/// A set of points has exactly one mesh: every back end and every order of insertion gives the same lists. Two meshes
/// are equal if all four lists are equal, so `==` on two meshes of the same points shows whether
/// two back ends disagree.
///
/// A mesh comes from [`cpu::triangulate`](crate::cpu::triangulate) or from the library `incircle`. The points keep the
/// type in which they were given. All indices are positions in [`points`](Self::points). `n` distinct points with `h`
/// of them on the hull have `2 n - 2 - h` triangles.
///
/// ```
/// use core::num::NonZeroUsize;
/// use core::ops::ControlFlow;
/// use incircle_geometry::{cpu, Point};
///
/// let points = [(0, 0), (4, 0), (4, 4), (0, 4), (4, 0)].map(Point::from).to_vec();
/// let mesh = cpu::triangulate(points, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))?;
/// assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
/// assert_eq!(mesh.hull, [0, 1, 2, 3]);
/// assert_eq!((mesh.duplicates[0].index, mesh.duplicates[0].of), (4, 1));
/// # Ok::<(), cpu::Error>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mesh<P = Point> {
    /// The input points, in input order, duplicates included.
    pub points: Vec<P>,
    /// Triples of indices into `points` in sorted order, counter-clockwise if y grows upwards, each with
    /// its smallest index first.
    pub triangles: Vec<[u32; 3]>,
    /// Indices of the points on the hull, counter-clockwise, lowest index first; points in the middle of a hull edge
    /// are included. A mesh without triangles lists all distinct points in lexicographic order here.
    pub hull: Vec<u32>,
    /// Input points with the coordinates of an earlier one, sorted by index.
    pub duplicates: Vec<Duplicate>,
}

impl<P> Default for Mesh<P> {
    fn default() -> Self {
        Self::new(Vec::new(), Vec::new(), Vec::new(), Vec::new())
    }
}

impl<P> Mesh<P> {
    /// Makes a mesh of its four lists, without any check. Call [`Mesh::verify`] on lists from elsewhere.
    pub fn new(points: Vec<P>, triangles: Vec<[u32; 3]>, hull: Vec<u32>, duplicates: Vec<Duplicate>) -> Self {
        Self { points, triangles, hull, duplicates }
    }

    /// Whether the mesh has no triangles, because there are fewer than three distinct points or all lie on one line.
    pub fn is_collinear(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The neighbours of each triangle, for walks through the mesh and floods of regions.
    ///
    /// Neighbour `k` of a triangle lies across the edge opposite its vertex `k`; on the hull there is `None`. The list
    /// is computed at each call, so keep it. O(n) by a radix sort of the edges, with 190 bytes a point while it runs.
    ///
    /// ```
    /// use incircle_geometry::{Mesh, Point};
    ///
    /// let square = Mesh::<Point>::new(Vec::new(), vec![[0, 1, 2], [0, 2, 3]], Vec::new(), Vec::new());
    /// assert_eq!(square.neighbors(), [[None, Some(1), None], [None, None, Some(0)]]);
    /// ```
    pub fn neighbors(&self) -> Vec<[Option<u32>; 3]> {
        let mut neighbors = vec![[None; 3]; self.triangles.len()];
        for [one, other] in EdgeList::of(&self.triangles).pairs() {
            for (from, to) in [(one, other), (other, one)] {
                let (triangle, side) = (from / 3, from % 3);
                neighbors[triangle as usize][(side as usize + 2) % 3] = Some(to / 3);
            }
        }
        neighbors
    }

    /// The half-edges in the convention of delaunator, for code that was written for that library.
    ///
    /// Half-edge `3 t + k` runs from vertex `k` of triangle `t` to the next one. The value at that place is the
    /// half-edge of the same edge in the other triangle, or [`EMPTY`] on the hull. O(n), as [`Mesh::neighbors`].
    ///
    /// ```
    /// use incircle_geometry::{Mesh, Point, EMPTY};
    ///
    /// let square = Mesh::<Point>::new(Vec::new(), vec![[0, 1, 2], [0, 2, 3]], Vec::new(), Vec::new());
    /// assert_eq!(square.halfedges(), [EMPTY, EMPTY, 3, 2, EMPTY, EMPTY]);
    /// ```
    pub fn halfedges(&self) -> Vec<u32> {
        let mut halfedges = vec![EMPTY; 3 * self.triangles.len()];
        for [one, other] in EdgeList::of(&self.triangles).pairs() {
            halfedges[one as usize] = other;
            halfedges[other as usize] = one;
        }
        halfedges
    }
}

impl<P: PlanePoint> Mesh<P> {
    /// Proves with the independent validator that the whole mesh is the canonical one, hull and duplicates included.
    ///
    /// O(n log n). The function [`verify`](fn@crate::verify) checks triangles without a hull and duplicates.
    ///
    /// # Errors
    /// The first defect found, with its numbers.
    pub fn verify(&self) -> Result<(), VerifyError> {
        let summary = verify::verify(&self.points, &self.triangles)?;
        verify::check_hull(&self.hull, &summary)?;
        verify::check_duplicates(&self.points, &self.duplicates)
    }
}
