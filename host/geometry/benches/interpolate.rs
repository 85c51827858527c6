//! Queries a second of each method: `cargo bench -p incircle-geometry --bench interpolate -- POINTS THREADS`. On one
//! thread, the default, the time is that of the processor; on several it is that of the clock on the wall, so the
//! machine has to be quiet.

use core::hint::black_box;
use core::num::NonZeroUsize;
use core::ops::ControlFlow;
use std::time::Instant;

use incircle_geometry::interpolate::{Method, Outside, Surface};
use incircle_geometry::{cpu, order, Point};
use incircle_testkit::SplitMix64;

/// Bits of a coordinate.
const BITS: u32 = 24;
/// Runs of which the best counts.
const RUNS: usize = 5;
/// Queries of a run.
const QUERIES: usize = 2_000_000;

/// Seconds of processor time of this thread, where the system tells it, so that other work does not count; else of the
/// clock on the wall.
fn processor_time(since: Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds: Option<f64> = text.split_whitespace().next().and_then(|number| number.parse().ok());
    nanoseconds.map_or_else(|| since.elapsed().as_secs_f64(), |nanoseconds| nanoseconds / 1e9)
}

fn draw(random: &mut SplitMix64, count: usize) -> Vec<Point> {
    (0..count).map(|_| Point::new(random.bits(BITS) as u32, random.bits(BITS) as u32)).collect()
}

fn doubles(points: &[Point]) -> Vec<[f64; 2]> {
    points.iter().map(|point| [point.x.into(), point.y.into()]).collect()
}

fn main() {
    let numbers: Vec<usize> = std::env::args().skip(1).filter_map(|argument| argument.parse().ok()).collect();
    let count = numbers.first().copied().unwrap_or(1_000_000);
    let threads = numbers.get(1).and_then(|&threads| NonZeroUsize::new(threads)).unwrap_or(NonZeroUsize::MIN);
    let (now, clock): (fn(Instant) -> f64, &str) = match threads.get() {
        1 => (processor_time, "processor time"),
        _ => (|since| since.elapsed().as_secs_f64(), "time on the wall"),
    };
    let mut random = SplitMix64::new(29);
    let points = doubles(&draw(&mut random, count));
    let places = draw(&mut random, QUERIES);
    let sorted: Vec<Point> = order::hilbert(&places).into_iter().map(|index| places[index as usize]).collect();
    let mesh = cpu::triangulate(points.clone(), NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("a mesh");
    let values: Vec<f64> = points.iter().map(|[x, y]| x * 3.0 - y).collect();
    let since = Instant::now();
    let begin = now(since);
    let surface = Surface::new(&points, &mesh.triangles, &values).expect("a surface");
    println!("{count} points, {threads} threads, {clock}, best of {RUNS}; surface {:.3} s", now(since) - begin);
    for (name, places) in [("sorted", doubles(&sorted)), ("random", doubles(&places))] {
        for method in [Method::Linear, Method::Laplace, Method::Sibson] {
            let time = |_| {
                let since = Instant::now();
                let begin = now(since);
                drop(black_box(surface.values(method, Outside::Nan, &places, threads)));
                now(since) - begin
            };
            let best = (0..RUNS).map(time).fold(f64::INFINITY, f64::min);
            println!("{name} {method:?}: {:.2} million a second", QUERIES as f64 / best / 1e6);
        }
    }
}
