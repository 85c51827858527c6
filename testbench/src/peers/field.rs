//! The contestants: our back end `cpu` twice, two libraries in this process, and two other programs.

use std::hint::black_box;
use std::time::Instant;

use incircle::{Device, Options, Point, Stage};
use spade::Triangulation;

use super::contestant::{Contestant, Missing, Run};
use super::error::PeerError;
use super::process::{cgal, triangle};

/// The clocks that run during a call.
struct Watch {
    since: Instant,
    busy_since: f64,
}

impl Watch {
    fn start() -> Self {
        Self { since: Instant::now(), busy_since: busy() }
    }

    fn stop(&self, triangles: impl FnOnce() -> usize) -> Run {
        let (seconds, busy) = (self.since.elapsed().as_secs_f64(), busy() - self.busy_since);
        Run { seconds, busy, triangles: triangles(), distinct: None, order_share: None }
    }
}

/// Seconds that the processor has spent on this thread.
fn busy() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// The contestants that run, and those that are missing.
pub(super) type Field = (Vec<Box<dyn Contestant>>, Vec<Missing>);

/// All contestants that are installed, ours with one thread first, and those that are not.
pub(super) fn all(bits: u32) -> Result<Field, PeerError> {
    let mut present: Vec<Box<dyn Contestant>> = vec![
        Box::new(Ours { name: "cpu", device: Device::open("cpu?threads=1")? }),
        Box::new(Ours { name: "cpu, all threads", device: Device::open("cpu")? }),
        Box::new(Ours { name: "model", device: Device::open(&format!("model?coord-bits={bits}"))? }),
        Box::new(Spade),
        Box::new(Delaunator),
    ];
    let mut missing = Vec::new();
    for found in [cgal(), triangle()] {
        match found {
            Ok(peer) => present.push(Box::new(peer)),
            Err(absent) => missing.push(absent),
        }
    }
    Ok((present, missing))
}

/// A back end of ours.
struct Ours {
    name: &'static str,
    device: Device,
}

impl Contestant for Ours {
    fn name(&self) -> &'static str {
        self.name
    }

    fn run(&mut self, points: &[Point]) -> Result<Run, PeerError> {
        let mut session = self.device.session()?;
        let watch = Watch::start();
        let solution = session.triangulate_with(points, &Options::default())?;
        let run = watch.stop(|| solution.mesh.triangles.len());
        let order_share = solution.report.stage(Stage::Order).map(|order| order.as_secs_f64() / run.seconds);
        Ok(Run { distinct: Some(solution.report.distinct), order_share, ..run })
    }
}

/// The library `spade`, by bulk load.
struct Spade;

impl Contestant for Spade {
    fn name(&self) -> &'static str {
        "spade"
    }

    fn run(&mut self, points: &[Point]) -> Result<Run, PeerError> {
        let points = points.iter().map(|p| spade::Point2::new(f64::from(p.x), f64::from(p.y))).collect();
        let watch = Watch::start();
        let mesh = spade::DelaunayTriangulation::<spade::Point2<f64>>::bulk_load(points);
        let run = watch.stop(|| black_box(&mesh).as_ref().map_or(0, Triangulation::num_inner_faces));
        mesh.map_err(|error| PeerError::Peer { peer: "spade", reason: error.to_string() })?;
        Ok(run)
    }
}

/// The library `delaunator`, by its one function.
struct Delaunator;

impl Contestant for Delaunator {
    fn name(&self) -> &'static str {
        "delaunator"
    }

    fn run(&mut self, points: &[Point]) -> Result<Run, PeerError> {
        let points: Vec<_> = points.iter().map(|p| delaunator::Point { x: p.x.into(), y: p.y.into() }).collect();
        let watch = Watch::start();
        let mesh = delaunator::triangulate(&points);
        Ok(watch.stop(|| black_box(&mesh).len()))
    }
}
