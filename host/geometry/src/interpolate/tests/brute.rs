//! Values beside their definitions, on small sets in which ties and lines abound, and linear functions on large ones.

use alloc::vec::Vec;
use core::num::NonZeroUsize;
use core::ops::ControlFlow;

use incircle_testkit::{clipped_cell, Area, SplitMix64};

use crate::interpolate::{Error, Method, Outside, Surface};
use crate::{cpu, Mesh};

const METHODS: [Method; 3] = [Method::Linear, Method::Laplace, Method::Sibson];
const FAR: i64 = 1_000_000;

fn mesh_of(points: &[[f64; 2]]) -> Mesh<[f64; 2]> {
    cpu::triangulate(points.to_vec(), NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("a mesh")
}

fn doubles(points: &[[i64; 2]]) -> Vec<[f64; 2]> {
    points.iter().map(|&point| point.map(|value| value as f64)).collect()
}

/// A few points of a small lattice of steps of 4, with values.
fn draw(random: &mut SplitMix64) -> (Vec<[i64; 2]>, Vec<f64>) {
    let side = random.pick(&[3, 4, 6]);
    let points: Vec<[i64; 2]> =
        (0..4 + random.below(8)).map(|_| [0; 2].map(|_: i64| 4 * random.below(side) as i64)).collect();
    let values = points.iter().map(|_| random.below(100) as f64).collect();
    (points, values)
}

fn cell(points: &[[i64; 2]], index: usize) -> Vec<[i128; 3]> {
    clipped_cell(points, index, &[[-FAR, -FAR], [FAR, -FAR], [FAR, FAR], [-FAR, FAR]])
}

fn twice_area(points: &[[i64; 2]], index: usize) -> Area {
    let mut area = Area::default();
    area.add_twice(&cell(points, index), 1);
    area
}

/// The value of Sibson by its definition: the cell of the place, shared out to those from which it is taken.
fn sibson(points: &[[i64; 2]], values: &[f64], q: [i64; 2]) -> f64 {
    let with: Vec<[i64; 2]> = points.iter().copied().chain([q]).collect();
    let whole = twice_area(&with, points.len());
    let is_first = |index: &usize| !points[..*index].contains(&points[*index]);
    (0..points.len())
        .filter(is_first)
        .map(|index| {
            let taken = twice_area(points, index).minus(&twice_area(&with, index));
            taken.over(&whole) * values[index]
        })
        .sum()
}

/// The value of Laplace by its definition: the edges of the cell of the place, each by the distance of its point.
fn laplace(points: &[[i64; 2]], values: &[f64], q: [i64; 2]) -> f64 {
    let with: Vec<[i64; 2]> = points.iter().copied().chain([q]).collect();
    let ring = cell(&with, points.len());
    let (mut sum, mut weights) = (0.0, 0.0);
    for (k, from) in ring.iter().enumerate() {
        let to = ring[(k + 1) % ring.len()];
        let wide = |point: [i64; 2]| point.map(i128::from);
        let square = |place: &[i128; 3], point: [i128; 2]| {
            (0..2).map(|axis| (place[axis] - point[axis] * place[2]).pow(2)).sum::<i128>()
        };
        let is_behind = |&index: &usize| {
            let point = wide(points[index]);
            [from, &to].iter().all(|place| square(place, point) == square(place, wide(q)))
        };
        let index = (0..points.len()).find(is_behind).expect("a point behind each edge");
        let at = |place: &[i128; 3], axis: usize| place[axis] as f64 / place[2] as f64;
        let length = (at(&to, 0) - at(from, 0)).hypot(at(&to, 1) - at(from, 1));
        let distance = ((points[index][0] - q[0]) as f64).hypot((points[index][1] - q[1]) as f64);
        (sum, weights) = (sum + length / distance * values[index], weights + length / distance);
    }
    sum / weights
}

fn is_near(one: f64, other: f64) -> bool {
    (one - other).abs() < 1e-7
}

#[test]
fn values_are_those_of_the_definitions() {
    let mut random = SplitMix64::new(288);
    let (mut inside, mut outside) = (0, 0);
    for _ in 0..200 {
        let (points, mut values) = draw(&mut random);
        for index in 0..points.len() {
            // Equal points have equal values.
            let first = points.iter().position(|point| *point == points[index]).unwrap_or(index);
            values[index] = values[first];
        }
        let places = doubles(&points);
        let mesh = mesh_of(&places);
        let Ok(surface) = Surface::new(&places, &mesh.triangles, &values) else { continue };
        for _ in 0..10 {
            let q = [0; 2].map(|_: i64| random.below(22) as i64);
            let at = q.map(|value| value as f64);
            let found = METHODS.map(|method| surface.value(method, Outside::Nan, at));
            if let Some(index) = points.iter().position(|point| *point == q) {
                assert_eq!(found, [values[index]; 3]);
            } else if found[0].is_nan() {
                assert!(found.iter().all(|value| value.is_nan()));
                assert_eq!(surface.value(Method::Linear, Outside::Nearest, at), nearest(&points, &values, q));
                outside += 1;
            } else if !is_on_hull(&mesh, at) {
                assert!(is_near(found[1], laplace(&points, &values, q)), "{points:?} {values:?} {q:?}: {found:?}");
                assert!(is_near(found[2], sibson(&points, &values, q)), "{points:?} {values:?} {q:?}: {found:?}");
                inside += 1;
            } else {
                assert_eq!(found, [found[0]; 3]);
            }
        }
    }
    assert!(inside > 200 && outside > 200, "{inside} {outside}");
}

fn nearest(points: &[[i64; 2]], values: &[f64], q: [i64; 2]) -> f64 {
    let square = |point: &[i64; 2]| (point[0] - q[0]).pow(2) + (point[1] - q[1]).pow(2);
    let index = (0..points.len()).min_by_key(|&index| square(&points[index])).expect("a point");
    values[index]
}

fn is_on_hull(mesh: &Mesh<[f64; 2]>, q: [f64; 2]) -> bool {
    let hull = &mesh.hull;
    let at = |k: usize| mesh.points[hull[k % hull.len()] as usize];
    (0..hull.len()).any(|k| crate::double::orient2d(at(k), at(k + 1), q).is_eq())
}

#[test]
fn linear_functions_are_reproduced() {
    let mut random = SplitMix64::new(289);
    for bits in [10, 24, 53] {
        let unit = |random: &mut SplitMix64| random.bits(bits) as f64 / 2f64.powi(bits as i32);
        let points: Vec<[f64; 2]> = (0..3000).map(|_| [unit(&mut random), unit(&mut random)]).collect();
        let plane = |[x, y]: [f64; 2]| 3.0 + 5.0 * x - 2.0 * y;
        let values: Vec<f64> = points.iter().map(|&point| plane(point)).collect();
        let surface = Surface::new(&points, &mesh_of(&points).triangles, &values).expect("a surface");
        let places: Vec<[f64; 2]> = (0..6000).map(|_| [0; 2].map(|_: u32| 0.05 + 0.9 * unit(&mut random))).collect();
        for (method, bound) in METHODS.into_iter().zip([1e-13, 1e-11, 1e-9]) {
            let one = surface.values(method, Outside::Nan, &places, NonZeroUsize::MIN);
            let two = surface.values(method, Outside::Nan, &places, NonZeroUsize::MIN.saturating_add(2));
            let error = one.iter().zip(&places).map(|(value, &q)| (value - plane(q)).abs()).fold(0.0, f64::max);
            assert!(error < bound, "{method:?} with {bits} bits: {error}");
            let alone = surface.value(method, Outside::Nan, places[17]);
            assert_eq!(one[17].to_bits(), alone.to_bits());
            assert!(one.iter().zip(&two).all(|(one, two)| one.to_bits() == two.to_bits()));
        }
    }
}

#[test]
fn wrong_lists_are_refused_and_no_place_panics() {
    let points = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]];
    let refusal = |triangles: &[[u32; 3]], values: &[f64]| Surface::new(&points, triangles, values).err();
    assert_eq!(refusal(&[], &[0.0; 3]), Some(Error::NoTriangle));
    assert_eq!(refusal(&[[0, 1, 2]], &[0.0; 2]), Some(Error::Values { points: 3, values: 2 }));
    assert_eq!(refusal(&[[0, 1, 3]], &[0.0; 3]), Some(Error::NoSuchPoint { index: 3, points: 3 }));
    assert_eq!(refusal(&[[0, 2, 1]], &[0.0; 3]), Some(Error::NotCounterClockwise { triangle: 0 }));
    // Triangles that lie upon one another are no mesh; walks end all the same.
    let twice = Surface::new(&points, &[[0, 1, 2], [1, 2, 0]], &[1.0; 3]).expect("lists that fit");
    let far = [0.0, 2.0, -1.0, 1e300, -1e300, f64::MAX, f64::INFINITY, f64::NAN];
    for place in far.iter().flat_map(|&x| far.map(|y| [x, y])) {
        for method in METHODS {
            twice.value(method, Outside::Nan, place);
            twice.value(method, Outside::Nearest, place);
        }
    }
    let wide = [[-1e308, -1e308], [1e308, -1e308], [0.0, 1e308]];
    let surface = Surface::new(&wide, &[[0, 1, 2]], &[1.0; 3]).expect("a surface");
    for method in METHODS {
        surface.value(method, Outside::Nearest, [1.0, 2.0]);
    }
}

