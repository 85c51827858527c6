//! `tracks`: image features that a camera tracks, frame by frame, in a mesh that lives on the core and on the
//! processor, beside a core and a processor that make the mesh of every frame anew.
//!
//! In each frame some features drift, one in 60 vanishes, as many appear, and the triangles at some places are asked
//! for. The cycles of the core are those of its model clock by clock, which equals the Verilog at every port, from the
//! first word of the first command to the last word of the last answer. The times of the processor are medians. All
//! meshes and answers are compared.

mod arguments;
mod scene;

use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use incircle::transports::ClockTransport;
use incircle::{Device, LivingMesh, LivingSession, Mesh, Triangulation};
use incircle_geometry::living::Location;
use incircle_geometry::{cpu, Point};
use incircle_model::ChipModel;
use incircle_protocol::{Config, FULL};

use crate::orders::{print, Failure};
pub use arguments::TracksArguments;
use scene::{Frame, Motion, Scene};

/// The motions that the table has a row for.
const MOTIONS: [Motion; 4] = [
    Motion { one_in: 1, pixels: 2.0 },
    Motion { one_in: 1, pixels: 0.25 },
    Motion { one_in: 10, pixels: 2.0 },
    Motion { one_in: 10, pixels: 0.25 },
];

/// Runs the subcommand: a row for each motion.
///
/// # Errors
/// Meshes or answers differ, or the core cannot be built.
pub fn tracks(arguments: &TracksArguments) -> Result<(), Failure> {
    print(&format!(
        "{} features, {} frames, {} places a frame, {} contexts\n\
         a frame in cycles of the core and in microseconds of the processor, mean and median\n\
         {:26}| core that keeps the mesh      | core anew | processor that keeps it      | processor anew\n\
         {:26}| changes   places   read-out   |           | changes   places   read-out |\n",
        arguments.n, arguments.frames, arguments.places, arguments.contexts, "", ""
    ))?;
    for motion in MOTIONS {
        print(&row(motion, &measure(arguments, motion)?))?;
    }
    Ok(())
}

fn row(motion: Motion, sums: &Sums) -> String {
    let frames = sums.frames.max(1);
    let [changes, places, read_out] = sums.core.map(|clocks| clocks / frames);
    let [cpu_changes, cpu_places, cpu_read_out, cpu_anew] = sums.median().map(|time| time.as_secs_f64() * 1e6);
    format!(
        "{:26}| {changes:7} {places:8} {read_out:10}   | {:9} | {cpu_changes:7.0} {cpu_places:8.0} {cpu_read_out:10.0} \
         | {cpu_anew:6.0}\n",
        motion.to_string(),
        sums.anew / frames,
    )
}

/// The sums over all frames.
#[derive(Debug, Default)]
struct Sums {
    frames: u64,
    /// Clocks of changes, questions and read-outs.
    core: [u64; 3],
    /// Clocks of the core that makes each mesh anew.
    anew: u64,
    /// Times of changes, questions, read-outs, and of the processor that makes each mesh anew.
    processor: Vec<[Duration; 4]>,
}

impl Sums {
    fn median(&self) -> [Duration; 4] {
        std::array::from_fn(|part| {
            let mut times: Vec<Duration> = self.processor.iter().map(|frame| frame[part]).collect();
            times.sort_unstable();
            times.get(times.len() / 2).copied().unwrap_or_default()
        })
    }
}

/// What one frame gives.
#[derive(Debug, PartialEq)]
struct Seen {
    located: Vec<Location>,
    mesh: Mesh<Point>,
}

fn measure(arguments: &TracksArguments, motion: Motion) -> Result<Sums, Failure> {
    let config = Config { name: "tracks", contexts: arguments.contexts, ..FULL };
    let (mut living, mut anew) = (core(config)?, core(config)?);
    let mut living = living.session()?;
    let mut on_core = living.living()?;
    let mut anew = anew.session()?;
    let mut on_processor: Triangulation<Point> = Triangulation::new();
    let mut scene = Scene::new(arguments, motion);
    let first = scene.first();
    on_core.insert_all(&first)?;
    on_processor.insert_all(&first)?;
    // The first question reads what the insertions have left to do.
    on_core.mesh()?;
    let mut sums = Sums::default();
    for number in 0..arguments.frames {
        let frame = scene.frame();
        let before = clocks(&on_core)?;
        let (seen, ticks) = carry_out(&mut on_core, &frame, |mesh| clocks(mesh))?;
        for (sum, pair) in sums.core.iter_mut().zip([before, ticks[0], ticks[1], ticks[2]].windows(2)) {
            *sum += pair[1] - pair[0];
        }
        let start = Instant::now();
        let (expected, times) = carry_out(&mut on_processor, &frame, |_| Ok(start.elapsed()))?;
        let before = anew.clocks().unwrap_or(0);
        let solution = anew.triangulate(&expected.mesh.points)?;
        sums.anew += anew.clocks().unwrap_or(0) - before;
        let points = expected.mesh.points.clone();
        let start = Instant::now();
        let mesh = cpu::triangulate(points, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))?;
        sums.processor.push([times[0], times[1] - times[0], times[2] - times[1], start.elapsed()]);
        if seen != expected || solution.mesh != expected.mesh || mesh != expected.mesh {
            return Err(format!("{motion}: the meshes or answers of frame {number} differ").into());
        }
    }
    sums.frames = u64::from(arguments.frames);
    Ok(sums)
}

/// A core with runs.
fn core(config: Config) -> Result<Device, Failure> {
    let model = ChipModel::new(config).map_err(|refusal| Failure::from(refusal.to_string()))?;
    Ok(Device::from_transport(Box::new(ClockTransport::around(model.with_core_runs(), config))))
}

fn clocks(session: &LivingSession<'_>) -> Result<u64, Failure> {
    session.clocks().ok_or_else(|| Failure::from("the core counts no clocks"))
}

/// Carries out a frame. `now` is asked after the changes, after the questions, and after the read-out.
fn carry_out<M: LivingMesh<Point>, T: Copy>(
    mesh: &mut M,
    frame: &Frame,
    now: impl Fn(&M) -> Result<T, Failure>,
) -> Result<(Seen, [T; 3]), Failure> {
    mesh.move_all(&frame.moves)?;
    mesh.delete_all(&frame.gone)?;
    mesh.insert_all(&frame.new)?;
    let changed = now(mesh)?;
    let located = mesh.locate_all(&frame.places)?;
    let answered = now(mesh)?;
    let read_out = mesh.mesh()?;
    let times = [changed, answered, now(mesh)?];
    Ok((Seen { located, mesh: read_out }, times))
}
