//! The CPU triangulator as a whole: from points to the mesh.

use alloc::vec::Vec;
use core::num::NonZeroUsize;
use core::ops::ControlFlow;

#[cfg(not(feature = "std"))]
use super::conquer::{conquer, Waiting};
#[cfg(not(feature = "std"))]
use super::edges::Edges;
use super::edges::{Half, HALVES};
use super::filtered::Filtered;
use super::filtered_sites::{self, FilteredSites};
use super::kernel::Kernel;
#[cfg(feature = "std")]
use super::segments;
use super::sites::{sort, Sites};
use super::view::{Integers, Narrow, Wide, Widest, Width, NARROW_BITS, WIDE_BITS};
use super::{collect, conquer::GoOn, merge::Part};
use crate::double::Coordinate;
use crate::lattice::Numbers;
use crate::mesh::Mesh;
use crate::pages;
use crate::plane_point::PlanePoint;
use crate::point::{Duplicate, Point, MAX_POINTS};

/// Points that justify one more thread.
const THREAD_POINTS: usize = 16_384;

/// A stage of the CPU triangulator's work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Stage {
    /// Sorts the points along the curve and takes duplicates out.
    Order,
    /// Triangulates parts of the plane and joins them.
    Insert,
    /// Puts triangles and hull into canonical form.
    Assemble,
}

/// The progress of the CPU triangulator: its stage, and the points done in this stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Progress {
    /// The stage that the work has reached.
    pub stage: Stage,
    /// Points done in this stage, 0 when the stage begins.
    ///
    /// [`Stage::Insert`] counts distinct points and is reported at its beginning, from time to time, and at its end.
    /// The other stages are reported when they begin; with constraints, [`Stage::Assemble`] is reported in the same way
    /// again from time to time while they are forced.
    pub done: usize,
    /// Points to do in this stage.
    pub total: usize,
}

/// A function that is called with the progress of the work. If it returns [`ControlFlow::Break`], the
/// work ends with [`Error::Cancelled`].
pub type Watch<'w> = &'w mut dyn FnMut(Progress) -> ControlFlow<()>;

/// The reasons why [`triangulate`] returns no mesh. The only error of a [`Triangulator`](super::Triangulator) is
/// [`Error::TooManyPoints`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The watch ended the work at this point.
    #[error("the triangulation was cancelled after {} of {} points in the stage {:?}", .0.done, .0.total, .0.stage)]
    Cancelled(Progress),
    /// A coordinate has more than 31 bits, which is too wide for the software model. [`triangulate`] itself takes all
    /// 32 and never returns this error.
    #[error("point {index} is {point}, but coordinates end at 2147483647")]
    CoordinateOutOfRange {
        /// Input index of the point.
        index: usize,
        /// The point with this coordinate.
        point: Point,
    },
    /// A coordinate is infinite or not a number.
    #[error("point {index} has a coordinate that is infinite or not a number: leave it out, or give it a place")]
    NotFinite {
        /// Input index of the point.
        index: usize,
    },
    /// There are more points than [`MAX_POINTS`].
    #[error("{points} points are more than the {MAX_POINTS} that indices allow: cut the set into parts")]
    TooManyPoints {
        /// Number of points given.
        points: usize,
    },
}

/// The number of threads that [`triangulate`] uses for a set of `points` points: one, and one more for every full
/// 16,384 points, but at most `allowed`. Without the feature `std` the number is 1.
pub fn threads_for(points: usize, allowed: NonZeroUsize) -> NonZeroUsize {
    let most = if cfg!(feature = "std") { points / THREAD_POINTS + 1 } else { 1 };
    allowed.min(NonZeroUsize::MIN.saturating_add(most - 1))
}

