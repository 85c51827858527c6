//! Constrained meshes.

use alloc::vec::Vec;

use super::pieces::Pieces;

/// A constrained mesh: the triangles of the domain, and what became of the constraints.
///
/// Hull and duplicates are those of the mesh without constraints.
#[non_exhaustive]
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Constrained {
    /// The triangles of the domain, in the form of [`Mesh::triangles`](crate::Mesh::triangles).
    pub triangles: Vec<[u32; 3]>,
    /// The region of each triangle. A region is a part of the domain that no constraint cuts; regions have the numbers
    /// 0, 1 and so on in the order of their first triangles. If all triangles are asked for and no place of a region is
    /// given, all of them are region 0, because nobody needs the regions and they take time.
    pub regions: Vec<u32>,
    /// The number of regions.
    pub region_count: u32,
    /// The region at each place of [`Plan::regions`](crate::plan::Plan::regions).
    pub marked: Vec<u32>,
    /// The edges that the constraints fix, also those outside the domain.
    pub pieces: Pieces,
    /// Twice the area of the domain, for points of the grid only.
    pub twice_area: Option<i128>,
}
