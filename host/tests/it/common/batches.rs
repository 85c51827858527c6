//! Helpers for tests of batches.

use std::ops::ControlFlow;

use incircle::{Device, Error, ErrorKind, Mesh, Options, Point, Progress, Solution, Stage};

/// The mesh without its report.
pub fn bare(solution: Solution) -> Mesh {
    solution.mesh
}

/// The meshes of the jobs, each alone, by the CPU triangulator.
pub fn alone(jobs: &[Vec<Point>]) -> Vec<Mesh> {
    let mut device = Device::cpu(None);
    let mut session = device.session().expect("a device in this process");
    jobs.iter().map(|points| bare(session.triangulate(points).expect("a mesh"))).collect()
}

/// The meshes of a batch, without their reports.
pub fn batch(device: &mut Device, jobs: &[Vec<Point>], options: &Options<'_>) -> Result<Vec<Mesh>, Error> {
    device.session()?.triangulate_batch(jobs, options).map(|meshes| meshes.into_iter().map(bare).collect())
}

/// Cancels a batch as soon as the listener hears of `patience` points, and checks that the session stays in step and
/// then gives the right meshes.
pub fn check_cancelled(device: &mut Device, jobs: &[Vec<Point>], right: &[Mesh], patience: usize) {
    let listener = |progress: Progress| match progress {
        Progress { stage: Stage::Insert, done, .. } if done >= patience => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    let options = Options::default().progress(&listener);
    let mut session = device.session().expect("a session");
    let error = session.triangulate_batch(jobs, &options).expect_err("cancelled");
    assert_eq!(error.kind(), ErrorKind::Cancelled, "{patience}: {error}");
    let meshes = session.triangulate_batch(jobs, &Options::default()).expect("in step");
    assert!(meshes.into_iter().map(bare).eq(right.iter().cloned()), "{patience}");
}
