//! Tests of walks that begin at a vertex: the table of triangles is right after every insertion, and the
//! mesh is the same.

use incircle::Point;
use incircle_model::Insertion;
use incircle_protocol::infinite_vertex;
use incircle_research::assembly::canonical;
use incircle_research::order::{BrioDc, Order};
use incircle_research::{job, GuidedMesh};
use incircle_testkit::{generate, Distribution, SplitMix64};

const CAPACITY: u32 = 256;

/// Sets of even points, of points in a small box with many duplicates, of points on a circle with large cavities, and
/// of points on the hull. The first three points span a triangle.
fn set(random: &mut SplitMix64, which: u32) -> Vec<Point> {
    let points: Vec<Point> = match which % 4 {
        0 => random.points(200, 1 << 16),
        1 => random.points(200, 12),
        2 => {
            let circle = generate(Distribution::Circle, 150, 11, which.into()).expect("a set");
            let hub = random.points::<Point>(40, 400).into_iter().map(|p| Point::new(p.x + 800, p.y + 800));
            circle.into_iter().map(Point::from).chain(hub).collect()
        }
        _ => {
            let mut points: Vec<Point> = (0..150).map(|x| Point::new(x, x * x)).collect();
            random.shuffle(&mut points);
            points
        }
    };
    [(0, 0), (1, 0), (0, 1)].map(Point::from).into_iter().chain(points).collect()
}

/// Checks that each vertex has a finite triangle with this vertex.
fn check_table(mesh: &GuidedMesh, is_vertex: &[bool]) {
    for (vertex, _) in (0..).zip(is_vertex).filter(|(_, &is_vertex)| is_vertex) {
        let triangle = mesh.triangle_of(vertex).unwrap_or_else(|| panic!("vertex {vertex} has no triangle"));
        let record = mesh.mesh().records()[triangle as usize];
        assert!(record.v.contains(&vertex), "vertex {vertex}: {record:?}");
        assert!(!record.v.contains(&infinite_vertex(CAPACITY)), "vertex {vertex}: {record:?}");
    }
}

#[test]
fn every_vertex_has_a_triangle_after_every_insertion() {
    let mut random = SplitMix64::new(31);
    let mut flips = 0;
    for trial in 0..60 {
        let points = set(&mut random, trial);
        let mut mesh = GuidedMesh::new(CAPACITY, random.pick(&[9, 32]));
        // Guides begin after any number of points.
        let unguided = random.below_u32(40);
        let mut is_vertex = Vec::new();
        for (place, &point) in (0..).zip(&points) {
            // A later point or the point itself cannot be a guide and is ignored.
            let guide = (place >= unguided).then(|| random.below_u32(place + 3));
            is_vertex.push(mesh.insert(point, guide) == Insertion::Inserted);
            if place >= 2 {
                check_table(&mesh, &is_vertex);
            }
        }
        flips += mesh.counts().flips;
        let expected = incircle::triangulate(&points).expect("a mesh");
        assert_eq!(triangles(&mesh, &points), expected.triangles, "{points:?}");
        mesh.clear();
        assert_eq!(mesh.triangle_of(0), None);
    }
    assert!(flips > 100, "{flips} flips");
}

/// The triangles of a mesh whose points arrived in the order of the input, with each corner under the lowest
/// index of its place.
fn triangles(mesh: &GuidedMesh, points: &[Point]) -> Vec<[u32; 3]> {
    let infinite = infinite_vertex(CAPACITY);
    let lowest = |vertex: u32| points.iter().position(|&point| point == points[vertex as usize]).unwrap_or(0) as u32;
    let finite = mesh.mesh().records().iter().filter(|record| !record.v.contains(&infinite));
    let mut triangles: Vec<[u32; 3]> = finite
        .map(|record| {
            let mut corners = record.v.map(lowest);
            let first = (0..3).min_by_key(|&corner| corners[corner]).unwrap_or(0);
            corners.rotate_left(first);
            corners
        })
        .collect();
    triangles.sort_unstable();
    triangles
}

