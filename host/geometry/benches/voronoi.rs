//! The time of a Voronoi diagram beside that of its mesh: `cargo bench -p incircle-geometry --bench voronoi -- POINTS`.
//!
//! With the name of a file behind the number, the points are also written there, as pairs of little-endian `u32`, so
//! that another program can be measured on the same set.

use core::hint::black_box;
use core::num::NonZeroUsize;
use core::ops::ControlFlow;
use std::time::Instant;

use incircle_geometry::voronoi::{Cells, Clip, Voronoi};
use incircle_geometry::{cpu, lloyd, order, Point};
use incircle_testkit::SplitMix64;

/// Bits of a coordinate.
const BITS: u32 = 24;
/// Runs of which the best counts.
const RUNS: usize = 5;

/// Seconds of processor time of this thread, where the system tells it, so that other work does not count; else of the
/// clock on the wall.
fn now(since: Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds: Option<f64> = text.split_whitespace().next().and_then(|number| number.parse().ok());
    nanoseconds.map_or_else(|| since.elapsed().as_secs_f64(), |nanoseconds| nanoseconds / 1e9)
}

/// The processor time of all threads of this process so far, in steps of a hundredth of a second. 0 where the system
/// does not tell it.
fn of_all_threads() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // The name of the program, in brackets, may have spaces.
    let behind = text.rsplit(')').next().unwrap_or_default();
    let ticks = behind.split_whitespace().skip(11).take(2).filter_map(|number| number.parse::<f64>().ok());
    ticks.sum::<f64>() / 100.0
}

/// The least seconds by the wall and of processor time of two kinds of work that take turns.
fn in_turns(works: [&mut dyn FnMut(); 2]) -> [[f64; 2]; 2] {
    let mut least = [[f64::INFINITY; 2]; 2];
    for turn in 0..4 * RUNS {
        let (since, begin) = (Instant::now(), of_all_threads());
        works[turn % 2]();
        let [wall, processor] = &mut least[turn % 2];
        *wall = wall.min(since.elapsed().as_secs_f64());
        *processor = processor.min(of_all_threads() - begin);
    }
    least
}

fn best(mut run: impl FnMut()) -> f64 {
    let time = |_| {
        let since = Instant::now();
        let begin = now(since);
        run();
        now(since) - begin
    };
    (0..RUNS).map(time).fold(f64::INFINITY, f64::min)
}

fn main() {
    let numbers: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let count = numbers.first().and_then(|text| text.parse().ok()).unwrap_or(1_000_000);
    let mut random = SplitMix64::new(28);
    let points: Vec<Point> =
        (0..count).map(|_| Point::new(random.bits(BITS) as u32, random.bits(BITS) as u32)).collect();
    if let Some(file) = numbers.get(1) {
        let bytes: Vec<u8> = points.iter().flat_map(|point| [point.x, point.y]).flat_map(u32::to_le_bytes).collect();
        std::fs::write(file, bytes).expect("the points can be written");
    }
    let triangulate = || cpu::triangulate(points.clone(), NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()));
    let mesh = triangulate().expect("a mesh");
    let mesh_time = best(|| drop(black_box(triangulate())));
    let diagram_time = best(|| drop(black_box(Voronoi::of(&mesh))));
    let voronoi = Voronoi::of(&mesh).expect("a diagram");
    let vertices_time = best(|| {
        let all = (0..voronoi.vertex_count() as u32).map(|vertex| voronoi.vertex(vertex).nearest());
        drop(black_box(all.collect::<Vec<_>>()));
    });
    let clip = Clip::rectangle(Point::new(0, 0), Point::new((1 << BITS) - 1, (1 << BITS) - 1)).expect("a square");
    let clipped_time = best(|| {
        let mut cells = Cells::new(&voronoi, &clip);
        let area: f64 = (0..count as u32).map(|point| cells.cell(point).area()).sum();
        black_box(area);
    });
    let whole = mesh_time + diagram_time + vertices_time;
    println!("{count} points, one thread, processor time, best of {RUNS}:");
    println!("mesh {mesh_time:.3} s, diagram {diagram_time:.3} s, rounded vertices {vertices_time:.3} s");
    let order = order::hilbert(&points);
    let near: Vec<Point> = order.iter().map(|&index| points[index as usize]).collect();
    let step_time = best(|| drop(black_box(lloyd::step(&near, &clip, NonZeroUsize::MIN))));
    println!("a step of Lloyd's relaxation {step_time:.3} s");
    let two = NonZeroUsize::MIN.saturating_add(1);
    let mesh = || drop(black_box(cpu::triangulate(near.clone(), two, &mut |_| ControlFlow::Continue(()))));
    let step = || drop(black_box(lloyd::step(&near, &clip, two)));
    let [mesh, step] = in_turns([&mut { mesh }, &mut { step }]);
    println!(
        "two threads, in turns: mesh {:.3} s, step {:.3} s, {:.2} times; processor time {:.2} s, {:.2} s, {:.2} times",
        mesh[0],
        step[0],
        step[0] / mesh[0],
        mesh[1],
        step[1],
        step[1] / mesh[1]
    );
    println!("in all {whole:.3} s; cells in a square with their areas {clipped_time:.3} s more");
}
