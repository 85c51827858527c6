//! The diagram of a set, and its cells.

use alloc::vec::Vec;

use super::build::{self, NONE};
use super::corner::{vector, Corner};
use super::error::Error;
use crate::mesh::Mesh;
use crate::point::{Duplicate, Point};

/// The Voronoi diagram of the distinct points of a set.
///
/// Each distinct point has a cell: the places that are at least as near to it as to any other point. The cell of a
/// point with duplicates belongs to the lowest of their indices. Neighbours are points whose cells share an edge of
/// positive length. A set has exactly one diagram; see [the module](super).
///
/// The diagram takes about 70 bytes a point.
#[derive(Clone, Debug)]
pub struct Voronoi<'a> {
    pub(super) points: &'a [Point],
    duplicates: &'a [Duplicate],
    /// The edges of cell `i` are those from `starts[i]` to `starts[i + 1]`.
    starts: Vec<u32>,
    /// The point on the other side of each edge.
    neighbors: Vec<u32>,
    /// The Voronoi vertex at which each edge begins; [`NONE`] if it comes from infinity.
    corners: Vec<u32>,
    /// A triangle with each Voronoi vertex as its circumcentre.
    vertices: Vec<[u32; 3]>,
}

/// An edge of a cell, counter-clockwise around the cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// The point on the other side.
    pub neighbor: u32,
    /// The Voronoi vertex at which the edge begins; `None` if the edge comes from infinity.
    pub from: Option<u32>,
    /// The Voronoi vertex at which the edge ends; `None` if the edge goes to infinity.
    pub to: Option<u32>,
}

/// A cell of a diagram.
#[derive(Clone, Copy, Debug)]
pub struct Cell<'a> {
    point: u32,
    neighbors: &'a [u32],
    corners: &'a [u32],
}

impl<'a> Voronoi<'a> {
    /// Makes the diagram of a mesh.
    ///
    /// O(n): the two sides of every edge are sorted, and one walk around each point follows. The peak of memory is
    /// about 300 bytes a point. The mesh may have any diagonals where points lie on one circle: the diagram is the same
    /// but for the numbers of its vertices. Those follow the order of the triangles, so the canonical mesh gives
    /// canonical numbers. A mesh that is no Delaunay triangulation gives lists without meaning, and no panic.
    ///
    /// # Errors
    /// A coordinate has more than 31 bits, or the mesh names points that are not there or has a triangle that is not
    /// counter-clockwise.
    pub fn of(mesh: &'a Mesh<Point>) -> Result<Self, Error> {
        build::check(mesh)?;
        let lists = match mesh.is_collinear() {
            true => build::of_line(mesh.points.len(), &mesh.hull),
            false => build::of_triangles(mesh),
        };
        let build::Lists { starts, neighbors, corners, vertices } = lists;
        Ok(Self { points: &mesh.points, duplicates: &mesh.duplicates, starts, neighbors, corners, vertices })
    }

    /// The points of the set, in input order, duplicates included.
    pub fn points(&self) -> &'a [Point] {
        self.points
    }

    /// The number of Voronoi vertices, all at different places.
    pub fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    /// The exact place of a Voronoi vertex, by its number.
    ///
    /// # Panics
    /// If the number is not below [`vertex_count`](Self::vertex_count).
    #[inline]
    pub fn vertex(&self, vertex: u32) -> Corner {
        Corner::of_center(self.vertices[vertex as usize].map(|index| self.points[index as usize]))
    }

    /// The cell of a point; `None` if the point is a duplicate or does not exist.
    #[inline]
    pub fn cell(&self, point: u32) -> Option<Cell<'_>> {
        let is_duplicate = || self.duplicates.binary_search_by_key(&point, |duplicate| duplicate.index).is_ok();
        if point as usize >= self.points.len() || is_duplicate() {
            return None;
        }
        Some(self.cell_at(point))
    }

    /// The cells of all distinct points, in the order of the points. Nothing is allocated.
    pub fn cells(&self) -> impl Iterator<Item = Cell<'_>> {
        let mut duplicates = self.duplicates.iter().map(|duplicate| duplicate.index).peekable();
        let is_distinct = move |&point: &u32| duplicates.next_if_eq(&point).is_none();
        (0..self.points.len() as u32).filter(is_distinct).map(|point| self.cell_at(point))
    }

    /// The lists of a point that exists.
    #[inline]
    fn cell_at(&self, point: u32) -> Cell<'_> {
        let range = self.starts[point as usize] as usize..self.starts[point as usize + 1] as usize;
        Cell { point, neighbors: &self.neighbors[range.clone()], corners: &self.corners[range] }
    }

    /// The direction of the rays along the border between the cells of two points, with the cell of `from` on the left,
    /// in grid units: the vector from one to the other, turned by a quarter.
    pub fn direction(&self, from: u32, to: u32) -> [i64; 2] {
        let [x, y] = vector(self.points[from as usize], self.points[to as usize]);
        [-y, x]
    }
}

impl<'a> Cell<'a> {
    /// The index of the point to which the cell belongs.
    pub fn point(&self) -> u32 {
        self.point
    }

    /// The points whose cells share an edge of positive length, counter-clockwise. The first is the lowest, or in an
    /// unbounded cell the one behind the edge that comes from infinity.
    pub fn neighbors(&self) -> &'a [u32] {
        self.neighbors
    }

    /// The Voronoi vertices of the cell, counter-clockwise: the beginnings of its edges, without infinity.
    pub fn vertices(&self) -> impl Iterator<Item = u32> + 'a {
        self.corners.iter().copied().filter(|&corner| corner != NONE)
    }

    /// Whether the cell has no end to at least one side.
    pub fn is_unbounded(&self) -> bool {
        self.corners.first().is_none_or(|&corner| corner == NONE)
    }

    /// The edges of the cell, counter-clockwise. The only point of a set has a cell without edges.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + 'a {
        let (neighbors, corners) = (self.neighbors, self.corners);
        let known = |corner: u32| (corner != NONE).then_some(corner);
        (0..neighbors.len()).map(move |edge| {
            let next = if edge + 1 == corners.len() { 0 } else { edge + 1 };
            Edge { neighbor: neighbors[edge], from: known(corners[edge]), to: known(corners[next]) }
        })
    }
}