/// Inserts these points with these guides, and returns the walk's visits so far.
fn insert(mesh: &mut GuidedMesh, points: &[Point], guide: Option<u32>) -> u32 {
    points.iter().for_each(|&point| {
        mesh.insert(point, guide);
    });
    mesh.counts().walk_visits
}

#[test]
fn a_far_guide_makes_walks_longer_and_a_clear_forgets_all() {
    let mut random = SplitMix64::new(33);
    let points = [(0, 0), (1, 0), (0, 1)].map(Point::from).into_iter().chain(random.points(200, 1 << 16));
    let points: Vec<Point> = points.collect();
    let mut mesh = GuidedMesh::new(CAPACITY, 32);
    let mut visits = Vec::new();
    for guide in [None, Some(0), None] {
        mesh.clear();
        // The first point lies in a corner, far from most others.
        insert(&mut mesh, &points[..100], guide);
        visits.push(insert(&mut mesh, &points[100..], guide));
    }
    assert!(visits[1] != visits[0] && visits[2] == visits[0], "{visits:?}");
}

#[test]
fn guides_shorten_walks_whatever_the_points_and_change_nothing_else() {
    let mut random = SplitMix64::new(12);
    let even: Vec<Point> = random.points(4000, 1 << 24);
    let long: Vec<Point> = random.points::<Point>(4000, 1 << 20).iter().map(|p| Point::new(p.x, p.y >> 12)).collect();
    let clusters: Vec<Point> = (0..4000u32)
        .map(|k| Point::new(k % 7 * 1_000_003 + random.below_u32(300), k % 11 * 777_777 + random.below_u32(300)))
        .collect();
    // In a thin strip and at the rims of clusters, vertices have many triangles, and a walk goes round these vertices.
    for (points, most) in [(even, 2.9), (long, 4.5), (clusters, 4.5)] {
        let walk = |order| {
            let job::Outcome { mesh, counts, .. } = job::triangulate(&points, order);
            (mesh, f64::from(counts.walk_visits) / f64::from(counts.insertions))
        };
        let (plain, guided) = (walk(Order::BRIO_HILBERT), walk(Order::BrioDc(BrioDc::Linear)));
        assert!(guided.1 < most && guided.1 < plain.1, "{} and {} triangles a walk", guided.1, plain.1);
        assert_eq!(guided.0, plain.0);
        assert_eq!(guided.0, incircle::triangulate(&points).expect("a mesh"));
    }
}

#[test]
fn every_order_gives_the_same_mesh() {
    let mut random = SplitMix64::new(35);
    for side in [6, 300, 1 << 16, 1 << 31] {
        let points: Vec<Point> = random.points(150, side);
        let expected = incircle::triangulate(&points).expect("a mesh");
        for order in Order::all() {
            assert!(job::triangulate(&points, order).mesh == expected, "{}, {points:?}", order.name());
        }
    }
    let line: Vec<Point> = (0..9).map(|k| Point::new(5 * k % 9, 5 * k % 9)).collect();
    let expected = incircle::triangulate(&line).expect("a mesh");
    assert!(Order::all().into_iter().all(|order| job::triangulate(&line, order).mesh == expected));
    assert_eq!(canonical(&[], &[], &[], Vec::new()), incircle::Mesh::default());
}

/// The counters of the product's back end when it inserts in the same order.
#[test]
fn walks_are_those_of_the_product_in_its_orders() {
    let points: Vec<Point> = SplitMix64::new(36).points(3000, 1 << 16);
    let mut device = incircle::Device::model(16, 4096).expect("possible");
    for order in incircle::Order::ALL {
        let options = incircle::Options::default().order(order);
        let solution =
            device.session().and_then(|mut session| session.triangulate_with(&points, &options)).expect("a mesh");
        let counters = solution.report.counters.expect("counters of the model");
        let counts = job::triangulate(&points, Order::named(order.name()).expect("the same names")).counts;
        let found = (counts.walk_visits, counts.tests, counts.cavity_triangles);
        assert_eq!(found, (counters.walk_visits, counters.tests, counters.cavity_triangles), "{}", order.name());
    }
}
