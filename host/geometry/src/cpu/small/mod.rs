//! The CPU triangulator for many sets one after the other, in memory that is kept from set to set.
//!
//! The work is the same as for one large set, and so are the merges, but three things are cheaper for few points: the
//! points are sorted in one piece (`sites`), up to 10,922 of them have half-edges with numbers of 16 bits (`short`),
//! and the triangles are sorted in one piece (`collect`).

mod collect;
mod sites;
#[cfg(test)]
mod tests;

use alloc::vec::Vec;
use core::num::NonZeroUsize;
use core::ops::{ControlFlow, Range};

use bytemuck::Zeroable;

use self::collect::SmallCollect;
use self::sites::SmallSites;
use super::collect::hull;
use super::conquer::Waiting;
use super::edges::{Edges, Half, Halves, HALVES};
use super::short::{self, ShortHalves};
use super::subtrees::{divide, join, Own};
use super::triangulator::{check, connect, is_collinear, Error};
use super::view::{Integers, Narrow, Site, Wide, Widest, Width, NARROW_BITS, WIDE_BITS};
use crate::lattice::Numbers;
use crate::mesh::Mesh;
use crate::point::Point;

/// The CPU triangulator for many small sets. The triangulator keeps its memory from set to set, and so does the mesh.
///
/// One call for 200 points takes about 20 µs. A triangulator works on one thread, so a program with several threads
/// gives each thread a triangulator of its own. For up to about 100,000 points a triangulator is quicker than
/// [`triangulate`](super::triangulate) on one thread.
///
/// **Memory.** A call allocates nothing if the triangulator and the mesh have served a set of at least as many points
/// before, of up to 2^21 points. A triangulator takes up to 150 bytes for each point of its largest set, and half a
/// megabyte, of which a small set touches only the beginning.
///
/// In the library `incircle` this type is `incircle::Triangulator`, and its error is `incircle::TriangulatorError`.
///
/// ```
/// use incircle_geometry::cpu::Triangulator;
/// use incircle_geometry::{Mesh, Point};
///
/// let mut triangulator = Triangulator::new();
/// let mut mesh = Mesh::default();
/// for step in 1..=3 {
///     let points = [(0, 0), (4 * step, 0), (4 * step, 4), (0, 4)].map(Point::from);
///     triangulator.triangulate_into(&points, &mut mesh)?;
///     assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
///     assert_eq!(mesh.points, points);
/// }
/// # Ok::<(), incircle_geometry::cpu::Error>(())
/// ```
#[derive(Debug, Default)]
pub struct Triangulator {
    sites: SmallSites,
    /// The half-edges of a small set, or of one subtree of a larger set.
    short: Option<ShortHalves>,
    large: Large,
    waiting: Waiting,
    collect: SmallCollect,
}

/// The half-edges of a set that is cut into subtrees.
#[derive(Debug, Default)]
struct Large {
    halves: Vec<Half>,
    subtrees: Vec<Range<usize>>,
    parts: Vec<Option<Own>>,
}

impl Triangulator {
    /// Makes a triangulator. The first call allocates the memory for its set.
    pub fn new() -> Self {
        Self::default()
    }

