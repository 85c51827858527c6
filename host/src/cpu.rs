//! Jobs for the engine in this process: the checks and reports of every device around it.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use incircle_geometry::cpu::{self, threads_for};
use incircle_geometry::{Point, MAX_COORD_BITS, MAX_POINTS};
use incircle_protocol::{Identity, MAGIC, PROTOCOL_VERSION};

use crate::error::Error;
use crate::link::Limit;
use crate::options::{Options, Stage};
use crate::report::Report;
use crate::session::{tell, Stopwatch};
use crate::solution::Solution;

/// Name in reports.
pub(crate) const CPU_NAME: &str = "cpu";
/// The order in reports: the engine has its own.
const ORDER: &str = "z-curve";
/// What a watch that goes over time is told to be doing.
const DURING: &str = "the triangulation";

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
    pub(crate) points: Vec<Point>,
    /// Threads that may work.
    pub(crate) contexts: u32,
    pub(crate) options: &'j Options<'j>,
    pub(crate) limit: Limit,
    pub(crate) watch: Stopwatch,
}

impl CpuJob<'_> {
    pub(crate) fn run(self) -> Result<Solution, Error> {
        let Self { points, contexts, options, limit, mut watch } = self;
        let allowed = NonZeroUsize::new(contexts as usize).unwrap_or(NonZeroUsize::MIN);
        let threads = threads_for(points.len(), allowed);
        let (mut at, mut failure) = (Stage::Order, None);
        let found = cpu::triangulate(points, threads, &mut |progress| {
            let stage = stage_of(progress.stage);
            if stage != at {
                watch.ended(at);
                at = stage;
            }
            let heard = tell(options, stage, progress.done, progress.total);
            match heard.and_then(|()| limit.check(CPU_NAME, DURING)) {
                Ok(()) => ControlFlow::Continue(()),
                Err(error) => {
                    failure = Some(error);
                    ControlFlow::Break(())
                }
            }
        });
        let mesh = found.map_err(|error| failure.unwrap_or_else(|| error_of(error)))?;
        watch.ended(at);
        let report = Report {
            points: mesh.points.len(),
            distinct: mesh.points.len() - mesh.duplicates.len(),
            duplicates: mesh.duplicates.len(),
            triangles: mesh.triangles.len(),
            hull: mesh.hull.len(),
            collinear: mesh.is_collinear(),
            backend: CPU_NAME.to_owned(),
            order: ORDER,
            stages: watch.stages,
            coord_bits: MAX_COORD_BITS,
            capacity: MAX_POINTS as u32,
            contexts: threads.get() as u32,
            ..Report::default()
        };
        Ok(Solution { mesh, report })
    }
}

/// The engine's stages as those of a job.
fn stage_of(stage: cpu::Stage) -> Stage {
    match stage {
        cpu::Stage::Order => Stage::Order,
        cpu::Stage::Assemble => Stage::Assemble,
        _ => Stage::Insert,
    }
}

/// The engine's errors as those of a job.
fn error_of(error: cpu::Error) -> Error {
    match error {
        cpu::Error::CoordinateOutOfRange { index, point: Point { x, y } } => {
            Error::CoordinateOutOfRange { index, x, y, coord_bits: MAX_COORD_BITS }
        }
        cpu::Error::TooManyPoints { points } => Error::TooManyPoints { points, max: MAX_POINTS },
        cpu::Error::Cancelled(cpu::Progress { stage, done, total, .. }) => {
            Error::Cancelled { stage: stage_of(stage).name(), done, total }
        }
        // None that the engine has today.
        _ => Error::Cancelled { stage: Stage::Order.name(), done: 0, total: 0 },
    }
}
