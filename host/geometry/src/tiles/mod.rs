//! Sets of any size, by tiles: the exact mesh of more points than one memory, device or machine can hold.
//!
//! The plane is cut into regions, and each region's points are triangulated alone, on any back end. Most triangles of
//! such a tile are in the mesh of the whole set already, and one question about a triangle proves it ([`reach`]). What
//! is not proved yet is a narrow border, and borders are joined like tiles, up to the whole plane. The result is the
//! canonical mesh, byte for byte, whatever the cuts are.
//!
//! | step | function | in | out |
//! |---|---|---|---|
//! | cut the plane | [`Tree::of_positions`] | positions along the Z-curve | tiles, and the order of joins |
//! | triangulate a tile | any back end | the points of one region | their mesh |
//! | find what is final | [`local`] | that mesh, and the region | final triangles, the border |
//! | join neighbours | [`join`], or [`Union`] with any back end | borders | final triangles, one border |
//!
//! All functions are pure: they know no file, thread or device. [`triangulate`] does all steps in the memory of one
//! process. A carrier of its own may keep tiles in files, send borders between machines, or ask several boards at once.
//!
//! **The theorem.** A triangle of a tile is *final* if its closed circumscribed disc lies strictly within the region of
//! the tile. A final triangle is in the mesh of the whole set, ties included: points beyond the region are neither
//! inside its circle nor on it, so none of them conflicts with it. All other triangles of the whole mesh have their
//! corners in the borders. `docs/tiles.md` has the proof, and what goes wrong if a disc that touches a side counts.
//!
//! A carrier that knows where points are ([`Occupancy`]) finds more: a triangle whose disc touches no occupied place
//! beyond its region is final as well ([`local_among`]). Points on curves need this, because their discs are large and
//! empty.
//!
//! ```
//! use core::num::NonZeroUsize;
//! use core::ops::ControlFlow;
//! use incircle_geometry::tiles::{join, local, Region};
//! use incircle_geometry::{cpu, Mesh, Point};
//!
//! let mesh_of = |points: &[Point]| -> Result<Mesh, cpu::Error> {
//!     cpu::triangulate(points.to_vec(), NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))
//! };
//! let points: Vec<Point> = (0..500u32).map(|k| Point::new(k * k % 1009, k * 7919 % 1013)).collect();
//!
//! // Two tiles, which could be on two machines.
//! let regions = Region::WHOLE.split_at_x(500);
//! let (mut triangles, mut borders) = (Vec::new(), Vec::new());
//! for region in regions {
//!     let ids: Vec<u32> = (0..500).filter(|&id| region.contains([points[id as usize].x.into(), 0])).collect();
//!     let own: Vec<Point> = ids.iter().map(|&id| points[id as usize]).collect();
//!     let tile = local(&mesh_of(&own)?, &ids, region)?;
//!     triangles.extend(tile.finals);
//!     borders.push(tile.border);
//! }
//!
//! // The join in the whole plane, where every triangle is final.
//! let last = join(Region::WHOLE, borders)?;
//! triangles.extend(last.finals);
//! triangles.sort_unstable();
//! let mesh = mesh_of(&points)?;
//! assert_eq!((triangles, last.hull), (mesh.triangles, mesh.hull));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! **Source.** The merge of partial triangulations by the triangles that are not proved: Funke and Sanders, *Parallel
//! d-D Delaunay triangulations in shared and distributed memory*, 2017. Ties, and the exact test of a disc, are added
//! here.

mod beyond;
mod disc;
mod error;
mod join;
mod local;
mod occupancy;
mod product;
pub(crate) mod reach;
pub(crate) mod region;
mod square;
#[cfg(test)]
mod tests;
mod tree;
mod triangulate;

pub use beyond::Beyond;
pub use error::Error;
pub use join::{join, join_among, Union};
pub use local::{local, local_among, Border, Tile};
pub use occupancy::{Occupancy, OccupiedCells};
pub use reach::{reach, Reach, Sides, TilePoint};
pub use region::Region;
pub use tree::{Step, Tree};
pub use triangulate::triangulate;