#[test]
fn contours_are_the_segments_of_all_triangles() {
    let mut random = SplitMix64::new(290);
    let mut closed = 0;
    for _ in 0..200 {
        let (points, values) = draw(&mut random);
        let places = doubles(&points);
        let mesh = mesh_of(&places);
        // Few values, so that corners and whole triangles lie on the level.
        let values: Vec<f64> = values.iter().map(|value| (value / 25.0).floor()).collect();
        let Ok(surface) = Surface::new(&places, &mesh.triangles, &values) else { continue };
        for level in [1.0, 1.5, 2.0] {
            let lines = surface.contours(level);
            let mut found = Vec::new();
            for line in &lines {
                closed += usize::from(line.is_closed);
                let count = line.crossings.len();
                let segments = if line.is_closed { count } else { count - 1 };
                found.extend((0..segments).map(|k| [line.crossings[k].edge, line.crossings[(k + 1) % count].edge]));
                for crossing in &line.crossings {
                    let [a, b] = crossing.edge.map(|index| values[index as usize]);
                    assert!((a + crossing.share * (b - a) - level).abs() < 1e-12);
                }
            }
            let mut expected = Vec::new();
            for &[a, b, c] in &mesh.triangles {
                let edges = [[a, b], [b, c], [c, a]];
                let above = |index: u32| values[index as usize] >= level;
                let named = |[from, to]: [u32; 2]| [from.min(to), from.max(to)];
                let down = edges.iter().find(|[from, to]| above(*from) && !above(*to));
                let up = edges.iter().find(|[from, to]| !above(*from) && above(*to));
                expected.extend(down.zip(up).map(|(down, up)| [named(*down), named(*up)]));
            }
            found.sort_unstable();
            expected.sort_unstable();
            assert_eq!(found, expected, "{points:?} {values:?} {level}");
        }
    }
    assert!(closed > 0, "no closed line");
}

