//! Queries a second of each method: `cargo bench -p incircle-geometry --bench interpolate -- POINTS THREADS`.

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

fn draw(random: &mut SplitMix64, count: usize) -> Vec<Point> {
    (0..count).map(|_| Point::new(random.bits(BITS) as u32, random.bits(BITS) as u32)).collect()
}

fn doubles(points: &[Point]) -> Vec<[f64; 2]> {
    points.iter().map(|point| [point.x.into(), point.y.into()]).collect()
}

fn main() {
    let numbers: Vec<usize> = std::env::args().skip(1).filter_map(|argument| argument.parse().ok()).collect();
    let count = numbers.first().copied().unwrap_or(1_000_000);
    let threads = numbers.get(1).copied().and_then(NonZeroUsize::new).unwrap_or(NonZeroUsize::MIN);
    let mut random = SplitMix64::new(29);
    let points = doubles(&draw(&mut random, count));
    let places = draw(&mut random, QUERIES);
    let sorted: Vec<Point> = order::hilbert(&places).into_iter().map(|index| places[index as usize]).collect();
    let mesh = cpu::triangulate(points.clone(), threads, &mut |_| ControlFlow::Continue(())).expect("a mesh");
    let values: Vec<f64> = points.iter().map(|[x, y]| x * 3.0 - y).collect();
    let since = Instant::now();
    let surface = Surface::new(&points, &mesh.triangles, &values).expect("a surface");
    println!("{count} points, {threads} threads, best of {RUNS}; surface {:.3} s", since.elapsed().as_secs_f64());
    for (name, places) in [("sorted", doubles(&sorted)), ("random", doubles(&places))] {
        for method in [Method::Linear, Method::Laplace, Method::Sibson] {
            let time = |_| {
                let since = Instant::now();
                drop(black_box(surface.values(method, Outside::Nan, &places, threads)));
                since.elapsed().as_secs_f64()
            };
            let best = (0..RUNS).map(time).fold(f64::INFINITY, f64::min);
            println!("{name} {method:?}: {:.2} million a second", QUERIES as f64 / best / 1e6);
        }
    }
}
