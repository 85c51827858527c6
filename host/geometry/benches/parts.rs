//! Measures sets in parts: the host's time for each point of an evenly spread set whose parts others triangulate.
//!
//! ```text
//! cargo bench -p incircle-geometry --bench parts                # a million points of 16 bits, 9 runs, one thread
//! cargo bench -p incircle-geometry --bench parts -- 100000 5    # other numbers of points and runs
//! cargo bench -p incircle-geometry --bench parts -- 1000000 9 1024    # parts of one size only
//! ```
//!
//! The table has a row for each size of part, with the least time of all runs in ns a point:
//! - `cut`: `Parts::divide`, which orders the points and takes duplicates out.
//! - `finals`: `Parts::solved` for all parts, which finds the final triangles and makes half-edges of the others.
//! - `join`: `Parts::join`, which also sorts all triangles. In the last row all points are one part, so nearly all of
//!   this is the sorting.
//! - `border`: the points at seams, in per cent of all points.
//!
//! The joined mesh is compared with that of `cpu::triangulate`.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::process::ExitCode;
use std::time::Instant;

use incircle_geometry::cpu::{triangulate, Parts, SolvedPart};
use incircle_geometry::{Mesh, Point};
use incircle_testkit::{generate, Distribution};

/// The numbers of points and of runs if the arguments name none.
const POINTS: usize = 1_000_000;
const RUNS: usize = 9;
const BITS: u32 = 16;
/// The most points of a part in each row.
const MOST: [usize; 5] = [1_024, 2_048, 4_096, 8_192, 16_384];
const ONE: NonZeroUsize = NonZeroUsize::MIN;

fn mesh_of(points: Vec<Point>) -> Mesh {
    triangulate(points, ONE, &mut |_| ControlFlow::Continue(())).expect("few enough points")
}

/// The times of one run in ns a point, the share of points at seams in per cent, and the triangles of the joined mesh.
fn run(points: &[Point], most: usize) -> ([f64; 3], f64, Vec<[u32; 3]>) {
    let ns = |since: Instant| since.elapsed().as_nanos() as f64 / points.len() as f64;
    let since = Instant::now();
    let parts = Parts::divide(points, most, ONE).expect("few enough points");
    let cut = ns(since);
    let meshes: Vec<Mesh> = (0..parts.count()).map(|part| mesh_of(parts.points(part))).collect();
    let since = Instant::now();
    let solved: Vec<SolvedPart> = meshes
        .into_iter()
        .enumerate()
        .map(|(part, mesh)| parts.solved(part, mesh.triangles, &mesh.hull).expect("a sound mesh"))
        .collect();
    let finals = ns(since);
    let border = solved.iter().map(SolvedPart::border).sum::<usize>() as f64 * 100.0 / points.len() as f64;
    let since = Instant::now();
    let joined = parts.join(solved, ONE).expect("sound parts");
    ([cut, finals, ns(since)], border, joined.triangles)
}

fn main() -> ExitCode {
    let mut numbers = std::env::args().skip(1).filter_map(|text| text.parse().ok());
    let (count, runs) = (numbers.next().unwrap_or(POINTS), numbers.next().unwrap_or(RUNS).max(1));
    let made = generate(Distribution::Uniform, count, BITS, 1).expect("an even set");
    let points: Vec<Point> = made.into_iter().map(Point::from).collect();
    let right = mesh_of(points.clone()).triangles;
    let sizes: Vec<usize> = numbers.collect();
    println!("{:>8} {:>8} {:>8} {:>8} {:>8}", "most", "cut", "finals", "join", "border");
    for most in if sizes.is_empty() { MOST.into_iter().chain([count]).collect() } else { sizes } {
        let (mut least, mut share) = ([f64::INFINITY; 3], 0.0);
        for _ in 0..runs {
            let (times, border, triangles) = run(&points, most);
            if triangles != right {
                eprintln!("parts of {most} points give another mesh");
                return ExitCode::FAILURE;
            }
            least = std::array::from_fn(|step| least[step].min(times[step]));
            share = border;
        }
        println!("{most:>8} {:>8.1} {:>8.1} {:>8.1} {share:>7.2}%", least[0], least[1], least[2]);
    }
    ExitCode::SUCCESS
}
