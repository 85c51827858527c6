//! Measures tiles of evenly spread points: the time that tiles add to a triangulation, and the share of points that
//! joins see again.
//!
//! ```text
//! cargo bench -p incircle-geometry --bench tiles                      # a million points of 31 bits, 9 runs
//! cargo bench -p incircle-geometry --bench tiles -- 100000 5          # other numbers of points and runs
//! ```
//!
//! The first table has a row for each size of tile:
//! - `border`: the points in the borders of all tiles, in per cent of all points.
//! - `unknown`: triangles whose disc the test could not judge.
//! - `joined`: the points that all joins triangulate, in per cent of all points.
//! - `local`: the time of `tiles::local`, in ns a triangle, on the meshes of all tiles.
//! - `tiles`, `at once`: `tiles::triangulate` and `cpu::triangulate` on one thread, in ns a point, and their ratio.
//!
//! Times are the least of all runs, and the ratio is the median over pairs of runs in turns.
//!
//! Then follows the time of `tiles::reach` alone, in ns a triangle, for triangles in memory one after another: those of
//! all tiles of 8,192 points, and two kinds whose discs touch a side, for which the filter cannot tell.

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::process::ExitCode;
use std::time::Instant;

use incircle_geometry::order::z_curve::position;
use incircle_geometry::tiles::{self, Region, Step, TilePoint, Tree};
use incircle_geometry::{cpu, Mesh, Point};
use incircle_testkit::{generate, Distribution};

/// The numbers of points and of runs if the arguments name none.
const POINTS: usize = 1_000_000;
const RUNS: usize = 9;
const BITS: u32 = 31;
/// The most points of a tile in each row.
const MOST: [usize; 5] = [2_048, 8_192, 32_768, 131_072, 524_288];

