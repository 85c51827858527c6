//! Measures the operations of a triangulation that lives, on one thread.
//!
//! ```text
//! cargo run --release -p incircle-geometry --example living                # a million points
//! cargo run --release -p incircle-geometry --example living -- 100000 3    # other numbers of points and rounds
//! ```
//!
//! Every operation runs in a random order and in the order of a Hilbert curve. The times are the smallest of the
//! rounds, in nanoseconds an operation, and each is the median over blocks of 2,000 operations. The last rows delete a
//! vertex with many neighbours. The table has the kinds of coordinates side by side.

use std::hint::black_box;
use std::time::Instant;

use incircle_geometry::{cpu, Order, PlanePoint, Point, Triangulation};
use incircle_testkit::SplitMix64;

const POINTS: usize = 1_000_000;
const ROUNDS: usize = 3;
/// Bits of the grid.
const BITS: u32 = 31;

/// Operations that are timed together.
const BLOCK: usize = 2000;
/// Neighbours of the hubs of wheels, and deletions of each hub, of which the quickest counts.
const WHEELS: [usize; 5] = [64, 128, 129, 256, 512];
const TURNS: usize = 50;
/// The radius of the wheels. Its primes are of the form 4 k + 1, so that many grid points lie on the circle.
const RADIUS: u32 = 5 * 13 * 17 * 29 * 37;

