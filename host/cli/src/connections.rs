//! A mesh without its points.

use std::io::{self, Write};

use incircle::constraints::Triangulated;
use incircle::{Duplicate, Mesh};

use crate::formats::{MeshFormat, MeshView};
use crate::planned::Planned;
use crate::points::PointTable;

/// A mesh without its points, which are in the table of a file.
#[derive(Clone, Debug, Default)]
pub struct Connections {
    /// Counter-clockwise triples of indices.
    pub triangles: Vec<[u32; 3]>,
    /// The hull, counter-clockwise; without triangles the distinct points along their line.
    pub hull: Vec<u32>,
    /// Pairs of a duplicate and the lowest index at the same place.
    pub duplicates: Vec<[u32; 2]>,
    /// What constraints made of the mesh, if there are any.
    pub planned: Option<Planned>,
}

impl Connections {
    /// A mesh without its points.
    pub fn of_mesh<P>(mesh: Mesh<P>) -> Self {
        Self { triangles: mesh.triangles, hull: mesh.hull, duplicates: pairs(&mesh.duplicates), planned: None }
    }

    /// The triangles of a domain. What constraints made of the mesh is not there yet.
    pub fn of_domain(found: &Triangulated) -> Self {
        let (triangles, hull) = (found.made.triangles.clone(), found.hull.clone());
        Self { triangles, hull, duplicates: pairs(&found.duplicates), planned: None }
    }

    /// The mesh with other indices: `names` has the new one of each.
    pub fn renamed(&self, names: &[u32]) -> Self {
        let name = |index: u32| names.get(index as usize).copied().unwrap_or(index);
        Self {
            triangles: self.triangles.iter().map(|triangle| triangle.map(name)).collect(),
            hull: self.hull.iter().map(|&vertex| name(vertex)).collect(),
            duplicates: self.duplicates.iter().map(|pair| pair.map(name)).collect(),
            planned: None,
        }
    }

    /// Writes the mesh with the coordinates of the input file, not with those of the lattice.
    pub fn write(&self, points: &PointTable, format: MeshFormat, out: &mut dyn Write) -> io::Result<()> {
        let Self { triangles, hull, duplicates, planned } = self;
        format.write(&MeshView { points, triangles, hull, duplicates, planned: planned.as_ref() }, out)
    }
}

/// Duplicates as pairs.
fn pairs(duplicates: &[Duplicate]) -> Vec<[u32; 2]> {
    duplicates.iter().map(|duplicate| [duplicate.index, duplicate.of]).collect()
}
