//! The back end `cpu`: the CPU triangulator behind a session.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};
use std::thread::Builder;

use incircle_geometry::constraints::{self, Plan, TriangulateError, Triangulated};
use incircle_geometry::cpu::{self, threads_for, Connectivity};
use incircle_geometry::lattice::Numbers;
use incircle_geometry::{PlanePoint, Point, MAX_POINTS};
use incircle_protocol::{Identity, MAGIC, PROTOCOL_VERSION};

use super::backend::{Backend, JobLeft, Terms, Together};
use crate::error::{ConstrainedError, Error};
use crate::job::batch::{JOBS_PER_LOOK, MAX_JOB_POINTS};
use crate::job::watch::{tell, Stopwatch};
use crate::job::{Answer, Options, Report, Solution, Stage};
use crate::limit::Limit;

/// Name of the back end in reports and errors.
pub(crate) const CPU_NAME: &str = "cpu";
/// Name of the order in reports. The CPU triangulator has an order of its own, whatever the options say.
const ORDER: &str = "z-curve";
/// Noun for the work under way, in the error of a passed deadline.
const DURING: &str = "the triangulation";

/// The CPU triangulator, with an upper bound on its threads.
pub(crate) struct CpuBackend {
    pub(crate) threads: u32,
}

impl Backend for CpuBackend {
    fn name(&self) -> String {
        CPU_NAME.to_owned()
    }

    fn greet(&mut self, _limit: Limit) -> Result<Identity, Error> {
        Ok(identity(self.threads))
    }

    fn triangulate(&mut self, points: Vec<Point>, terms: Terms<'_>) -> Result<Solution, Error> {
        let Terms { contexts, limit, options, .. } = terms;
        solve(points, contexts, options, limit)
    }

    fn takes_all_numbers(&self) -> bool {
        true
    }

    fn is_cpu(&self) -> bool {
        true
    }

    fn triangulate_numbers(&mut self, numbers: &Numbers<'_>, terms: Terms<'_>) -> Result<Answer, Error> {
        let Terms { contexts, limit, options, .. } = terms;
        connect(numbers, contexts, options, limit)
    }

    /// Does small jobs side by side, each in one thread. Large jobs are left over: all threads do one together.
    fn triangulate_together(&mut self, jobs: Vec<Vec<Point>>, terms: Terms<'_>) -> Result<Together, Error> {
        let total = jobs.iter().map(Vec::len).sum();
        let mut together = Together { solutions: jobs.iter().map(|_| None).collect(), left: Vec::new() };
        let (small, large): (Vec<_>, Vec<_>) =
            jobs.into_iter().enumerate().partition(|(_, points)| points.len() <= MAX_JOB_POINTS);
        let left = |(job, points)| JobLeft { job, points, contexts: terms.contexts };
        together.left = large.into_iter().map(left).collect();
        let (mut small, mut passed) = (small.into_iter().peekable(), 0);
        while small.peek().is_some() {
            tell(terms.options, Stage::Insert, passed, total)?;
            let look: Vec<_> = small.by_ref().take(JOBS_PER_LOOK * terms.contexts as usize).collect();
            for (job, solution) in side_by_side(look, terms) {
                let solution = solution?;
                passed += solution.mesh.points.len();
                together.solutions[job] = Some(solution);
            }
        }
        Ok(together)
    }
}

/// Items, each with the index of its job in the list of the caller.
type Numbered<T> = Vec<(usize, T)>;