/// Nanoseconds an operation on each item: the median over blocks of items, which other work on the machine disturbs
/// less than the sum.
fn each<T: Copy>(items: &[T], mut work: impl FnMut(T)) -> f64 {
    let mut times: Vec<f64> = Vec::new();
    for block in items.chunks(BLOCK) {
        let start = Instant::now();
        block.iter().for_each(|&item| work(item));
        times.push(1e9 * start.elapsed().as_secs_f64() / block.len() as f64);
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Nanoseconds for each of `count` points, of one call.
fn timed<T>(count: usize, work: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = black_box(work());
    (1e9 * start.elapsed().as_secs_f64() / count as f64, result)
}

/// The points in the order of a Hilbert curve.
fn along_curve(points: &[Point]) -> Vec<Point> {
    Order::Hilbert.order(points).into_iter().map(|index| points[index as usize]).collect()
}

/// Names of operations with their times, in the order in which they were first measured.
#[derive(Default)]
struct Times(Vec<(String, f64)>);

impl Times {
    fn note(&mut self, name: &str, time: f64) {
        match self.0.iter_mut().find(|entry| entry.0 == name) {
            Some(entry) => entry.1 = entry.1.min(time),
            None => self.0.push((name.to_string(), time)),
        }
    }
}

fn measure<P: PlanePoint>(times: &mut Times, random: &mut SplitMix64, grid: &[Point], to_point: fn(Point) -> P) {
    let count = grid.len();
    let points: Vec<P> = grid.iter().map(|&point| to_point(point)).collect();
    let (time, mesh) = timed(count, || Triangulation::from(points.iter().copied()).expect("finite points"));
    times.note("from", time);
    times.note("bytes a point", mesh.bytes() as f64 / count as f64);
    times.note("mesh", timed(count, || mesh.mesh()).0);
    for part in [10, 50, 3, 2] {
        measure_frames(times, random, &mut mesh.clone(), grid, part, to_point);
    }
    let queries: Vec<Point> = random.points(count, 1 << BITS);
    for (order, grid_queries) in [("random", queries.clone()), ("hilbert", along_curve(&queries))] {
        let queries: Vec<P> = grid_queries.iter().map(|&point| to_point(point)).collect();
        times.note(&format!("locate {order}"), each(&queries, |q| _ = black_box(mesh.locate(q))));
        times.note(&format!("nearest {order}"), each(&queries, |q| _ = black_box(mesh.nearest(q))));
        let mut mesh = mesh.clone();
        times.note(&format!("insert {order}"), each(&queries, |q| _ = mesh.insert(q)));
        // The points of this order go first, again in this order.
        let indices: Vec<u32> = (count as u32..mesh.next_index()).collect();
        times.note(&format!("delete {order}"), each(&indices, |index| _ = mesh.delete(index)));
    }
}

/// Deletes the hub of a wheel and inserts it again. All neighbours lie on one circle exactly, so every test of four of
/// them is a tie.
fn measure_wheels<P: PlanePoint>(times: &mut Times, to_point: fn(Point) -> P) {
    let rim = circle();
    for neighbors in WHEELS {
        let chosen = (0..neighbors).map(|k| to_point(rim[k * rim.len() / neighbors]));
        let mut mesh = Triangulation::from(chosen).expect("finite points");
        for _ in 0..TURNS {
            let hub = mesh.insert(to_point(Point::new(RADIUS, RADIUS))).expect("finite points");
            times.note(&format!("delete a hub of {neighbors}"), timed(1, || mesh.delete(hub)).0);
        }
    }
}

/// All grid points on the circle around the hub, counter-clockwise.
fn circle() -> Vec<Point> {
    let square = |value: u32| u64::from(value) * u64::from(value);
    let on_circle = |x: u32| {
        let y = (square(RADIUS) - square(x)).isqrt() as u32;
        (square(x) + square(y) == square(RADIUS)).then_some((x, y))
    };
    let first: Vec<(u32, u32)> = (1..=RADIUS).rev().filter_map(on_circle).collect();
    // The end on the axis is the first point of the lower half.
    let second = first.iter().rev().filter(|&&(_, y)| y > 0).map(|&(x, y)| [-f64::from(x), f64::from(y)]);
    let upper: Vec<[f64; 2]> = first.iter().map(|&(x, y)| [f64::from(x), f64::from(y)]).chain(second).collect();
    let lower = upper.iter().map(|&[x, y]| [-x, -y]);
    let all = upper.iter().copied().chain(lower);
    all.map(|place| place.map(|value| (f64::from(RADIUS) + value) as u32)).map(|[x, y]| Point::new(x, y)).collect()
}

/// Moves all points by up to a part of the mean distance between neighbours on each axis, and triangulates the same
/// places anew.
fn measure_frames<P: PlanePoint>(
    times: &mut Times,
    random: &mut SplitMix64,
    mesh: &mut Triangulation<P>,
    grid: &[Point],
    part: u32,
    to_point: fn(Point) -> P,
) {
    let side = 1u32 << BITS;
    let most = (f64::from(side) / (grid.len() as f64).sqrt()) as u32 / part;
    let mut places = grid.to_vec();
    for _ in 0..3 {
        let step = |value: u32, random: &mut SplitMix64| {
            (value + random.below_u32(2 * most + 1)).saturating_sub(most).min(side - 1)
        };
        places.iter_mut().for_each(|p| *p = Point::new(step(p.x, random), step(p.y, random)));
        let points: Vec<P> = places.iter().map(|&place| to_point(place)).collect();
        times.note(
            &format!("move_all, 1/{part}"),
            timed(grid.len(), || mesh.move_all(&points).expect("finite points")).0,
        );
        let thread = std::num::NonZeroUsize::MIN;
        let anew = || cpu::triangulate(points, thread, &mut |_| std::ops::ControlFlow::Continue(()));
        times.note("cpu::triangulate", timed(grid.len(), anew).0);
    }
}

fn main() {
    let mut arguments = std::env::args().skip(1).map(|text| text.parse().expect("a number"));
    let (count, rounds) = (arguments.next().unwrap_or(POINTS), arguments.next().unwrap_or(ROUNDS));
    let (mut integers, mut doubles) = (Times::default(), Times::default());
    for round in 0..rounds {
        let mut random = SplitMix64::new(round as u64);
        let grid: Vec<Point> = random.points(count, 1 << BITS);
        measure(&mut integers, &mut random.clone(), &grid, |point| point);
        measure(&mut doubles, &mut random, &grid, |p| [f64::from(p.x) * 0.1, f64::from(p.y) * 0.1]);
    }
    measure_wheels(&mut integers, |point| point);
    measure_wheels(&mut doubles, |p| [f64::from(p.x), f64::from(p.y)]);
    println!("{count} points, ns an operation          grid of {BITS} bits     doubles");
    for ((name, integer), (_, double)) in integers.0.iter().zip(&doubles.0) {
        println!("{name:36} {integer:12.0} {double:12.0}");
    }
}
