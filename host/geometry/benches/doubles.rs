//! Measures doubles beside the same points as integers of 31 bits, on one thread.
//!
//! ```text
//! cargo bench -p incircle-geometry --bench doubles                   # a million points, 21 pairs of runs
//! cargo bench -p incircle-geometry --bench doubles -- 100000 51      # other numbers of points and pairs
//! ```
//!
//! The sets:
//! - `uniform`: random doubles, and the same points moved to the nearest places of a grid of 31 bits.
//! - `whole`: the grid points of `uniform`, as integers and as doubles. The doubles are triangulated as doubles,
//!   although they have a lattice. Both meshes must be equal.
//! - `lattice`: a square lattice of tenths, each coordinate moved by up to one unit in the last place. On the grid the
//!   lattice is exact, and each of its squares is a tie.
//! - `circle`: points of the unit circle, rounded to doubles and to the grid.
//!
//! A pair of runs is one call with the integers and one with the doubles; the next pair has them in the other order.
//! The table has the median of the times and the median of the ratios within a pair. Other work on the machine disturbs
//! these ratios less than the times. A call includes the search for a lattice, except for the doubles of `whole`.
//! Before the timed calls, the validator checks each mesh of doubles.

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::process::ExitCode;
use std::time::Instant;

use incircle_geometry::cpu::{connect, Connectivity};
use incircle_geometry::{Mesh, PlanePoint, Point};
use incircle_testkit::SplitMix64;

/// The numbers of points and of pairs if the arguments name none.
const POINTS: usize = 1_000_000;
const PAIRS: usize = 21;
/// The number of steps of the grid in a unit: the grid has 31 bits.
const PLACES: f64 = (1u32 << 31) as f64;

/// A set of points in both forms.
struct Set {
    name: &'static str,
    integers: Vec<Point>,
    doubles: Vec<[f64; 2]>,
    /// Whether both forms are the same numbers, so that both have the same mesh.
    is_equal: bool,
}

fn sets(count: usize) -> [Set; 4] {
    let mut random = SplitMix64::new(19);
    let uniform: Vec<[f64; 2]> = (0..count).map(|_| [random.unit(), random.unit()]).collect();
    let integers: Vec<Point> = uniform.iter().map(|&point| on_grid(point, PLACES)).collect();
    let whole: Vec<[f64; 2]> = integers.iter().map(|p| [p.x.into(), p.y.into()]).collect();
    [
        Set { name: "uniform", integers: integers.clone(), doubles: uniform, is_equal: false },
        Set { name: "whole", integers, doubles: whole, is_equal: true },
        lattice(count, &mut random),
        circle(count, &mut random),
    ]
}

/// The grid point nearest to a point, on a grid of 31 bits with `places` steps in a unit.
fn on_grid(point: [f64; 2], places: f64) -> Point {
    let [x, y] = point.map(|value| ((value * places).round() as u32).min((1 << 31) - 1));
    Point::new(x, y)
}

fn lattice(count: usize, random: &mut SplitMix64) -> Set {
    let side = count.isqrt() as u32;
    let step = (1 << 31) / side.max(1);
    let moved = |value: f64, random: &mut SplitMix64| match random.below(3) {
        0 => value.next_down(),
        1 => value.next_up(),
        _ => value,
    };
    let mut cells: Vec<[u32; 2]> = (0..side * side).map(|cell| [cell % side, cell / side]).collect();
    random.shuffle(&mut cells);
    let doubles = cells.iter().map(|cell| cell.map(|k| moved(f64::from(k + 1) * 0.1, random))).collect();
    let integers = cells.iter().map(|&[x, y]| Point::new(step * x, step * y)).collect();
    Set { name: "lattice", integers, doubles, is_equal: false }
}

fn circle(count: usize, random: &mut SplitMix64) -> Set {
    let angles = (0..count).map(|_| std::f64::consts::TAU * random.unit());
    let doubles: Vec<[f64; 2]> = angles.map(|angle| [angle.cos(), angle.sin()]).collect();
    let integers = doubles.iter().map(|point| on_grid(point.map(|value| value + 1.0), PLACES / 2.0)).collect();
    Set { name: "circle", integers, doubles, is_equal: false }
}

/// Times one call. Returns the seconds, and the triangles, hull and duplicates.
fn timed<P: PlanePoint>(points: &[P], looks_for_lattice: bool) -> (f64, Connectivity) {
    let start = Instant::now();
    let numbers = P::numbers(points);
    let numbers = if looks_for_lattice { numbers.on_lattice().0 } else { numbers };
    let found = connect(&numbers, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("finite coordinates");
    (start.elapsed().as_secs_f64(), black_box(found))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Checks the answers of a set, then prints its row.
fn measure(set: &Set, pairs: usize) -> Result<(), String> {
    let Set { name, integers, doubles, is_equal } = set;
    let (_, expected) = timed(integers, true);
    let (_, found) = timed(doubles, !is_equal);
    if *is_equal && found != expected {
        return Err(format!("{name}: the same points have other triangles as doubles than as integers"));
    }
    let Connectivity { triangles, hull, duplicates } = found;
    let mesh = Mesh::new(doubles.clone(), triangles, hull, duplicates);
    mesh.verify().map_err(|error| format!("{name}: {error}"))?;
    drop((mesh, expected));
    let mut times = [Vec::new(), Vec::new()];
    for pair in 0..pairs {
        for turn in 0..2 {
            match (pair + turn) % 2 {
                0 => times[0].push(timed(integers, true).0),
                _ => times[1].push(timed(doubles, !is_equal).0),
            }
        }
    }
    let ratios = times[0].iter().zip(&times[1]).map(|(integers, doubles)| doubles / integers).collect();
    let least = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
    let least = least(&times[1]) / least(&times[0]);
    let nanoseconds = |times: Vec<f64>| 1e9 * median(times) / integers.len() as f64;
    let [of_integers, of_doubles] = times.map(nanoseconds);
    println!("{name:<10}{of_integers:>10.1}{of_doubles:>10.1}{:>8.3}{least:>16.3}", median(ratios));
    Ok(())
}

fn main() -> ExitCode {
    // Cargo adds the option `--bench`, which is no number.
    let mut numbers = std::env::args().skip(1).filter_map(|word| word.parse().ok());
    let (points, pairs) = (numbers.next().unwrap_or(POINTS), numbers.next().unwrap_or(PAIRS));
    println!("{points} points, medians of {pairs} pairs, ns per point");
    println!("{:<10}{:>10}{:>10}{:>8}{:>16}", "set", "integers", "doubles", "ratio", "ratio of least");
    for set in sets(points) {
        if let Err(error) = measure(&set, pairs) {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}
