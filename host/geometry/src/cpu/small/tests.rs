//! The triangulator with its own memory, against [`triangulate`].

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use incircle_testkit::SplitMix64;

use super::super::short;
use super::super::triangulate;
use super::Triangulator;
use crate::mesh::Mesh;
use crate::point::Point;

/// Compares the mesh of a used triangulator with that of a fresh one for all sets.
fn assert_like_triangulate(sets: impl IntoIterator<Item = Vec<Point>>) {
    let (mut triangulator, mut mesh) = (Triangulator::new(), Mesh::default());
    for points in sets {
        triangulator.triangulate_into(&points, &mut mesh).expect("few points");
        let expected = triangulate(points, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()));
        assert!(Ok(&mesh) == expected.as_ref(), "{} points", mesh.points.len());
    }
}

#[test]
fn tiny_sets_with_ties_lines_and_duplicates() {
    let mut random = SplitMix64::new(81);
    let count = |random: &mut SplitMix64| random.below(25) as usize;
    assert_like_triangulate((0..3000).map(|round| {
        let count = count(&mut random);
        random.points(count, 1 + round % 12)
    }));
}

#[test]
fn sets_of_all_sizes_and_widths_in_any_order() {
    let mut random = SplitMix64::new(82);
    let sizes = [300, 3, 47, 48, 49, 5000, 0, 1000, 1, 4095, 4096, 200, 2];
    let widths = [3, 8, 15, 16, 17, 24, 31, 32];
    let sets: Vec<_> = widths.iter().flat_map(|&bits| sizes.map(|size| (size, bits))).collect();
    assert_like_triangulate(sets.into_iter().map(|(size, bits)| {
        let corner = Point::new(5, 3);
        let mut set: Vec<Point> = random.points(size, 1u32.checked_shl(bits).unwrap_or(u32::MAX));
        if bits < 32 {
            set.iter_mut().for_each(|point| *point = Point::new(point.x + corner.x, point.y + corner.y));
        }
        set
    }));
}

#[test]
fn larger_sets_are_cut_into_subtrees() {
    let mut random = SplitMix64::new(83);
    let sizes = [short::MOST, short::MOST + 1, 40_000, 11_500, 100, 70_000];
    assert_like_triangulate(
        sizes
            .into_iter()
            .flat_map(|size| [10, 16, 24].map(|bits| (size, bits)))
            .map(|(size, bits)| -> Vec<Point> { random.points(size, 1 << bits) }),
    );
}

/// Words leave out bits of the position, and many points agree in the bits they have.
#[test]
fn crowds_beside_a_far_point() {
    for corner in [0, 1 << 31] {
        let crowd = (0..60 * 60).map(|k| Point::new(corner + k % 60, corner + k / 60));
        let far = Point::new(u32::MAX - corner, u32::MAX);
        assert_like_triangulate([crowd.clone().chain([far]).rev().collect(), crowd.chain([far, far]).collect()]);
    }
}
