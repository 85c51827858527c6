//! What tests of batches share.

use incircle::{Device, Error, Mesh, Options, Point};

/// The mesh without its report.
pub fn bare(mesh: Mesh) -> Mesh {
    Mesh { report: Default::default(), ..mesh }
}

/// Every job alone, by the engine in this process.
pub fn alone(jobs: &[Vec<Point>]) -> Vec<Mesh> {
    let mut device = Device::cpu(None);
    let mut session = device.session().expect("a device in this process");
    jobs.iter().map(|points| bare(session.triangulate(points).expect("a mesh"))).collect()
}

/// The meshes of a batch, without their reports.
pub fn batch(device: &mut Device, jobs: &[Vec<Point>], options: &Options<'_>) -> Result<Vec<Mesh>, Error> {
    device.session()?.triangulate_batch(jobs, options).map(|meshes| meshes.into_iter().map(bare).collect())
}
