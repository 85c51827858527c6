//! Compares the meshes of small sets of doubles that are hostile to rounding with the definition of the mesh, in
//! integers of any size.
//!
//! The regular test compares 2,745 sets. This command, which `.ci/nightly` calls, compares 110,700 more:
//!
//! ```text
//! cargo test --release -p incircle-geometry hostile -- --include-ignored
//! ```

use std::num::NonZeroUsize;
use std::ops::{ControlFlow, Range};

use incircle_testkit::{delaunay_of_doubles, hull_of_doubles, SplitMix64};

use super::triangulator::{connect, triangulate};
use crate::plane_point::PlanePoint;

/// The value, moved up or down by a random number of units in the last place, `most` or fewer.
fn ulps(random: &mut SplitMix64, value: f64, most: u64) -> f64 {
    let count = random.below(2 * most + 1) as i64 - most as i64;
    let step = |value: f64, _| if count < 0 { value.next_down() } else { value.next_up() };
    (0..count.abs()).fold(value, step)
}

/// Every way to place hostile points.
pub(crate) const KINDS: [fn(&mut SplitMix64) -> [f64; 2]; 9] =
    [near_line, near_circle, denormal, huge, mixed, ulp_lattice, repeated, far_from_zero, thin];

/// Points near a line through the origin: each coordinate is moved by up to two units in the last place.
fn near_line(random: &mut SplitMix64) -> [f64; 2] {
    let at = random.below(9) as f64 * 0.1;
    [ulps(random, at, 2), ulps(random, at * 3.0, 2)]
}

/// Points of the unit circle, rounded, and moved by up to one unit in the last place.
fn near_circle(random: &mut SplitMix64) -> [f64; 2] {
    let angle = random.below(24) as f64 * core::f64::consts::PI / 12.0;
    [libm::cos(angle), libm::sin(angle)].map(|value| ulps(random, value, 1))
}

fn denormal(random: &mut SplitMix64) -> [f64; 2] {
    [(); 2].map(|()| (random.below(7) as f64 - 3.0) * 5e-324)
}

/// Coordinates from 1e300 to the largest double, whose differences may overflow.
fn huge(random: &mut SplitMix64) -> [f64; 2] {
    [(); 2].map(|()| {
        let value = random.pick(&[1e300, 3e305, 1e308, 1.7e308, f64::MAX]);
        let value = if value < 1.7e308 { ulps(random, value, 2) } else { value };
        if random.once_in(2) {
            -value
        } else {
            value
        }
    })
}

fn mixed(random: &mut SplitMix64) -> [f64; 2] {
    [(); 2].map(|()| (random.unit() - 0.5) * 2f64.powi(random.below(2000) as i32 - 1000))
}

/// A lattice of tenths whose points are moved by up to one unit in the last place.
fn ulp_lattice(random: &mut SplitMix64) -> [f64; 2] {
    [(); 2].map(|()| {
        let value = random.below(4) as f64 * 0.1 + 0.5;
        ulps(random, value, 1)
    })
}

/// Coordinates from a short list with both zeros, so that many points coincide.
fn repeated(random: &mut SplitMix64) -> [f64; 2] {
    [(); 2].map(|()| random.pick(&[0.0, -0.0, 0.1, -0.3, 5e-324, 1e308]))
}

/// A small lattice so far from zero that its step is the last bit.
fn far_from_zero(random: &mut SplitMix64) -> [f64; 2] {
    [(); 2].map(|()| 4e15 + random.below(5) as f64 * 0.5)
}

/// Points within some units in the last place of one vertical line.
fn thin(random: &mut SplitMix64) -> [f64; 2] {
    [ulps(random, 0.7, 2), random.unit()]
}

/// Sizes of sets that the triangulator builds without a merge, or with one.
const SMALL: Range<u64> = 4..9;
/// Sizes of sets that take merges of merges.
const MIDDLE: Range<u64> = 16..28;

/// Compares `sets_of_each` sets of each kind, whose sizes lie in the range.
fn compare(seed: u64, sets_of_each: usize, sizes: Range<u64>) {
    let mut random = SplitMix64::new(seed);
    for (kind, point) in KINDS.iter().enumerate() {
        for _ in 0..sets_of_each {
            let size = sizes.start + random.below(sizes.end - sizes.start);
            let points: Vec<[f64; 2]> = (0..size).map(|_| point(&mut random)).collect();
            check(kind, &points);
        }
    }
}

fn check(kind: usize, points: &[[f64; 2]]) {
    // `connect` works on the doubles themselves, even if they have a lattice, which `triangulate` would use.
    let numbers = <[f64; 2]>::numbers(points);
    let found = connect(&numbers, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("finite coordinates");
    assert_eq!(found.triangles, delaunay_of_doubles(points), "kind {kind}: {points:?}");
    assert_eq!(found.hull, hull_of_doubles(points), "kind {kind}: {points:?}");
    let mesh = triangulate(points.to_vec(), NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("a mesh");
    assert_eq!((&mesh.triangles, &mesh.hull), (&found.triangles, &found.hull), "kind {kind}: {points:?}");
    mesh.verify().unwrap_or_else(|error| panic!("kind {kind}: {error}: {points:?}"));
}

#[test]
fn some_hostile_sets_have_the_mesh_of_the_definition() {
    compare(81, 300, SMALL);
    compare(83, 5, MIDDLE);
}

#[test]
#[ignore = "takes a minute and a half in release builds, and longer in others"]
fn all_hostile_sets_have_the_mesh_of_the_definition() {
    compare(82, 12_000, SMALL);
    compare(84, 300, MIDDLE);
}
