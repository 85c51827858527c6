//! A job for the engine: the checks and reports of every device around it.

use incircle_protocol::{Identity, MAGIC, MAX_COORD_BITS, PROTOCOL_VERSION};

use crate::error::Error;
use crate::link::Limit;
use crate::mesh::{Duplicate, Mesh};
use crate::options::{Options, Stage};
use crate::pages;
use crate::point::Point;
use crate::report::Report;
use crate::session::{tell, Stopwatch, MAX_POINTS};

use super::edges::{Half, HALVES};
use super::sites::{sort, Sites};
use super::view::{turn, Narrow, Site, Wide, NARROW_BITS};
use super::{collect, conquer};

/// Name in reports.
pub(crate) const CPU_NAME: &str = "cpu";
/// The order in reports: the engine has its own.
const ORDER: &str = "z-curve";
/// Points that are worth a thread.
const THREAD_POINTS: usize = 16_384;

/// What the engine says of itself: its threads are its contexts.
pub(crate) fn identity(threads: u32) -> Identity {
    let number = |text: &str| text.parse::<u32>().unwrap_or_default();
    let (major, minor) = (number(env!("CARGO_PKG_VERSION_MAJOR")), number(env!("CARGO_PKG_VERSION_MINOR")));
    Identity {
        magic: MAGIC,
        protocol_version: PROTOCOL_VERSION,
        core_version: major << 16 | minor << 8 | number(env!("CARGO_PKG_VERSION_PATCH")),
        coord_bits: MAX_COORD_BITS,
        capacity: MAX_POINTS as u32,
        contexts: threads,
        ring_capacity: 0,
    }
}

/// One triangulation under way; the points have been checked.
pub(crate) struct CpuJob<'j> {
    pub(crate) points: &'j [Point],
    pub(crate) contexts: u32,
    pub(crate) options: &'j Options<'j>,
    pub(crate) limit: Limit,
    pub(crate) watch: Stopwatch,
}

impl CpuJob<'_> {
    /// Everything but the points of the mesh.
    pub(crate) fn run(mut self) -> Result<Mesh, Error> {
        let threads = (self.contexts as usize).min(self.points.len() / THREAD_POINTS + 1);
        self.tell(Stage::Order, 0, self.points.len())?;
        let Sites { sites, ids, mut duplicates, bits } = sort(self.points, threads);
        duplicates.sort_unstable();
        self.watch.ended(Stage::Order);
        let mut report = self.begin_report(ids.len(), &duplicates, threads as u32);
        let (triangles, hull) = if is_collinear(&sites) {
            report.collinear = true;
            let mut hull = ids;
            hull.sort_unstable_by_key(|&id| self.points[id as usize]);
            (Vec::new(), hull)
        } else {
            self.triangulate(sites, &ids, bits, threads)?
        };
        report.triangles = triangles.len();
        report.hull = hull.len();
        report.stages = self.watch.stages;
        Ok(Mesh { points: Vec::new(), triangles, hull, duplicates, report })
    }

    /// The triangles and the hull of sites that are not all on one line.
    fn triangulate(
        &mut self,
        sites: Vec<Site>,
        ids: &[u32],
        bits: u32,
        threads: usize,
    ) -> Result<(Vec<[u32; 3]>, Vec<u32>), Error> {
        let mut halves = pages::zeros::<Half>(HALVES * sites.len());
        self.tell(Stage::Insert, 0, sites.len())?;
        let (mut done, mut failure) = (0, None);
        let mut go_on = |more| {
            done += more;
            failure = self.tell(Stage::Insert, done.min(sites.len()), sites.len()).err();
            failure.is_none()
        };
        let whole = if bits <= NARROW_BITS {
            conquer::triangulate::<Narrow>(&sites, &mut halves, threads, &mut go_on)
        } else {
            conquer::triangulate::<Wide>(&sites, &mut halves, threads, &mut go_on)
        };
        if let Some(failure) = failure {
            return Err(failure);
        }
        self.tell(Stage::Insert, sites.len(), sites.len())?;
        self.watch.ended(Stage::Insert);
        drop(sites);
        self.tell(Stage::Assemble, 0, self.points.len())?;
        let Some(whole) = whole else {
            return Ok((Vec::new(), Vec::new()));
        };
        let hull = collect::hull(&mut halves, ids, whole.leftmost());
        let count = 2 * ids.len() - 2 - hull.len();
        let triangles = collect::triangles(halves, ids, self.points.len(), count, threads);
        self.watch.ended(Stage::Assemble);
        Ok((triangles, hull))
    }

    fn begin_report(&self, distinct: usize, duplicates: &[Duplicate], threads: u32) -> Report {
        Report {
            points: self.points.len(),
            distinct,
            duplicates: duplicates.len(),
            backend: CPU_NAME.to_owned(),
            order: ORDER,
            coord_bits: MAX_COORD_BITS,
            capacity: MAX_POINTS as u32,
            contexts: threads,
            ..Report::default()
        }
    }

    /// Tells the listener, which may cancel, and looks at the deadline.
    fn tell(&self, stage: Stage, done: usize, total: usize) -> Result<(), Error> {
        tell(self.options, stage, done, total)?;
        self.limit.check(CPU_NAME, "the triangulation")
    }
}

/// There are fewer than three sites, or all lie on one line.
fn is_collinear(sites: &[Site]) -> bool {
    let [a, b, rest @ ..] = sites else {
        return true;
    };
    rest.iter().all(|&c| turn(*a, *b, c) == 0)
}
