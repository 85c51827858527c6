//! Sets that are larger than the device: cut into parts, which the device does as a batch, and joined on the host.

use std::cell::Cell;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use incircle_geometry::cpu::{threads_for, Connectivity, Parts, Unsound};
use incircle_geometry::Point;

use super::backend::Terms;
use super::cpu_backend::error_of;
use super::session::Session;
use crate::error::{DeviceFault, Error};
use crate::job::batch::part_size;
use crate::job::watch::{tell, Stopwatch};
use crate::job::{Answer, Options, Progress, Report, Solution, Stage};

/// Noun for the work under way, in errors.
pub(super) const DURING: &str = "the triangulation in parts";

impl Session<'_> {
    /// Triangulates grid points, in parts if they are more than the device holds.
    pub(super) fn triangulate_grid(&mut self, points: Vec<Point>, terms: Terms<'_>) -> Result<Solution, Error> {
        if self.holds(&points) {
            return self.backend.triangulate(points, terms);
        }
        let mut watch = Stopwatch::start();
        tell(terms.options, Stage::Order, 0, points.len())?;
        let most = part_size(&self.identity, terms.contexts, points.len());
        let parts = Parts::divide(&points, most, host_threads(points.len())).map_err(error_of)?;
        // Duplicates take no room on the device, so the set may fit after all.
        if parts.distinct() <= self.identity.capacity as usize {
            drop(parts);
            return self.backend.triangulate(points, terms);
        }
        watch.ended(Stage::Order);
        let report = Report {
            backend: self.backend.name(),
            order: terms.options.order.name(),
            coord_bits: self.identity.coord_bits,
            capacity: self.identity.capacity,
            contexts: terms.contexts,
            engines: self.identity.engines,
            ..Report::default()
        };
        let clocks = self.clocks();
        let (connectivity, report) = match parts.collinear() {
            Some(line) => (line, report),
            None => {
                let report = Report { parts: parts.count(), ..report };
                self.solve_parts(parts, report, terms, &mut watch)?
            }
        };
        let Connectivity { triangles, hull, duplicates } = connectivity;
        let clocks = self.clocks().zip(clocks).and_then(|(now, before)| now.checked_sub(before));
        let clocks = clocks.filter(|_| report.parts > 0);
        let report = Report { clocks, stages: watch.stages, ..report };
        Ok(Answer { triangles, hull, duplicates, report }.with(points))
    }

    /// Whether the back end takes these points as one job, however many are duplicates.
    pub(super) fn holds(&self, points: &[Point]) -> bool {
        points.len() <= self.identity.capacity as usize || self.backend.takes_all_numbers()
    }

    /// Lets the device triangulate all parts, and joins their meshes.
    fn solve_parts(
        &mut self,
        parts: Parts,
        report: Report,
        terms: Terms<'_>,
        watch: &mut Stopwatch,
    ) -> Result<(Connectivity, Report), Error> {
        let distinct = parts.distinct();
        let grids = (0..parts.count()).map(|part| parts.points(part)).collect();
        let solutions = self.batch_of_parts(grids, terms, distinct)?;
        watch.ended(Stage::Insert);
        tell(terms.options, Stage::Assemble, 0, distinct)?;
        let mut stuck_engines: Vec<u32> =
            solutions.iter().flat_map(|solution| solution.report.stuck_engines.iter().copied()).collect();
        stuck_engines.sort_unstable();
        stuck_engines.dedup();
        let meshes = solutions.into_iter().map(|solution| (solution.mesh.triangles, solution.mesh.hull)).collect();
        let joined = parts.join_meshes(meshes, host_threads(distinct)).map_err(|Unsound| Error::Device {
            device: self.backend.name(),
            during: DURING,
            fault: DeviceFault::Unsound,
        })?;
        watch.ended(Stage::Assemble);
        Ok((joined, Report { stuck_engines, ..report }))
    }

    /// Triangulates parts of a set as a batch, within the time limit of the options.
    pub(super) fn solve_parts_together(
        &mut self,
        grids: Vec<Vec<Point>>,
        options: &Options<'_>,
    ) -> Result<Vec<Solution>, Error> {
        let total = grids.iter().map(Vec::len).sum();
        let terms = self.terms(total, options);
        self.check_job(0, terms.contexts)?;
        self.batch_of_parts(grids, terms, total)
    }

    /// Triangulates parts of a set as a batch. All must be done within the limit of `terms`.
    pub(super) fn batch_of_parts(
        &mut self,
        grids: Vec<Vec<Point>>,
        terms: Terms<'_>,
        total: usize,
    ) -> Result<Vec<Solution>, Error> {
        let device = self.backend.name();
        let check = || terms.limit.check(&device, DURING);
        let is_late = Cell::new(false);
        let listener = |progress: Progress| {
            is_late.set(check().is_err());
            match terms.options.progress {
                _ if is_late.get() => ControlFlow::Break(()),
                Some(listener) => listener(progress),
                None => ControlFlow::Continue(()),
            }
        };
        let options = Options { progress: Some(&listener), ..*terms.options };
        let terms = Terms { options: &options, shares_limit: true, ..terms };
        // The parts are no jobs of the caller, so the error names none.
        let solutions = self.triangulate_grids(grids, |part| part, terms, total).map_err(|error| match error {
            Error::InJob { source, .. } => *source,
            error => error,
        });
        if is_late.get() && matches!(solutions, Err(Error::Cancelled { .. })) {
            check()?;
        }
        solutions
    }
}

/// The threads of the host that work on a set of `points` points. The system is asked for its processors only if there
/// is work for several, because the answer may take longer than a small set: it is read from files.
pub(super) fn host_threads(points: usize) -> NonZeroUsize {
    if threads_for(points, NonZeroUsize::MAX) == NonZeroUsize::MIN {
        return NonZeroUsize::MIN;
    }
    std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}