/// Computes the canonical Delaunay triangulation of a set of points, on at most `threads` threads; see [`threads_for`].
///
/// Points may be of any type that is a [`PlanePoint`]. Duplicates collapse onto their lowest index and are listed in
/// the mesh. Fewer than three distinct points, or points on one line, give a mesh without triangles. The function calls
/// `watch` with its progress, on the caller's thread, and ends early if `watch` asks for it.
///
/// Cost: O(n w) at worst for coordinates of `w` bits, because the tree of cuts has at most `2 w` levels, and O(n) on
/// even sets, 0.2 to 0.3 µs a point on one thread. The peak of memory is below 200 bytes a point at a million points of
/// 16 bits, with the mesh but without the caller's points. The result does not depend on the number of threads. Source:
/// Guibas and Stolfi 1985, with exact integers and the tie rule (see [the module](crate::cpu)).
///
/// ```
/// use core::num::NonZeroUsize;
/// use core::ops::ControlFlow;
/// use incircle_geometry::{cpu, Point};
///
/// let line: Vec<Point> = (0..5).map(|k| Point::new(2 * k, k)).collect();
/// let mesh = cpu::triangulate(line, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))?;
/// assert!(mesh.is_collinear());
/// assert_eq!(mesh.hull, [0, 1, 2, 3, 4]);
/// # Ok::<(), cpu::Error>(())
/// ```
///
/// # Errors
/// There are more than [`MAX_POINTS`] points, a coordinate is infinite or not a number, or the watch ends the work.
pub fn triangulate<P: PlanePoint>(points: Vec<P>, threads: NonZeroUsize, watch: Watch<'_>) -> Result<Mesh<P>, Error> {
    let (numbers, _) = P::numbers(&points).on_lattice();
    let Connectivity { triangles, hull, duplicates } = connect(&numbers, threads, watch)?;
    Ok(Mesh { points, triangles, hull, duplicates })
}

/// The triangles, hull and duplicates of points in the numbers in which they are given; see [`triangulate`]. Whole
/// numbers and doubles are not looked at for a lattice, which [`Numbers::on_lattice`] finds, and take longer
/// here than on one.
///
/// # Errors
/// As those of [`triangulate`].
pub fn connect(numbers: &Numbers<'_>, threads: NonZeroUsize, watch: Watch<'_>) -> Result<Connectivity, Error> {
    match numbers {
        Numbers::Grid(points) => connect_grid(points, threads, watch),
        Numbers::Whole(points) => connect_filtered(points, threads, watch),
        Numbers::Doubles(points) => {
            let is_finite = |point: &[f64; 2]| point.iter().all(|value| value.is_finite());
            match points.iter().position(|point| !is_finite(point)) {
                Some(index) => Err(Error::NotFinite { index }),
                None => connect_filtered(points, threads, watch),
            }
        }
    }
}

fn connect_grid(points: &[Point], threads: NonZeroUsize, watch: Watch<'_>) -> Result<Connectivity, Error> {
    check(points.len())?;
    let threads = threads_for(points.len(), threads).get();
    tell(watch, Stage::Order, 0, points.len())?;
    let sites = sort(points, threads);
    if sites.bits <= NARROW_BITS {
        connect_sites::<Narrow>(points, sites, threads, watch)
    } else if sites.bits <= WIDE_BITS {
        connect_sites::<Wide>(points, sites, threads, watch)
    } else {
        connect_sites::<Widest>(points, sites, threads, watch)
    }
}

fn connect_sites<W: Width>(
    points: &[Point],
    Sites { sites, ids, mut duplicates, .. }: Sites,
    threads: usize,
    watch: Watch<'_>,
) -> Result<Connectivity, Error> {
    duplicates.sort_unstable();
    if is_collinear::<Integers<W>>(&sites) {
        return Ok(Connectivity::of_line(&sites, &ids, duplicates));
    }
    let halves = insert::<Integers<W>>(&sites, &sites, threads, watch)?;
    drop(sites);
    let (triangles, hull) = assemble(halves, &ids, points.len(), threads, watch)?;
    Ok(Connectivity { triangles, hull, duplicates })
}

fn connect_filtered<C: Coordinate>(
    points: &[[C; 2]],
    threads: NonZeroUsize,
    watch: Watch<'_>,
) -> Result<Connectivity, Error> {
    check(points.len())?;
    let threads = threads_for(points.len(), threads).get();
    tell(watch, Stage::Order, 0, points.len())?;
    let FilteredSites { sites, places, ids, mut duplicates } = filtered_sites::sort(points, threads);
    duplicates.sort_unstable();
    if is_collinear::<Filtered<C>>(&sites) {
        return Ok(Connectivity::of_line(&sites, &ids, duplicates));
    }
    let halves = insert::<Filtered<C>>(&sites, &places, threads, watch)?;
    drop((sites, places));
    let (triangles, hull) = assemble(halves, &ids, points.len(), threads, watch)?;
    Ok(Connectivity { triangles, hull, duplicates })
}

