//! Published inputs on which triangulators with rounded predicates fail. Each test cites its source.
#![allow(clippy::excessive_precision)] // the digits are those of the sources

use std::cmp::Ordering;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use incircle_testkit::{delaunay_of_doubles, hull_of_doubles, orient2d_of_doubles};

use super::triangulator::{connect, triangulate};
use crate::double::{incircle, orient2d};
use crate::plane_point::PlanePoint;

/// The most points of a set that is also compared with the slow definition of the mesh.
const FEW: usize = 20;

fn check(name: &str, points: &[[f64; 2]]) {
    let mesh = triangulate(points.to_vec(), NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("a mesh");
    mesh.verify().unwrap_or_else(|error| panic!("{name}: {error}"));
    let numbers = <[f64; 2]>::numbers(points);
    let found = connect(&numbers, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("finite coordinates");
    assert!((&found.triangles, &found.hull) == (&mesh.triangles, &mesh.hull), "{name}");
    if points.len() <= FEW {
        assert_eq!(mesh.triangles, delaunay_of_doubles(points), "{name}");
        assert_eq!(mesh.hull, hull_of_doubles(points), "{name}");
    }
}

/// The pairs of numbers of a JSON list of points.
fn pairs(json: &str) -> Vec<[f64; 2]> {
    let is_separator = |c: char| c.is_whitespace() || "[],".contains(c);
    let words = json.split(is_separator).filter(|word| !word.is_empty());
    let values: Vec<f64> = words.map(|word| word.parse().expect("a number")).collect();
    values.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// The fixtures of delaunator; `testbench/data/README.md` names their source and licence.
#[test]
fn fixtures_of_delaunator_have_the_canonical_mesh() {
    macro_rules! fixture {
        ($name:literal, $points:literal) => {
            let points = pairs(include_str!(concat!("../../../../testbench/data/delaunator/", $name, ".json")));
            assert_eq!(points.len(), $points, $name);
            check($name, &points);
        };
    }
    fixture!("robustness1", 79);
    fixture!("robustness2", 1000);
    fixture!("robustness3", 70);
    fixture!("robustness4", 36);
    fixture!("issue13", 17);
    fixture!("issue43", 5);
}

/// Coordinates from the reports 94 of mapbox/delaunator, 109 of Stoeoef/spade and 8 of ironwallaby/delaunay on GitHub.
#[test]
fn reported_points_have_the_mesh_of_the_definition() {
    let near_duplicates = [
        [0.0, 0.0],
        [0.05626429153399996, 0.0],
        [0.024093852080076722, 4.80267923973791e-18],
        [0.01379050745122589, 0.1463775332929564],
        [0.05177587092034522, 0.015468457826306506],
        [0.024093852080076705, -5.204170927430921e-18],
    ];
    check("delaunator 94", &near_duplicates);
    let contacts: [[f32; 2]; 8] = [
        [17.064112, -17.96008],
        [16.249594, -17.145563],
        [-25.290726, -24.435482],
        [-5.6608872, -24.435482],
        [17.878626, -18.774595],
        [15.435078, -16.331045],
        [16.331045, -21.951208],
        [-3.29879, -24.435482],
    ];
    check("spade 109", &contacts.map(|point| point.map(f64::from)));
    let degrees = [
        [50.726723, 7.057675],
        [50.726886, 7.056291],
        [50.727253, 7.05776],
        [50.727518, 7.056366],
        [50.727885, 7.057632],
    ];
    check("ironwallaby 8", &degrees);
}

/// The three grids of L. Kettner, K. Mehlhorn, S. Pion, S. Schirra and C. Yap, "Classroom examples of robustness
/// problems in geometric computations", Computational Geometry 40 (2008), section 3: a point takes 256 by 256 places,
/// one unit in the last place apart, near the line through two other points.
#[test]
fn the_classroom_grids_have_exact_signs_and_meshes() {
    let grids = [
        ([[0.5, 0.5], [12.0, 12.0], [24.0, 24.0]], Some(256)),
        ([[0.5, 0.5], [8.800_000_000_000_000_7; 2], [12.1; 2]], Some(256)),
        (
            [
                [0.500_000_000_000_025_31, 0.500_000_000_000_017_1],
                [17.300_000_000_000_001; 2],
                [24.000_000_000_000_05, 24.000_000_000_000_051_776_5],
            ],
            None,
        ),
    ];
    for ([start, q, r], expected) in grids {
        // Units in the last place of doubles from 0.5 to 1, so that all 65,536 places are doubles.
        let at = |i: u32, j: u32| [start[0] + f64::from(i) * 2f64.powi(-53), start[1] + f64::from(j) * 2f64.powi(-53)];
        let mut on_line = 0;
        for (i, j) in (0..256).flat_map(|i| (0..256).map(move |j| (i, j))) {
            let p = at(i, j);
            let side = orient2d(p, q, r);
            assert_eq!(side, orient2d_of_doubles(p, q, r), "{p:?}");
            on_line += usize::from(side == Ordering::Equal);
            if i % 16 == 0 && j % 16 < 2 {
                check("classroom", &[p, q, r, at(j, i), at(0, 1)]);
            }
        }
        // Places with equal coordinates lie on a line through the origin with slope 1.
        assert!(expected.is_none_or(|expected| expected == on_line), "{on_line}");
    }
}

/// The points of section 4 of the same work, for which rounded predicates make a convex hull fail: a point outside sees
/// no edge (A1), a point inside sees an edge (A2), a point outside sees all edges (B1).
#[test]
fn the_classroom_hulls_are_right() {
    let sees_none = [
        [7.300_000_000_000_019_4, 7.300_000_000_000_016_7],
        [24.000_000_000_000_068, 24.000_000_000_000_071],
        [24.000_000_000_000_05, 24.000_000_000_000_053],
        [0.500_000_000_000_016_21, 0.500_000_000_000_012_43],
        [8.0, 4.0],
        [4.0, 9.0],
        [15.0, 27.0],
        [26.0, 25.0],
        [19.0, 11.0],
    ];
    let inside_sees = [
        [27.643_564_356_435_643, -21.881_188_118_811_881],
        [83.366_336_633_663_366, 15.544_554_455_445_542],
        [4.0, 4.0],
        [73.415_841_584_158_414, 8.861_386_138_613_859_5],
    ];
    let sees_all = [
        [200.0, 49.200_000_000_000_003],
        [100.0, 49.600_000_000_000_001],
        [-233.333_333_333_333_34, 50.933_333_333_333_33],
        [166.666_666_666_666_69, 49.333_333_333_333_336],
    ];
    for (name, points) in [("A1", &sees_none[..]), ("A2", &inside_sees), ("B1", &sees_all)] {
        for count in 3..=points.len() {
            check(name, &points[..count]);
        }
    }
}

/// The four points of report 48 of georust/robust on GitHub, nearly on the unit circle, and the signs that exact
/// arithmetic gives: a term that was left out there gave the opposite ones.
#[test]
fn reported_circles_have_exact_signs_and_meshes() {
    let outside = [
        [2.104_554_160_052_428_8e-15, -1.000_000_000_000_001_6],
        [1.000_000_000_000_005, -3.350_874_324_301_223e-16],
        [7.553_997_323_229_233e-15, 0.999_999_999_999_995_8],
        [-0.999_999_999_999_992_2, -7.073_397_829_693_697e-15],
    ];
    let inside = [
        [9.128_561_612_013_288e-15, -1.000_000_000_000_002_9],
        [1.000_000_000_000_004_4, -5.451_395_142_523_081e-15],
        [3.851_214_418_148_064e-15, 0.999_999_999_999_996_1],
        [-0.999_999_999_999_994_6, -6.679_796_034_108_508_4e-15],
    ];
    for (points, sign) in [(outside, Ordering::Less), (inside, Ordering::Greater)] {
        let [a, b, c, d] = points;
        assert_eq!(incircle(a, b, c, d), sign);
        check("robust 48", &points);
    }
}

/// The grid beside a line, and the circles of all sizes, with which mourner/robust-predicates on GitHub tests its
/// predicates.
#[test]
fn circles_of_all_sizes_and_places_beside_a_line_have_exact_signs() {
    let step = 2f64.powi(-43) / 128.0;
    for (i, j) in (0..128).flat_map(|i| (0..128).map(move |j| (i, j))) {
        let p = [0.95 + step * f64::from(i), 0.95 + step * f64::from(j)];
        assert_eq!(orient2d(p, [18.0; 2], [16.8; 2]), orient2d_of_doubles(p, [18.0; 2], [16.8; 2]), "{p:?}");
    }
    let mut x = 1e-64;
    for _ in 0..128 {
        // The three points turn left, so that `Greater` is inside.
        let [a, b, c] = [[0.0, x], [-x, -x], [x, -x]];
        assert_eq!(incircle(a, b, c, [0.0, 0.0]), Ordering::Greater, "{x}");
        assert_eq!(incircle(a, b, c, [0.0, 2.0 * x]), Ordering::Less, "{x}");
        assert_eq!(incircle(a, b, c, a), Ordering::Equal, "{x}");
        check("circle", &[a, b, c, [0.0, 0.0], [0.0, 2.0 * x]]);
        x *= 10.0;
    }
}
