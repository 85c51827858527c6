//! Meshes by tiles beside the mesh of all points at once.

mod cuts;
mod doubles;
mod errors;
mod large;
mod occupancy;
mod sets;
mod touching;
mod tree;

use core::num::NonZeroUsize;
use core::ops::ControlFlow;

use super::{join, local, Region, Tile, TilePoint};
use crate::cpu;
use crate::mesh::Mesh;
use crate::point::Duplicate;

fn mesh_of<P: TilePoint>(points: &[P]) -> Mesh<P> {
    cpu::triangulate(points.to_vec(), NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("a mesh")
}

/// How a region is divided for the tests.
#[derive(Clone, Debug)]
enum Division<C> {
    Tile,
    /// The areas, which are joined in one step.
    Areas(Vec<(Region<C>, Division<C>)>),
}

/// What tiles and joins have found so far.
struct Found<P> {
    points: Vec<P>,
    triangles: Vec<[u32; 3]>,
    duplicates: Vec<Duplicate>,
    unknown: usize,
}

impl<P: TilePoint> Found<P> {
    /// The mesh of the points, by tiles.
    fn mesh(points: &[P], division: &Division<P::Side>) -> (Mesh<P>, usize) {
        let mut found = Self { points: points.to_vec(), triangles: Vec::new(), duplicates: Vec::new(), unknown: 0 };
        let last = found.tile(Region::WHOLE, division);
        assert!(last.border.open.is_empty(), "the whole plane has no open triangles");
        let Self { points, mut triangles, mut duplicates, unknown } = found;
        triangles.sort_unstable();
        duplicates.sort_unstable();
        (Mesh { points, triangles, hull: last.hull, duplicates }, unknown)
    }

    fn tile(&mut self, region: Region<P::Side>, division: &Division<P::Side>) -> Tile<P, u32> {
        let tile = match division {
            Division::Tile => self.local(region),
            Division::Areas(areas) => {
                let children = areas.iter().map(|(region, division)| self.tile(*region, division).border).collect();
                join(region, children).unwrap_or_else(|error| panic!("{error}: {region:?}, {areas:?}"))
            }
        };
        self.triangles.extend(&tile.finals);
        self.unknown += tile.unknown;
        tile
    }

    fn local(&mut self, region: Region<P::Side>) -> Tile<P, u32> {
        let ids: Vec<u32> =
            (0..self.points.len() as u32).filter(|&id| region.contains(self.points[id as usize].place())).collect();
        let own: Vec<P> = ids.iter().map(|&id| self.points[id as usize]).collect();
        let mesh = mesh_of(&own);
        self.duplicates.extend(mesh.duplicates.iter().map(|duplicate| {
            let [index, of] = [duplicate.index, duplicate.of].map(|place| ids[place as usize]);
            Duplicate { index, of }
        }));
        local(&mesh, &ids, region).expect("points of the region")
    }
}