pub(super) fn check(points: usize) -> Result<(), Error> {
    if points > MAX_POINTS {
        return Err(Error::TooManyPoints { points });
    }
    Ok(())
}

/// Reports progress to the watch, which may end the work.
pub(crate) fn tell(watch: Watch<'_>, stage: Stage, done: usize, total: usize) -> Result<(), Error> {
    let progress = Progress { stage, done, total };
    match watch(progress) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::Cancelled(progress)),
    }
}

/// The triangles of a mesh, its hull, and the points that fell onto earlier ones; all by input index.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Connectivity {
    /// The triangles, as [`Mesh::triangles`].
    pub triangles: Vec<[u32; 3]>,
    /// The hull, as [`Mesh::hull`].
    pub hull: Vec<u32>,
    /// The duplicates, as [`Mesh::duplicates`].
    pub duplicates: Vec<Duplicate>,
}

impl Connectivity {
    /// The mesh of distinct sites on one line, given the input index of each. There are no triangles, and the hull has
    /// the sites along the line.
    pub(super) fn of_line<S: Ord + Copy>(sites: &[S], ids: &[u32], duplicates: Vec<Duplicate>) -> Self {
        let mut order: Vec<(S, u32)> = sites.iter().copied().zip(ids.iter().copied()).collect();
        order.sort_unstable();
        let hull = order.into_iter().map(|(_, id)| id).collect();
        Self { triangles: Vec::new(), hull, duplicates }
    }
}

/// The half-edges of the triangulation of sites that are not all on one line, and what leads into them. Returns `None`
/// in place of the latter if there are no sites.
pub(super) fn insert<K: Kernel>(
    sites: &[K::Site],
    places: &[K::Place],
    threads: usize,
    watch: Watch<'_>,
) -> Result<(Vec<Half>, Option<Part>), Error> {
    let mut halves = pages::zeros::<Half>(HALVES * sites.len());
    let total = sites.len();
    tell(watch, Stage::Insert, 0, total)?;
    let (mut done, mut ending) = (0, Ok(()));
    let whole = whole::<K>(sites, places, &mut halves, threads, &mut |more| {
        done += more;
        ending = tell(watch, Stage::Insert, done.min(total), total);
        ending.is_ok()
    });
    ending?;
    tell(watch, Stage::Insert, total, total)?;
    Ok((halves, whole))
}

/// The triangles and the hull of a triangulation, given the input index of each site and the number of input points.
fn assemble(
    (mut halves, whole): (Vec<Half>, Option<Part>),
    ids: &[u32],
    points: usize,
    threads: usize,
    watch: Watch<'_>,
) -> Result<(Vec<[u32; 3]>, Vec<u32>), Error> {
    tell(watch, Stage::Assemble, 0, points)?;
    let Some(whole) = whole else {
        return Ok((Vec::new(), Vec::new()));
    };
    let hull = collect::hull_of(&mut halves, ids, whole.leftmost());
    let count = 2 * ids.len() - 2 - hull.len();
    let triangles = collect::triangles(halves, ids, points, count, threads);
    Ok((triangles, hull))
}

/// Triangulates distinct sites, which stand along the curve, on up to `threads` threads. Returns `None` if there are no
/// sites, or if `go_on` ends the work.
#[cfg(feature = "std")]
fn whole<K: Kernel>(
    sites: &[K::Site],
    places: &[K::Place],
    halves: &mut [Half],
    threads: usize,
    go_on: GoOn<'_>,
) -> Option<Part> {
    segments::triangulate::<K>(sites, places, halves, threads, go_on)
}

/// Triangulates distinct sites, which stand along the curve, on this thread. Returns `None` if there are no sites, or
/// if `go_on` ends the work.
#[cfg(not(feature = "std"))]
fn whole<K: Kernel>(
    sites: &[K::Site],
    places: &[K::Place],
    halves: &mut [Half],
    _threads: usize,
    go_on: GoOn<'_>,
) -> Option<Part> {
    conquer(&mut Edges::<K, _> { sites, halves, unused: 0 }, places, &mut Waiting::new(), go_on)
}

/// Whether there are fewer than three sites, or all lie on one line.
pub(super) fn is_collinear<K: Kernel>(sites: &[K::Site]) -> bool {
    let [a, b, rest @ ..] = sites else {
        return true;
    };
    rest.iter().all(|&c| K::orient2d(*a, *b, c).is_eq())
}