/// Does these jobs, each in one of the threads.
fn side_by_side(jobs: Numbered<Vec<Point>>, terms: Terms<'_>) -> Numbered<Result<Solution, Error>> {
    let Terms { contexts: threads, limit, options: Options { order, .. }, .. } = terms;
    let jobs = Mutex::new(jobs.into_iter());
    let next = || jobs.lock().unwrap_or_else(PoisonError::into_inner).next();
    let solve = |points| solve(points, 1, &Options::default().order(*order), limit);
    let work = || std::iter::from_fn(next).map(|(job, points)| (job, solve(points))).collect::<Vec<_>>();
    std::thread::scope(|scope| {
        // If the system will not start a thread, the threads that did start share its work.
        let others: Vec<_> = (1..threads).map_while(|_| Builder::new().spawn_scoped(scope, work).ok()).collect();
        let mut solutions = work();
        for other in others {
            match other.join() {
                Ok(own) => solutions.extend(own),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        solutions
    })
}

/// Does one job of grid points with at most `threads` threads.
fn solve(points: Vec<Point>, threads: u32, options: &Options<'_>, limit: Limit) -> Result<Solution, Error> {
    let answer = connect(&Numbers::Grid(points.as_slice().into()), threads, options, limit)?;
    Ok(answer.with(points))
}

/// Triangulates points in their numbers with at most `threads` threads.
fn connect(numbers: &Numbers<'_>, threads: u32, options: &Options<'_>, limit: Limit) -> Result<Answer, Error> {
    let threads = threads_of(numbers.len(), threads);
    let mut listener = Listener::new(options, limit);
    let found = cpu::connect(numbers, threads, &mut |progress| listener.hear(progress));
    match found {
        Ok(Connectivity { triangles, hull, duplicates }) => {
            Ok(Answer { triangles, hull, duplicates, report: listener.into_report(threads) })
        }
        Err(error) => Err(listener.into_error(error)),
    }
}

/// Triangulates points with constraints, which are forced in before the triangles are sorted.
pub(super) fn constrain<P: PlanePoint>(
    points: &[P],
    plan: &Plan<'_, P>,
    terms: Terms<'_>,
) -> Result<(Triangulated, Report), ConstrainedError> {
    let threads = threads_of(points.len(), terms.contexts);
    let mut listener = Listener::new(terms.options, terms.limit);
    let found = constraints::triangulate(points, plan, threads, &mut |progress| listener.hear(progress));
    let found = match found {
        Ok(found) => found,
        Err(TriangulateError::Plan(error)) => return Err(error.into()),
        Err(TriangulateError::Points(error)) => return Err(listener.into_error(error).into()),
        Err(_) => return Err(cancelled().into()),
    };
    let (distinct, hull) = (points.len() - found.duplicates.len(), found.hull.len());
    // An empty domain is an error, so without triangles there are none in the hull.
    let collinear = found.made.triangles.is_empty();
    let report = Report {
        points: points.len(),
        distinct,
        duplicates: found.duplicates.len(),
        // By Euler's formula.
        triangles: if collinear { 0 } else { 2 * distinct - 2 - hull },
        hull,
        collinear,
        ..listener.into_report(threads)
    };
    Ok((found, report))
}

/// The threads for a job of `points` points, of which at most `allowed` may work.
fn threads_of(points: usize, allowed: u32) -> NonZeroUsize {
    threads_for(points, NonZeroUsize::new(allowed as usize).unwrap_or(NonZeroUsize::MIN))
}

/// Hears of the progress of the CPU triangulator: times the stages, tells the listener of the job, and keeps the limit.
struct Listener<'a> {
    options: &'a Options<'a>,
    limit: Limit,
    watch: Stopwatch,
    at: Stage,
    failure: Option<Error>,
}

impl<'a> Listener<'a> {
    fn new(options: &'a Options<'a>, limit: Limit) -> Self {
        Self { options, limit, watch: Stopwatch::start(), at: Stage::Order, failure: None }
    }

    fn hear(&mut self, progress: cpu::Progress) -> ControlFlow<()> {
        let stage = stage_of(progress.stage);
        if stage == Stage::Order && self.at != stage {
            // The work begins anew, to find out what is wrong with constraints. That is a job with a time of its own.
            (self.watch, self.limit) = (Stopwatch::start(), Limit::of(self.limit.timeout()));
        } else if stage != self.at {
            self.watch.ended(self.at);
        }
        self.at = stage;
        let heard = tell(self.options, stage, progress.done, progress.total);
        match heard.and_then(|()| self.limit.check(CPU_NAME, DURING)) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.failure = Some(error);
                ControlFlow::Break(())
            }
        }
    }

    /// The error of the job.
    fn into_error(self, error: cpu::Error) -> Error {
        self.failure.unwrap_or_else(|| error_of(error))
    }

    /// The report of the job, which has ended. The counts of the mesh are missing.
    fn into_report(mut self, threads: NonZeroUsize) -> Report {
        self.watch.ended(self.at);
        Report {
            backend: CPU_NAME.to_owned(),
            order: ORDER,
            stages: self.watch.stages,
            coord_bits: u32::BITS,
            capacity: MAX_POINTS as u32,
            contexts: threads.get() as u32,
            ..Report::default()
        }
    }
}

/// The identity of the CPU triangulator: its threads stand in the place of contexts.
pub(crate) fn identity(threads: u32) -> Identity {
    let number = |text: &str| text.parse::<u32>().unwrap_or_default();
    let (major, minor) = (number(env!("CARGO_PKG_VERSION_MAJOR")), number(env!("CARGO_PKG_VERSION_MINOR")));
    Identity {
        magic: MAGIC,
        protocol_version: PROTOCOL_VERSION,
        core_version: major << 16 | minor << 8 | number(env!("CARGO_PKG_VERSION_PATCH")),
        coord_bits: u32::BITS,
        capacity: MAX_POINTS as u32,
        contexts: threads,
        engines: 1,
        ring_capacity: 0,
        features: 0,
    }
}

/// The stage of a job for a stage of the CPU triangulator.
fn stage_of(stage: cpu::Stage) -> Stage {
    match stage {
        cpu::Stage::Order => Stage::Order,
        cpu::Stage::Assemble => Stage::Assemble,
        _ => Stage::Insert,
    }
}

/// The error of a job for an error of the CPU triangulator.
pub(super) fn error_of(error: cpu::Error) -> Error {
    match error {
        cpu::Error::TooManyPoints { points } => Error::TooManyPoints { points, max: MAX_POINTS },
        cpu::Error::Cancelled(cpu::Progress { stage, done, total, .. }) => {
            Error::Cancelled { stage: stage_of(stage).name(), done, total }
        }
        // No other error arises here: the session has refused values that are not finite, and the CPU triangulator
        // takes all 32 bits of a grid point. A variant added to the enum later is reported as a cancelled job.
        _ => cancelled(),
    }
}

/// A job that was cancelled before it began.
fn cancelled() -> Error {
    Error::Cancelled { stage: Stage::Order.name(), done: 0, total: 0 }
}
