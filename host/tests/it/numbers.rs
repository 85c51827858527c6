//! Points in all numbers that people have: each type is triangulated exactly as it is, on the back ends
//! that can hold it.

use std::fmt::Debug;

use geo_types::Coord;
use incircle::{Device, Error, ErrorKind, Options, PlanePoint, Point, Step};
use incircle_testkit::{delaunay_of_doubles, SplitMix64};

#[test]
fn all_types_of_points_at_the_same_places_have_one_mesh() {
    let raw = [[0, 0], [40, 0], [40, 40], [0, 40], [13, 27], [40, 0]];
    let expected = incircle::triangulate(&raw.map(|[x, y]| Point::new(x, y))).expect("a mesh");
    let lists = |triangles: Vec<[u32; 3]>, hull: Vec<u32>, duplicates: usize| {
        assert_eq!((triangles, hull, duplicates), (expected.triangles.clone(), expected.hull.clone(), 1));
    };
    macro_rules! compare {
        ($($points:expr),*) => {$(
            let mesh = incircle::triangulate(&$points).expect("a mesh");
            mesh.verify().expect("the canonical mesh");
            lists(mesh.triangles, mesh.hull, mesh.duplicates.len());
        )*};
    }
    compare!(
        raw.map(|[x, y]| (x, y)),
        raw.map(|[x, y]| [x as i32 - 20, y as i32 - 7]),
        raw.map(|[x, y]| (i64::from(x) << 57, i64::from(y) << 57)),
        raw.map(|[x, y]| [x as f32 / 8.0, y as f32 / 8.0]),
        raw.map(|[x, y]| [f64::from(x) * 1e300, f64::from(y) * 1e300]),
        raw.map(|[x, y]| (f64::from(x) - 0.5, f64::from(y) + 1e9)),
        raw.map(|[x, y]| glam::IVec2::new(x as i32 - 5, y as i32)),
        raw.map(|[x, y]| glam::Vec2::new(x as f32, y as f32)),
        raw.map(|[x, y]| glam::DVec2::new(f64::from(x), f64::from(y)))
    );
}

/// Checks that points of a type have the mesh of the pairs with the same coordinates. `high` and `almost_high` are
/// neighbours among the numbers of the type, so rounding would make them equal.
fn has_the_mesh_of_pairs<N: Copy, P: PlanePoint + Debug + PartialEq>(
    [low, almost_high, high]: [N; 3],
    point: impl Fn(N, N) -> P,
) where
    (N, N): PlanePoint,
{
    let pairs = [(low, high), (high, low), (almost_high, low), (high, high), (high, almost_high), (low, almost_high)];
    let expected = incircle::triangulate(&pairs).expect("a mesh");
    let points = pairs.map(|(x, y)| point(x, y));
    let mesh = incircle::triangulate(&points).expect("a mesh");
    mesh.verify().expect("the canonical mesh");
    assert_eq!(mesh.points, points);
    assert_eq!((mesh.triangles, mesh.hull), (expected.triangles, expected.hull));
    assert_eq!((mesh.duplicates, expected.duplicates), (vec![], vec![]));
}

#[test]
fn types_of_geo_types_are_taken_as_they_are() {
    macro_rules! compare {
        ($($numbers:expr),*) => {$(
            has_the_mesh_of_pairs($numbers, geo_types::Point::new);
            has_the_mesh_of_pairs($numbers, |x, y| Coord { x, y });
        )*};
    }
    compare!(
        [0, u32::MAX - 1, u32::MAX],
        [i32::MIN, i32::MAX - 1, i32::MAX],
        [i64::MIN, i64::MAX - 1, i64::MAX],
        [-0.1f32, 0.7f32.next_down(), 0.7],
        [-0.1f64, 0.7f64.next_down(), 0.7]
    );
}

#[test]
fn the_report_names_the_lattice() {
    let mut device = Device::cpu(None);
    let mut session = device.session().expect("a session");
    let lattice =
        session.triangulate(&[[-363.0, 4.5], [0.25, 7.0]]).expect("a mesh").report.lattice.expect("a lattice");
    assert_eq!((lattice.step, lattice.offset, lattice.bits), (Step::Binary { exponent: -2 }, [-1452, 18], 11));
    let lattice = session.triangulate(&[(-7, 3), (5, 3)]).expect("a mesh").report.lattice.expect("a lattice");
    assert_eq!((lattice.step, lattice.offset, lattice.bits), (Step::Whole, [-7, 3], 4));
    assert_eq!(session.triangulate(&[[0.1, 0.2], [0.3, 0.4]]).expect("a mesh").report.lattice, None);
}

#[test]
fn a_core_takes_what_its_lattice_holds_and_names_what_it_does_not() {
    let mut device = Device::open("clock?config=small").expect("the model of a core");
    let mut session = device.session().expect("a session");
    let mut random = SplitMix64::new(51);
    let value = |random: &mut SplitMix64| random.below(1 << 16) as f64 / 16.0 - 2000.0;
    let points: Vec<[f64; 2]> = (0..300).map(|_| [value(&mut random), value(&mut random)]).collect();
    let found = session.triangulate(&points).expect("16 bits");
    assert_eq!(found.mesh, incircle::triangulate(&points).expect("a mesh"));
    assert_eq!(found.mesh.points, points);

    let wide = session.triangulate(&[[0.0, 0.5], [70_000.0, 1.0]]).expect_err("18 bits");
    assert!(matches!(&wide, Error::LatticeTooWide { lattice, coord_bits: 16, .. } if lattice.bits == 18), "{wide}");
    assert_eq!(wide.kind(), ErrorKind::BadInput);
    let none = session.triangulate(&[[0.1, 0.5], [0.7, 1.0]]).expect_err("no lattice");
    assert!(matches!(none, Error::NoLattice { coord_bits: 16, .. }), "{none}");
    let infinite = session.triangulate(&[[0.0, f64::NAN]]).expect_err("not a number");
    assert!(matches!(infinite, Error::NotFinite { index: 0, axis: 'y', .. }), "{infinite}");
    assert!(session.triangulate(&points).is_ok());
}

#[test]
fn a_batch_mixes_sets_with_and_without_a_lattice() {
    let mut random = SplitMix64::new(52);
    let jobs: Vec<Vec<[f64; 2]>> = (0..30)
        .map(|job| {
            let step = if job % 3 == 0 { 0.1 } else { 0.125 };
            (0..8).map(|_| [(); 2].map(|()| random.below(6) as f64 * step)).collect()
        })
        .collect();
    for address in ["cpu", "cpu?threads=1"] {
        let mut device = Device::open(address).expect("the CPU triangulator");
        let mut session = device.session().expect("a session");
        let solutions = session.triangulate_batch(&jobs, &Options::default()).expect("all jobs");
        assert_eq!(solutions.len(), jobs.len());
        for (solution, points) in solutions.iter().zip(&jobs) {
            assert_eq!(solution.mesh.triangles, delaunay_of_doubles(points), "{points:?}");
            assert_eq!(&solution.mesh.points, points);
        }
    }
    let mut device = Device::open("model").expect("the model");
    let mut session = device.session().expect("a session");
    let error = session.triangulate_batch(&jobs, &Options::default()).expect_err("tenths");
    assert!(
        matches!(&error, Error::InJob { job: 0, source } if matches!(**source, Error::NoLattice { .. })),
        "{error}"
    );
}
