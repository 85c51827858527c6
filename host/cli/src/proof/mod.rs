//! Proof that a mesh is the canonical one, within a bound on the memory: points and triangles lie in files.
//!
//! The tests themselves are those of the validator ([`incircle::verify::local`]), and the first defect is the one that
//! the validator finds in memory. What the validator does by looking up points and edges, this module does by sorting:
//!
//! 1. [`points`]: all points are sorted by x and y. So equal ones meet, the hull is two chains, and the distinct ones are
//!    cut into *strips* of as many consecutive points as fit the memory.
//! 2. [`list`]: the list of triangles is read once. Its order shows, and each triangle goes to the strip of its first
//!    corner. First corners rise, so their points are read in the order of the input.
//! 3. [`triangles`]: strip by strip, most triangles have all corners in the strip. The points of the others are found by
//!    sorting their corners by index. Then each triangle is checked.
//! 4. [`edges`]: strip by strip, the sides of each edge meet in the strip of the lower index, where the edge is checked.
//!
//! Nothing but the reading of files and the lattice of the points is shared with the code that makes meshes in tiles.

mod budget;
mod edges;
mod list;
mod mesh;
mod place;
mod points;
mod sorter;
mod spill;
mod stack;
mod strips;
mod triangles;

use std::path::{Path, PathBuf};

use incircle::verify::local;
use incircle::VerifyError;

use crate::arguments::ReadArguments;
use crate::failure::{counted, Failure};
use crate::formats::MeshFormat;
use crate::memory::Memory;
use crate::tiles::{self, Ground};
use crate::{output, path};

use budget::Budget;
use mesh::MeshFile;
use place::Place;
use points::{Sites, Survey};

/// A mesh to be checked, and where.
pub struct Plan<'a> {
    /// The files of points, which are one set.
    pub points: &'a [PathBuf],
    /// The options for reading the points.
    pub read: &'a ReadArguments,
    /// The file of the mesh.
    pub mesh: &'a Path,
    /// The format of the mesh, which must be [streamed](MeshFormat::is_streamed).
    pub format: MeshFormat,
    /// Whether the triangles may be in any order.
    pub is_unordered: bool,
    /// The most bytes that the process may take.
    pub memory: u64,
    /// The folder for files that are gone at the end.
    pub scratch: &'a Path,
    /// Whether no progress is shown.
    pub quiet: bool,
}

/// The counts of a mesh that is the canonical one, as in [`incircle::VerifySummary`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Proven {
    /// The number of points.
    pub points: u64,
    /// The number of distinct points.
    pub distinct: u64,
    /// The number of triangles.
    pub triangles: u64,
    /// The number of edges.
    pub edges: u64,
    /// The number of ties.
    pub ties: u64,
    /// The number of points on the hull.
    pub hull: u64,
    /// Whether all points lie on one line.
    pub collinear: bool,
    /// The lattice of the points.
    pub ground: Ground,
}

/// Checks a mesh. `Ok(Err(_))` has the first defect of a wrong one.
///
/// # Errors
/// A file cannot be read or has changed, the points have no lattice of up to 32 bits, the memory is too small, or the
/// disk has no room.
pub fn prove(plan: &Plan<'_>) -> Result<Result<Proven, VerifyError>, Failure> {
    let budget = Budget::of(plan.memory)?;
    Memory::give_back_lists();
    prove_within(plan, &budget)
}

fn prove_within(plan: &Plan<'_>, budget: &Budget) -> Result<Result<Proven, VerifyError>, Failure> {
    let survey = Survey::of(plan.points, plan.read, plan.quiet)?;
    check_disk(plan, budget, survey.points)?;
    let inputs = (plan.points, plan.read, plan.quiet);
    let sites = Sites::of(&survey, inputs, plan.scratch, budget)?;
    let mut mesh = MeshFile::new(plan.mesh, plan.format, budget.share(8));
    if plan.is_unordered {
        mesh.sort(plan.scratch)?;
    }
    let mut proven = Proven {
        points: survey.points,
        distinct: sites.distinct,
        triangles: 0,
        edges: 0,
        ties: 0,
        hull: sites.hull.count,
        collinear: sites.is_collinear,
        ground: survey.ground,
    };
    if sites.is_collinear {
        return Ok(match mesh.count()? {
            0 => Ok(proven),
            triangles => Err(VerifyError::TrianglesOfCollinearPoints { triangles }),
        });
    }
    let place = Place { folder: plan.scratch, quiet: plan.quiet };
    let edges = match checked_edges(&mesh, &sites, place, budget)? {
        Ok((count, edges)) => {
            proven.triangles = count as u64;
            edges
        }
        Err(error) => return Ok(Err(error)),
    };
    (proven.edges, proven.ties) = (edges.count, edges.ties);
    Ok(edges.error(&mesh)?.map_or(Ok(proven), Err))
}

/// Checks triangles and counts, and then looks at all edges. Gives the number of triangles, too.
fn checked_edges(
    mesh: &MeshFile,
    sites: &Sites,
    place: Place<'_>,
    budget: &Budget,
) -> Result<Result<(usize, edges::Edges), VerifyError>, Failure> {
    let list = list::read(mesh, sites, place, budget)?;
    let checked = triangles::check((mesh, &list.deal), sites, place, budget)?;
    if let Some(error) = checked.error.or(list.error) {
        return Ok(Err(error));
    }
    if let Err(error) = local::check_count(list.count, sites.distinct as usize, sites.hull.count as usize) {
        return Ok(Err(error));
    }
    if let Some(index) = list.used.first_unused(mesh, sites, budget.share(16))? {
        return Ok(Err(VerifyError::UnusedPoint { index }));
    }
    if let Err(error) = local::check_area(checked.area, sites.hull.area) {
        return Ok(Err(error));
    }
    let edges = edges::check((&list.deal, &checked.sides), sites, budget, place.quiet)?;
    Ok(Ok((list.count, edges)))
}

/// Refuses a set for which the disk has no room, and says how much is needed.
fn check_disk(plan: &Plan<'_>, budget: &Budget, points: u64) -> Result<(), Failure> {
    let needed = budget.disk(points, plan.is_unordered);
    tiles::room_for(plan.scratch, needed)?;
    if !plan.quiet {
        output::note(&format!(
            "{}: up to {} in {} while the mesh is checked",
            counted(points as usize, "point"),
            tiles::told(needed),
            path::name(plan.scratch)
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests;
