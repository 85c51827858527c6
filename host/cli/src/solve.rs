//! One job on an opened back end.

use incircle::constraints::Triangulated;
use incircle::{ConstrainedError, Options, PlanePoint, Report, Session, Solution};

use crate::arguments::JobArguments;
use crate::backend::Backend;
use crate::connections::Connections;
use crate::failure::{failure_of, Failure};
use crate::interrupt;
use crate::lattice::Numbers;
use crate::plan::Request;
use crate::progress::Meter;

/// Triangulates points on a back end. `check_bits` refuses points whose coordinates need more bits than the device has.
pub fn triangulate(
    backend: &mut Backend,
    numbers: &Numbers<'_>,
    check_bits: impl Fn(u32) -> Result<(), Failure>,
    job: &JobArguments,
    quiet: bool,
) -> Result<(Connections, Report), Failure> {
    let meter = Meter::new(quiet);
    let listener = |progress| meter.hear(progress);
    let options = job.options(&listener);
    let takes_all = backend.takes_all_numbers();
    let solution = interrupt::working(|| {
        let mut session = backend.device.session().map_err(|error| failure_of(&error))?;
        if !takes_all {
            check_bits(session.identity().coord_bits)?;
        }
        match numbers {
            Numbers::Grid(points) => connect(&mut session, points, &options),
            Numbers::Whole(points) => connect(&mut session, points, &options),
            Numbers::Doubles(points) => connect(&mut session, points, &options),
        }
    });
    // The check comes first, because an interrupt may surface as any error.
    interrupt::check()?;
    solution
}

/// Triangulates the first `points` places on the CPU triangulator, with what is asked of their mesh. `refuse` makes a
/// failure of an error.
pub fn constrain(
    backend: &mut Backend,
    (request, numbers, points): (&Request, &Numbers<'_>, usize),
    refuse: impl Fn(ConstrainedError) -> Failure,
    job: &JobArguments,
    quiet: bool,
) -> Result<(Triangulated, Report), Failure> {
    let meter = Meter::new(quiet);
    let listener = |progress| meter.hear(progress);
    let options = job.options(&listener);
    let found = interrupt::working(|| {
        let mut session = backend.device.session()?;
        match numbers {
            Numbers::Grid(places) => connect_with(&mut session, (request, &places[..], points), &options),
            Numbers::Whole(places) => connect_with(&mut session, (request, &places[..], points), &options),
            Numbers::Doubles(places) => connect_with(&mut session, (request, &places[..], points), &options),
        }
    });
    // The check comes first, because an interrupt may surface as any error.
    interrupt::check()?;
    found.map_err(refuse)
}

/// Triangulates the first `points` places, whose coordinates are numbers of one type, with what is asked of their mesh.
fn connect_with<P: PlanePoint>(
    session: &mut Session<'_>,
    (request, places, points): (&Request, &[P], usize),
    options: &Options<'_>,
) -> Result<(Triangulated, Report), ConstrainedError> {
    session.triangulate_constrained(&places[..points], &request.plan(places, points), options)
}

/// Triangulates points whose coordinates are numbers of one type.
fn connect<P: PlanePoint>(
    session: &mut Session<'_>,
    points: &[P],
    options: &Options<'_>,
) -> Result<(Connections, Report), Failure> {
    session.triangulate_with(points, options).map(without_points).map_err(|error| failure_of(&error))
}

/// A solution without its points.
pub fn without_points<P>(solution: Solution<P>) -> (Connections, Report) {
    (Connections::of_mesh(solution.mesh), solution.report)
}