fn mesh_of(points: Vec<Point>) -> Mesh {
    cpu::triangulate(points, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("few enough points")
}

fn most(points: usize) -> NonZeroUsize {
    NonZeroUsize::new(points).unwrap_or(NonZeroUsize::MIN)
}

/// The tree of a set, and its points along the curve.
fn cut(points: &[Point], limit: usize) -> (Tree, Vec<Point>) {
    let mut curve: Vec<(u64, Point)> = points.iter().map(|&point| (position(point.x, point.y), point)).collect();
    curve.sort_unstable();
    let (positions, points): (Vec<u64>, Vec<Point>) = curve.into_iter().unzip();
    (Tree::of_positions(&positions, most(limit)), points)
}

/// The meshes of all tiles, with ids and regions.
fn local_meshes(tree: &Tree, curve: &[Point]) -> Vec<(Mesh, Vec<u32>, Region)> {
    let tiles = tree.tiles().map(|(region, range)| {
        let ids = (0..).zip(&curve[range.clone()]).map(|(id, _): (u32, _)| id + range.start as u32).collect();
        (mesh_of(curve[range].to_vec()), ids, region)
    });
    tiles.collect()
}

fn timed<T>(run: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    black_box(run());
    start.elapsed().as_secs_f64()
}

/// The least of the seconds that some runs take: other work on the machine only adds to a time.
fn seconds<T>(runs: usize, mut run: impl FnMut() -> T) -> f64 {
    (0..runs).map(|_| timed(&mut run)).fold(f64::INFINITY, f64::min)
}

/// The least seconds of two calls that take turns, and the median of the ratios within a turn, which other work
/// disturbs less.
fn by_turns<T, U>(runs: usize, mut one: impl FnMut() -> T, mut other: impl FnMut() -> U) -> [f64; 3] {
    let (mut least, mut ratios) = ([f64::INFINITY; 2], Vec::new());
    for _ in 0..runs {
        let times = [timed(&mut one), timed(&mut other)];
        ratios.push(times[1] / times[0]);
        least = [least[0].min(times[0]), least[1].min(times[1])];
    }
    ratios.sort_by(f64::total_cmp);
    [least[0], least[1], ratios.get(runs / 2).copied().unwrap_or(f64::NAN)]
}

/// The numbers of points in the borders of tiles and in all joins, and of triangles that could not be judged.
fn count(tree: &Tree, meshes: &[(Mesh, Vec<u32>, Region)]) -> Result<[usize; 3], tiles::Error> {
    let [mut in_borders, mut joined, mut unknown] = [0; 3];
    let mut meshes = meshes.iter();
    let mut stack = Vec::new();
    for step in tree.steps() {
        let tile = match step {
            Step::Tile { .. } => {
                let Some((mesh, ids, region)) = meshes.next() else { continue };
                let tile = tiles::local(mesh, ids, *region)?;
                in_borders += tile.border.points.len();
                tile
            }
            Step::Join { region, children } => {
                let borders: Vec<_> = stack.split_off(stack.len() - children);
                joined += borders.iter().map(|border: &tiles::Border<Point, u32>| border.points.len()).sum::<usize>();
                tiles::join(*region, borders)?
            }
        };
        unknown += tile.unknown;
        stack.push(tile.border);
    }
    Ok([in_borders, joined, unknown])
}

fn measure(points: &[Point], limit: usize, runs: usize, expected: &Mesh) -> Result<String, Box<dyn std::error::Error>> {
    let (tree, curve) = cut(points, limit);
    let meshes = local_meshes(&tree, &curve);
    let [in_borders, joined, unknown] = count(&tree, &meshes)?;
    let triangles: usize = meshes.iter().map(|(mesh, ..)| mesh.triangles.len()).sum();
    let all = || meshes.iter().map(|(mesh, ids, region)| tiles::local(mesh, ids, *region)).collect::<Vec<_>>();
    let local = 1e9 * seconds(runs, all) / triangles as f64;
    let n = points.len() as f64;
    let by_tiles = || tiles::triangulate(points.to_vec(), most(limit));
    let [at_once, by_tiles, ratio] = by_turns(runs, || mesh_of(points.to_vec()), by_tiles);
    let [at_once, by_tiles] = [at_once, by_tiles].map(|seconds| 1e9 * seconds / n);
    if tiles::triangulate(points.to_vec(), most(limit))? != *expected {
        return Err(format!("tiles of {limit} points give another mesh").into());
    }
    let share = |count: usize| 100.0 * count as f64 / n;
    Ok(format!(
        "{limit:>8}{:>8}{:>9.2} %{unknown:>9}{:>9.2} %{local:>9.1}{by_tiles:>9.1}{at_once:>9.1}{ratio:>8.2}",
        meshes.len(),
        share(in_borders),
        share(joined)
    ))
}

/// Triangles and the region that each is asked about.
type Questions = Vec<(Region, Vec<[Point; 3]>)>;

/// The questions of all tiles of a set.
fn questions(points: &[Point]) -> Questions {
    let (tree, curve) = cut(points, 8_192);
    let meshes = local_meshes(&tree, &curve);
    let corners = |mesh: &Mesh| mesh.triangles.iter().map(|t| t.map(|place| mesh.points[place as usize])).collect();
    meshes.iter().map(|(mesh, _, region)| (*region, corners(mesh))).collect()
}

/// Halves of rectangles of 14 by 48 steps, whose discs touch the east side of the region.
fn touching(step: u32) -> Questions {
    let east = (1 << 31) - 1;
    let half = |k: u32| {
        // The circle has a radius of 25 steps, so it ends 18 steps east of the rectangle.
        let (x, y) = (east - (14 + 18) * step, (k % 64) * step);
        [(x, y), (x + 14 * step, y), (x, y + 48 * step)].map(Point::from)
    };
    vec![(Region { east: Some(east.into()), ..Region::WHOLE }, (0..100_000).map(half).collect())]
}

fn ask(questions: &Questions, runs: usize) -> f64 {
    let count: usize = questions.iter().map(|(_, triangles)| triangles.len()).sum();
    let within = |(region, triangles): &(Region, Vec<[Point; 3]>)| {
        let sides = Point::sides(region);
        triangles.iter().filter(|&&corners| Point::reach(&sides, corners) == tiles::Reach::Within).count()
    };
    1e9 * seconds(runs, || questions.iter().map(within).sum::<usize>()) / count as f64
}

fn run() -> Result<(), Box<dyn std::error::Error>> {
    // Cargo adds the option `--bench`, which is no number.
    let mut numbers = std::env::args().skip(1).filter_map(|word| word.parse().ok());
    let (count, runs) = (numbers.next().unwrap_or(POINTS), numbers.next().unwrap_or(RUNS));
    let points: Vec<Point> = generate(Distribution::Uniform, count, BITS, 31)?.into_iter().map(Point::from).collect();
    let expected = mesh_of(points.clone());
    println!("{count} points, {runs} runs");
    let times = format!("{:>9}{:>9}{:>9}{:>8}", "local", "tiles", "at once", "ratio");
    println!("{:>8}{:>8}{:>11}{:>9}{:>11}{times}", "most", "tiles", "border", "unknown", "joined");
    for limit in MOST {
        println!("{}", measure(&points, limit, runs, &expected)?);
    }
    println!("\nns a triangle of reach: {:.1}", ask(&questions(&points), runs));
    println!("the same where the disc touches a side: {:.1}", ask(&touching(1), runs));
    println!("the same for products of more than 128 bits: {:.1}", ask(&touching(1 << 24), runs));
    Ok(())
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
