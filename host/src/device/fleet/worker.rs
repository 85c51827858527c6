//! The work of one device of a fleet, on a thread of its own.

use std::ops::ControlFlow;
use std::sync::OnceLock;

use incircle_geometry::cpu::{Parts, SolvedPart, Unsound};
use incircle_geometry::Point;

use super::hall::{Greeted, Hall};
use super::{time_left, Choices, DURING};
use crate::device::{Device, Session};
use crate::error::{DeviceFault, Error};
use crate::job::{Options, Progress};

/// Opens the device at this place of the fleet, and does parts until there are none.
pub(super) fn work(
    place: usize,
    open: &dyn Fn() -> Result<Device, Error>,
    hall: &Hall,
    parts: &OnceLock<Parts>,
    Choices { order, contexts, insert_chunk }: Choices,
) {
    let mut device = match open() {
        Ok(device) => device,
        Err(error) => return hall.leave_out(place, error, &[]),
    };
    let mut session = match device.session() {
        Ok(session) => session,
        Err(error) => return hall.leave_out(place, error, &[]),
    };
    let (identity, name) = (*session.identity(), session.name());
    hall.greet(place, Greeted { name, identity, slow: session.slow() });
    let listener = |_: Progress| if hall.is_closed() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    // More contexts than this device has are no error: another device of the fleet may have them.
    let contexts = contexts.map(|contexts| contexts.min(identity.contexts));
    let choices = Options { order, contexts, insert_chunk, progress: Some(&listener), timeout: None };
    while let Some((taken, limit)) = hall.next() {
        let options = Options { timeout: Some(time_left(limit)), ..choices };
        let solved = parts.get().map_or_else(|| Ok(Vec::new()), |parts| solve(&mut session, &taken, parts, &options));
        match solved {
            Ok(solved) => {
                let points = |&part: &usize| parts.get().map_or(0, |parts| parts.points_of(part));
                hall.done(place, solved, taken.iter().map(points).sum());
            }
            Err(error) => return hall.leave_out(place, error, &taken),
        }
    }
}

/// Triangulates parts as a batch.
fn solve(
    session: &mut Session<'_>,
    taken: &[usize],
    parts: &Parts,
    options: &Options<'_>,
) -> Result<Vec<SolvedPart>, Error> {
    let grids: Vec<Vec<Point>> = taken.iter().map(|&part| parts.points(part)).collect();
    let solutions = session.triangulate_batch(&grids, options).map_err(|error| match error {
        // The caller knows of no jobs.
        Error::InJob { source, .. } => *source,
        error => error,
    })?;
    let solve = |(&part, solution): (&usize, crate::job::Solution)| {
        parts.solved(part, solution.mesh.triangles, &solution.mesh.hull)
    };
    let solved: Result<Vec<SolvedPart>, Unsound> = taken.iter().zip(solutions).map(solve).collect();
    solved.map_err(|Unsound| Error::Device { device: session.name(), during: DURING, fault: DeviceFault::Unsound })
}