#[test]
fn of_points_at_one_distance_the_lowest_index_counts() {
    // No edge joins points 0 and 1, both of which are at distance 5 from the place.
    let points = [[3, 4], [5, 0], [4, 3], [0, 5], [9, 9]];
    let places = doubles(&points);
    let mesh = mesh_of(&places);
    let surface = Surface::new(&places, &mesh.triangles, &[0.0, 1.0, 2.0, 3.0, 4.0]).expect("a surface");
    assert_eq!(surface.value(Method::Linear, Outside::Nearest, [0.0, 0.0]), 0.0);
}

/// The largest double, as values that no sum can hold.
const LARGEST: f64 = f64::MAX;

#[test]
fn means_of_the_largest_values_are_finite() {
    let mut random = SplitMix64::new(291);
    let mut checked = 0;
    for _ in 0..100 {
        let (points, _) = draw(&mut random);
        let places = doubles(&points);
        let mesh = mesh_of(&places);
        let exponent = random.pick(&[971, 960, 900, -1070]);
        let factor = crate::lattice::scaled(1.0, exponent);
        let small: Vec<f64> = places.iter().map(|[x, y]| 2f64.powi(48) * (x - y)).collect();
        let large: Vec<f64> = small.iter().map(|value| value * factor).collect();
        let limits: Vec<f64> = points.iter().map(|_| random.pick(&[LARGEST, -LARGEST, LARGEST])).collect();
        let Ok(of_small) = Surface::new(&places, &mesh.triangles, &small) else { continue };
        let of_large = Surface::new(&places, &mesh.triangles, &large).expect("a surface");
        let of_limits = Surface::new(&places, &mesh.triangles, &limits).expect("a surface");
        for _ in 0..20 {
            let q = [0; 2].map(|_: i64| random.below(80) as f64 / 4.0);
            for method in METHODS {
                let (one, other) = (of_small.value(method, Outside::Nan, q), of_large.value(method, Outside::Nan, q));
                if one.is_nan() {
                    continue;
                }
                // Differences of up to 2^53 lose nothing beside a power of two, and shares of them little.
                let scaled_back = other / factor;
                assert!(
                    (scaled_back - one).abs() <= 1e-9 * 2f64.powi(53),
                    "{method:?} {points:?} {q:?}: {one} {other}"
                );
                assert!(of_limits.value(method, Outside::Nan, q).is_finite(), "{method:?} {points:?} {limits:?} {q:?}");
                checked += 1;
            }
        }
    }
    assert!(checked > 1000, "{checked}");
    // Between the smallest and the largest double.
    let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]];
    let surface = Surface::new(&points, &[[0, 1, 2]], &[-LARGEST, LARGEST, -LARGEST]).expect("a surface");
    assert_eq!(surface.value(Method::Linear, Outside::Nan, [2.0, 0.0]), 0.0);
    let share = surface.value(Method::Linear, Outside::Nan, [3.0, 0.5]) / LARGEST;
    assert!((share - 0.5).abs() < 1e-15, "{share}");
    let line = &surface.contours(LARGEST / 2.0)[0];
    let shares: Vec<f64> = line.crossings.iter().map(|crossing| crossing.share).collect();
    let is_quarter = |share: &f64| [0.25, 0.75].iter().any(|exact| (share - exact).abs() < 1e-15);
    assert!(shares.len() == 2 && shares.iter().all(is_quarter), "{shares:?}");
    // What is not finite stays so.
    let surface = Surface::new(&points, &[[0, 1, 2]], &[f64::NAN, LARGEST, -LARGEST]).expect("a surface");
    assert!(surface.value(Method::Linear, Outside::Nan, [1.0, 1.0]).is_nan());
}
