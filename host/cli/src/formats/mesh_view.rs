//! The form in which writers get a mesh.

use crate::number::Coordinate;
use crate::planned::Planned;
use crate::points::PointTable;

/// A mesh with the coordinates of its input file, for writers.
#[derive(Clone, Copy, Debug)]
pub struct MeshView<'a> {
    /// All input points, with the coordinates of the input file.
    pub points: &'a PointTable,
    /// Counter-clockwise triples of indices into `points`.
    pub triangles: &'a [[u32; 3]],
    /// The hull, counter-clockwise; without triangles the distinct points along their line.
    pub hull: &'a [u32],
    /// Pairs of a duplicate and the lowest index at the same place.
    pub duplicates: &'a [[u32; 2]],
    /// The regions and pieces that constraints made, if there are any.
    pub planned: Option<&'a Planned>,
}

impl MeshView<'_> {
    /// The attribute of a triangle in a file of Shewchuk's Triangle; `None` if it has none.
    pub fn attribute(&self, triangle: usize) -> Option<String> {
        let planned = self.planned?;
        planned.attribute(*planned.made.regions.get(triangle)?)
    }

    /// The coordinates of a vertex, in the numbers of the file. A vertex that does not exist, which no mesh of the
    /// library has, is at the origin.
    pub fn position(&self, vertex: u32) -> [Coordinate; 2] {
        [0, 1].map(|axis| self.points.coordinate(vertex as usize, axis))
    }

    /// The coordinates of all points in the numbers of the file, and the z, which is 0 if the file has none.
    pub fn positions(&self) -> impl Iterator<Item = ([Coordinate; 2], Coordinate)> + '_ {
        let heights = self.points.heights();
        let position = |index| [0, 1].map(|axis| self.points.coordinate(index, axis));
        let height = |index| Coordinate::Double(heights.get(index).copied().unwrap_or(0.0));
        (0..self.points.len()).map(move |index| (position(index), height(index)))
    }
}