    /// Computes the canonical Delaunay triangulation of a set of points, and puts it in place of the given mesh.
    ///
    /// The mesh becomes the one that [`triangulate`](super::triangulate) returns for these points, in the memory of its
    /// four lists. Coordinates may have all 32 bits. Cost: O(n log n) at worst and O(n) on even sets.
    ///
    /// # Errors
    /// Only [`Error::TooManyPoints`], for more than [`MAX_POINTS`](crate::MAX_POINTS) points. The mesh then stays as it
    /// was.
    pub fn triangulate_into(&mut self, points: &[Point], mesh: &mut Mesh) -> Result<(), Error> {
        check(points.len())?;
        let Mesh { points: own, triangles, hull, duplicates } = mesh;
        own.clear();
        own.extend_from_slice(points);
        hull.clear();
        duplicates.clear();
        if points.len() > collect::MOST {
            let watch = &mut |_| ControlFlow::Continue(());
            let found = connect(&Numbers::Grid(points.into()), NonZeroUsize::MIN, watch)?;
            (mesh.triangles, mesh.hull, mesh.duplicates) = (found.triangles, found.hull, found.duplicates);
            return Ok(());
        }
        // Later sets of as many points may have more triangles, duplicates or points on the hull.
        duplicates.reserve(points.len());
        hull.reserve(points.len());
        triangles.reserve((2 * points.len()).saturating_sub(triangles.len()));
        let bits = self.sites.sort(points, duplicates);
        if bits <= NARROW_BITS {
            self.connect::<Narrow>(mesh);
        } else if bits <= WIDE_BITS {
            self.connect::<Wide>(mesh);
        } else {
            self.connect::<Widest>(mesh);
        }
        Ok(())
    }

    /// Finds the triangles and the hull of the sorted sites.
    fn connect<W: Width>(&mut self, mesh: &mut Mesh) {
        let Self { sites: SmallSites { sites, ids, .. }, short, large, waiting, collect } = self;
        if is_collinear::<Integers<W>>(sites) {
            mesh.triangles.clear();
            mesh.hull.extend_from_slice(ids);
            mesh.hull.sort_unstable_by_key(|&id| mesh.points[id as usize]);
            return;
        }
        let short = short.get_or_insert_with(ShortHalves::new);
        if sites.len() <= short::MOST {
            let whole = short.conquer::<Integers<W>>(sites, sites, waiting, &mut |_| true);
            let whole = whole.map_or(0, |(part, _)| part.leftmost());
            assemble(short.halves(), whole, ids, collect, mesh);
        } else {
            let whole = large.conquer::<W>(sites, mesh.points.len(), short, waiting);
            assemble(large.halves.as_mut_slice(), whole, ids, collect, mesh);
        }
    }
}

impl Large {
    /// Triangulates sites, which stand along the curve, subtree by subtree, in a list with room for `points` sites.
    /// Returns the half-edge that leaves the leftmost vertex along the hull.
    fn conquer<W: Width>(
        &mut self,
        sites: &[Site],
        points: usize,
        short: &mut ShortHalves,
        waiting: &mut Waiting,
    ) -> u32 {
        let Self { halves, subtrees, parts } = self;
        halves.resize(halves.len().max(HALVES * points), Half::zeroed());
        // At each of 64 levels of cuts there are at most so many subtrees to be cut further.
        let most = u64::BITS as usize * (points / short::MOST) + 1;
        subtrees.clear();
        subtrees.reserve(most);
        parts.clear();
        parts.reserve(most);
        divide::<Integers<W>>(sites, 0..sites.len(), short::MOST, subtrees);
        parts.extend(subtrees.iter().map(|subtree| {
            let range = &mut halves[HALVES * subtree.start..HALVES * subtree.end];
            short.conquer_range::<Integers<W>>(subtree.clone(), (sites, sites), range, waiting, &mut |_| true)
        }));
        let mut edges = Edges::<Integers<W>, _> { sites, halves: halves.as_mut_slice(), unused: 0 };
        join(&mut edges, sites, subtrees, parts, waiting).map_or(0, |whole| whole.leftmost())
    }
}

/// Puts the triangles and the hull of a triangulation into a mesh, given the half-edge that leaves the leftmost
/// vertex along the hull.
fn assemble<H: Halves + ?Sized>(
    halves: &mut H,
    leftmost: u32,
    ids: &[u32],
    collect: &mut SmallCollect,
    mesh: &mut Mesh,
) {
    hull(halves, ids, leftmost, &mut mesh.hull);
    let count = 2 * ids.len() - 2 - mesh.hull.len();
    collect.triangles(halves, ids, mesh.points.len(), count, &mut mesh.triangles);
}
