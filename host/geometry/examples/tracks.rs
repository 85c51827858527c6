//! Image features that a camera tracks: they drift, appear and vanish at 30 frames a second, and each has a depth.
//! Every frame carries out the changes, and gives the mesh and the depth at places between the features.
//!
//! ```text
//! cargo run --release -p incircle-geometry --example tracks                # 4,000 features, 300 frames
//! cargo run --release -p incircle-geometry --example tracks -- 20000 100   # other numbers
//! ```
//!
//! The last lines are the median and the longest time of a frame. A frame at 30 frames a second may take 33 ms.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use incircle_geometry::living::{Error, Location};
use incircle_geometry::{orient2d, Mesh, Point, Triangulation};
use incircle_testkit::SplitMix64;

/// The size of the image in pixels. Features are found to 1/256 of a pixel, which is the step of the grid.
const IMAGE: [u32; 2] = [1920, 1080];
const STEPS: u32 = 256;
/// Of so many features one vanishes and another appears in each frame.
const LIFE: u64 = 60;
/// The longest drift of a feature in a frame, in steps of the grid.
const DRIFT: u32 = 2 * STEPS;
/// Places at which the depth is asked for in each frame.
const ASKED: usize = 2_000;

/// The depth of the scene at a feature, which a real tracker would estimate.
fn true_depth(p: Point) -> f64 {
    2.0 + f64::from(p.x) / f64::from(IMAGE[0] * STEPS) + f64::from(p.y) / f64::from(IMAGE[1] * STEPS)
}

fn random_place(random: &mut SplitMix64) -> Point {
    Point::new(random.below_u32(IMAGE[0] * STEPS), random.below_u32(IMAGE[1] * STEPS))
}

/// The features that are tracked.
struct Tracks {
    mesh: Triangulation<Point>,
    /// The depth of each living feature, by index.
    depths: BTreeMap<u32, f64>,
}

impl Tracks {
    fn appear(&mut self, place: Point) -> Result<(), Error> {
        let index = self.mesh.insert(place)?;
        self.depths.insert(index, true_depth(place));
        Ok(())
    }

    fn vanish(&mut self, index: u32) -> Result<(), Error> {
        self.depths.remove(&index);
        self.mesh.delete(index)
    }

    /// Moves all features: the depths are in the order of the indices, as `move_all` wants the places.
    fn drift(&mut self, random: &mut SplitMix64) -> Result<(), Error> {
        let indices: Vec<u32> = self.depths.keys().copied().collect();
        let old = indices.iter().filter_map(|&index| self.mesh.point(index));
        let step = |value: u32, axis: usize, random: &mut SplitMix64| {
            (value + random.below_u32(2 * DRIFT + 1)).saturating_sub(DRIFT).min(IMAGE[axis] * STEPS - 1)
        };
        let places: Vec<Point> = old.map(|p| Point::new(step(p.x, 0, random), step(p.y, 1, random))).collect();
        self.mesh.move_all(&places)?;
        self.depths.values_mut().zip(&places).for_each(|(depth, &place)| *depth = true_depth(place));
        Ok(())
    }

    /// The depth at a place: linear in each triangle; `None` outside the hull.
    fn depth(&self, place: Point) -> Option<f64> {
        let depth = |index: u32| self.depths.get(&index).copied();
        let point = |index: u32| self.mesh.point(index);
        match self.mesh.locate(place) {
            Location::Vertex(index) => depth(index),
            Location::Triangle([a, b, c]) => {
                let (p, q, r) = (point(a)?, point(b)?, point(c)?);
                let weights = [orient2d(q, r, place), orient2d(r, p, place), orient2d(p, q, place)].map(|w| w as f64);
                let sum = weights[0] * depth(a)? + weights[1] * depth(b)? + weights[2] * depth(c)?;
                Some(sum / weights.iter().sum::<f64>())
            }
            Location::Edge([a, b]) => {
                let (p, q) = (point(a)?, point(b)?);
                let along = |p: Point| f64::from(place.x.abs_diff(p.x)) + f64::from(place.y.abs_diff(p.y));
                Some((along(q) * depth(a)? + along(p) * depth(b)?) / (along(p) + along(q)))
            }
            Location::Outside(_) | Location::None => None,
        }
    }
}

/// One frame: the changes, the mesh, and the depths at some places along rows of the image.
fn frame(tracks: &mut Tracks, random: &mut SplitMix64, asked: &[Point]) -> Result<(Mesh, Vec<Option<f64>>), Error> {
    tracks.drift(random)?;
    let vanished: Vec<u32> = tracks.depths.keys().copied().filter(|_| random.once_in(LIFE)).collect();
    for index in vanished {
        tracks.vanish(index)?;
        tracks.appear(random_place(random))?;
    }
    Ok((tracks.mesh.mesh(), asked.iter().map(|&place| tracks.depth(place)).collect()))
}

fn main() -> Result<(), Error> {
    let mut arguments = std::env::args().skip(1).filter_map(|text| text.parse::<usize>().ok());
    let (features, frames) = (arguments.next().unwrap_or(4_000), arguments.next().unwrap_or(300).max(1));
    let mut random = SplitMix64::new(30);
    let mut tracks = Tracks { mesh: Triangulation::new(), depths: BTreeMap::new() };
    for _ in 0..features {
        tracks.appear(random_place(&mut random))?;
    }
    let mut asked: Vec<Point> = (0..ASKED).map(|_| random_place(&mut random)).collect();
    asked.sort_unstable_by_key(|p| (p.y / (32 * STEPS), p.x));
    let mut times: Vec<Duration> = Vec::new();
    let mut largest_error = 0f64;
    for _ in 0..frames {
        let start = Instant::now();
        let (mesh, depths) = frame(&mut tracks, &mut random, &asked)?;
        times.push(start.elapsed());
        let errors =
            asked.iter().zip(&depths).filter_map(|(&place, depth)| Some(((*depth)? - true_depth(place)).abs()));
        largest_error = errors.fold(largest_error, f64::max);
        if times.len() == frames {
            println!("{} features, {} triangles", tracks.mesh.len(), mesh.triangles.len());
        }
    }
    times.sort_unstable();
    println!("depth of a plane at {ASKED} places a frame, largest error {largest_error:.1e}");
    println!("{frames} frames: median {:.2?}, longest {:.2?}", times[frames / 2], times[frames - 1]);
    Ok(())
}
