//! The work of one device of a fleet, on a thread of its own.

use std::ops::ControlFlow;
use std::sync::OnceLock;

use incircle_geometry::cpu::{Parts, SolvedPart, Unsound};
use incircle_geometry::{Order, Point};

use super::hall::{Greeted, Hall};
use crate::device::in_parts::DURING;
use crate::device::open::Device;
use crate::device::session::Session;
use crate::error::{DeviceFault, Error};
use crate::job::{Options, Progress, Solution};

/// The choices of the caller that concern each device.
#[derive(Clone, Copy)]
pub(super) struct Choices {
    order: Order,
    contexts: Option<u32>,
    insert_chunk: usize,
}

impl Choices {
    pub(super) fn of(&Options { order, contexts, insert_chunk, .. }: &Options<'_>) -> Self {
        Self { order, contexts, insert_chunk }
    }
}

/// Opens the device at this place of the fleet, and does parts until the hall is closed.
pub(super) fn work(
    place: usize,
    open: &dyn Fn() -> Result<Device, Error>,
    hall: &Hall,
    parts: &OnceLock<Parts>,
    choices: Choices,
) {
    let result = open().and_then(|mut device| work_on(&mut device.session()?, place, hall, parts, choices));
    if let Err(error) = result {
        hall.leave_out(place, error);
    }
}

/// Does parts until the hall is closed, or until the device fails.
fn work_on(
    session: &mut Session<'_>,
    place: usize,
    hall: &Hall,
    parts: &OnceLock<Parts>,
    Choices { order, contexts, insert_chunk }: Choices,
) -> Result<(), Error> {
    let (identity, name, slow) = (*session.identity(), session.name(), session.slow());
    hall.greet(place, Greeted { name, identity, slow });
    let listener = |_: Progress| if hall.is_closed() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    // More contexts than this device has are no error: another device of the fleet may have them.
    let contexts = contexts.map(|contexts| contexts.min(identity.contexts));
    let options = Options { order, contexts, insert_chunk, progress: Some(&listener), timeout: None };
    while let Some((taken, limit)) = hall.next(place) {
        let Some(parts) = parts.get() else { continue };
        let points = taken.iter().map(|&part| parts.points_of(part)).sum();
        // A device that falls silent must not use up the time that the others need to do its parts.
        let patience = Options::default_timeout(points).saturating_mul(slow).min(limit.time_left());
        let solved = solve(session, &taken, parts, &Options { timeout: Some(patience), ..options })?;
        hall.done(place, solved, points);
    }
    Ok(())
}

/// Triangulates parts as a batch, within the time limit of `options`.
fn solve(
    session: &mut Session<'_>,
    taken: &[usize],
    parts: &Parts,
    options: &Options<'_>,
) -> Result<Vec<SolvedPart>, Error> {
    let grids: Vec<Vec<Point>> = taken.iter().map(|&part| parts.points(part)).collect();
    let solutions = session.solve_parts_together(grids, options)?;
    let solve =
        |(&part, solution): (&usize, Solution)| parts.solved(part, solution.mesh.triangles, &solution.mesh.hull);
    let solved: Result<Vec<SolvedPart>, Unsound> = taken.iter().zip(solutions).map(solve).collect();
    solved.map_err(|Unsound| Error::Device { device: session.name(), during: DURING, fault: DeviceFault::Unsound })
}
