//! Diagrams beside half planes in fractions: small sets in which ties, lines and duplicates abound.

use alloc::vec::Vec;
use core::num::NonZeroUsize;
use core::ops::ControlFlow;
use std::string::String;

use incircle_testkit::{cell_neighbors, clipped_cell, twice_area_inside, Area, Fraction, SplitMix64};

use crate::voronoi::{Cells, Clip, ClippedCell, Corner, Error, Voronoi};
use crate::{cpu, incircle, orient2d, Mesh, Point};

/// Sets of each test, or the number in the environment variable `INCIRCLE_SETS`.
pub(in crate::voronoi) fn sets() -> u64 {
    std::env::var("INCIRCLE_SETS").ok().and_then(|text| text.parse().ok()).unwrap_or(300)
}

pub(in crate::voronoi) fn mesh_of(points: &[Point]) -> Mesh<Point> {
    cpu::triangulate(points.to_vec(), NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("a mesh")
}

/// A few points of a small square, away from the origin.
pub(in crate::voronoi) fn draw(random: &mut SplitMix64) -> Vec<Point> {
    let side = random.pick(&[2, 3, 4, 5, 8]);
    let count = 1 + random.below(10);
    (0..count).map(|_| Point::new(3 + random.below_u32(side), 3 + random.below_u32(side))).collect()
}

pub(super) fn draw_corner(random: &mut SplitMix64) -> Point {
    Point::new(random.below_u32(15), random.below_u32(15))
}

pub(super) fn wide(points: &[Point]) -> Vec<[i64; 2]> {
    points.iter().map(|point| [point.x.into(), point.y.into()]).collect()
}

pub(super) fn fraction(corner: Corner) -> Fraction {
    let corner = corner.reduced();
    [corner.x, corner.y, corner.d.into()]
}

/// A ring from its smallest corner on.
fn turned(mut ring: Vec<Fraction>) -> Vec<Fraction> {
    let first = (0..ring.len()).min_by_key(|&k| ring[k]).unwrap_or(0);
    ring.rotate_left(first);
    ring
}

fn rings(cell: &ClippedCell<'_>) -> Vec<Vec<Fraction>> {
    cell.pieces().map(|piece| turned(piece.corners().map(|(corner, _)| fraction(corner)).collect())).collect()
}

fn sorted(indices: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut all: Vec<u32> = indices.collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// A square that is far larger than any cell of the small sets.
const FAR: [[i64; 2]; 4] = [[-100_000, -100_000], [100_000, -100_000], [100_000, 100_000], [-100_000, 100_000]];

#[test]
fn cells_are_those_of_half_planes() {
    let mut random = SplitMix64::new(281);
    for _ in 0..sets() {
        let points = draw(&mut random);
        let (mesh, exact) = (mesh_of(&points), wide(&points));
        let voronoi = Voronoi::of(&mesh).expect("a diagram");
        assert_eq!(voronoi.cells().count(), points.len() - mesh.duplicates.len());
        for cell in voronoi.cells() {
            let index = cell.point() as usize;
            assert_eq!(sorted(cell.neighbors().iter().copied()), cell_neighbors(&exact, index, &FAR), "{points:?}");
            let expected = clipped_cell(&exact, index, &FAR);
            let is_near = |place: &Fraction| place[0].abs() < 10_000 * place[2] && place[1].abs() < 10_000 * place[2];
            let expected: Vec<Fraction> = expected.into_iter().filter(is_near).collect();
            let found: Vec<Fraction> = cell.vertices().map(|vertex| fraction(voronoi.vertex(vertex))).collect();
            assert_eq!(turned(found), turned(expected), "cell {index} of {points:?}");
            check_edges(&voronoi, cell.point(), &points);
        }
        let places = sorted_places(&voronoi);
        assert!(places.windows(2).all(|pair| pair[0] != pair[1]), "two vertices at one place: {points:?}");
    }
}

fn sorted_places(voronoi: &Voronoi<'_>) -> Vec<Fraction> {
    let mut places: Vec<Fraction> =
        (0..voronoi.vertex_count() as u32).map(|vertex| fraction(voronoi.vertex(vertex))).collect();
    places.sort_unstable();
    places
}

/// Edges follow one another, and a cell without an end begins and ends at infinity.
fn check_edges(voronoi: &Voronoi<'_>, point: u32, points: &[Point]) {
    let cell = voronoi.cell(point).expect("a cell");
    let edges: Vec<_> = cell.edges().collect();
    for (k, edge) in edges.iter().enumerate() {
        assert_eq!(edge.to, edges[(k + 1) % edges.len()].from);
        assert!(edge.from.is_none() || edge.from != edge.to, "an edge of length zero: {points:?}");
    }
    match cell.is_unbounded() {
        true => assert!(edges.iter().all(|edge| edge.from.is_some()) == edges.is_empty()),
        false => assert_eq!(cell.neighbors().iter().min(), cell.neighbors().first()),
    }
}

#[test]
fn cells_in_rectangles_are_those_of_half_planes() {
    let mut random = SplitMix64::new(282);
    for _ in 0..sets() {
        let points = draw(&mut random);
        let Ok(clip) = Clip::rectangle(draw_corner(&mut random), draw_corner(&mut random)) else { continue };
        let (mesh, exact, corners) = (mesh_of(&points), wide(&points), wide(clip.corners()));
        let voronoi = Voronoi::of(&mesh).expect("a diagram");
        let (mut cells, mut sum) = (Cells::new(&voronoi, &clip), Area::default());
        for index in voronoi.cells().map(|cell| cell.point()) {
            let cell = cells.cell(index);
            let expected = turned(clipped_cell(&exact, index as usize, &corners));
            let expected: Vec<_> = [expected].into_iter().filter(|ring| !ring.is_empty()).collect();
            let found = rings(&cell);
            assert_eq!(found, expected, "cell {index} of {points:?} in {corners:?}");
            let inside = cell_neighbors(&exact, index as usize, &corners);
            assert_eq!(sorted(cell.neighbors()), inside, "cell {index} of {points:?} in {corners:?}");
            found.iter().for_each(|ring| sum.add_twice(ring, 1));
            check_area(&cell);
        }
        assert_eq!(sum, whole(&clip), "{points:?} in {corners:?}");
    }
}

fn whole(clip: &Clip) -> Area {
    let corners: Vec<Fraction> = clip.corners().iter().map(|&corner| fraction(Corner::of_point(corner))).collect();
    let mut area = Area::default();
    area.add_twice(&corners, 1);
    area
}

/// The area in doubles is near the exact one, which small fractions hold.
fn check_area(cell: &ClippedCell<'_>) {
    let exact: f64 = rings(cell).iter().map(|ring| shoelace(ring)).sum();
    assert!((cell.area() - exact).abs() < 1e-10, "{} {exact}", cell.area());
}

pub(super) fn shoelace(ring: &[Fraction]) -> f64 {
    let term = |(k, from): (usize, &Fraction)| {
        let to = ring[(k + 1) % ring.len()];
        (from[0] * to[1] - from[1] * to[0]) as f64 / (from[2] * to[2]) as f64 / 2.0
    };
    ring.iter().enumerate().map(term).sum()
}

#[test]
fn cells_in_polygons_have_the_areas_of_half_planes() {
    let mut random = SplitMix64::new(283);
    let mut several = 0;
    for _ in 0..sets() {
        let clip = draw_clip(&mut random);
        let points = draw(&mut random);
        let (mesh, exact, corners) = (mesh_of(&points), wide(&points), wide(clip.corners()));
        let voronoi = Voronoi::of(&mesh).expect("a diagram");
        let (mut cells, mut sum) = (Cells::new(&voronoi, &clip), Area::default());
        for index in voronoi.cells().map(|cell| cell.point()) {
            let cell = cells.cell(index);
            let (found, mut area) = (rings(&cell), Area::default());
            found.iter().for_each(|ring| area.add_twice(ring, 1));
            found.iter().for_each(|ring| sum.add_twice(ring, 1));
            let expected = twice_area_inside(&exact, index as usize, &corners);
            assert_eq!(area, expected, "cell {index} of {points:?} in {corners:?}: {found:?}");
            found.iter().for_each(|ring| check_ring(ring));
            several += usize::from(found.len() > 1);
        }
        assert_eq!(sum, whole(&clip), "{points:?} in {corners:?}");
    }
    assert!(several > 0, "no cell in several pieces");
}

/// A ring turns left in all and visits no place twice.
fn check_ring(ring: &[Fraction]) {
    let mut places = ring.to_vec();
    places.sort_unstable();
    places.dedup();
    assert_eq!(places.len(), ring.len(), "{ring:?}");
    assert!(ring.len() > 2 && shoelace(ring) > 0.0, "{ring:?}");
}

/// A ring of random corners that is simple.
pub(in crate::voronoi) fn draw_clip(random: &mut SplitMix64) -> Clip {
    loop {
        let count = 3 + random.below(6);
        let ring: Vec<Point> = (0..count).map(|_| draw_corner(random)).collect();
        if let Ok(clip) = Clip::polygon(&ring) {
            return clip;
        }
    }
}

#[test]
fn rings_that_cross_are_refused() {
    let mut random = SplitMix64::new(284);
    for _ in 0..sets() {
        let count = 3 + random.below(4) as usize;
        let ring: Vec<Point> = (0..count).map(|_| draw_corner(&mut random)).collect();
        let is_on = |[a, b]: [Point; 2], c: Point| {
            orient2d(a, b, c) == 0 && (a.x.min(b.x)..=a.x.max(b.x)).contains(&c.x) && {
                (a.y.min(b.y)..=a.y.max(b.y)).contains(&c.y)
            }
        };
        let edge = |k: usize| [ring[k], ring[(k + 1) % count]];
        let mut is_simple = (0..count).all(|k| edge(k)[0] != edge(k)[1]);
        let mut first = (count, count);
        for (one, other) in (0..count).flat_map(|one| (0..one).map(move |other| (one, other))) {
            let ([a, b], [c, d]) = (edge(one), edge(other));
            let side = |a, b, c| orient2d(a, b, c).signum();
            let crosses = side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
            let touches = [c, d].into_iter().filter(|&end| is_on([a, b], end)).count()
                + [a, b].into_iter().filter(|&end| is_on([c, d], end)).count();
            // Consecutive edges have their common corner, which counts once for each.
            let is_consecutive = one - other == 1 || one - other == count - 1;
            if crosses || touches != if is_consecutive { 2 } else { 0 } {
                is_simple = false;
                first = first.min((other, one));
            }
        }
        let found = Clip::polygon(&ring);
        if (0..count).all(|k| edge(k)[0] != edge(k)[1]) {
            assert_eq!(found.is_ok(), is_simple, "{ring:?}: {found:?}");
            if let Err(Error::CrossedClip { one, other }) = found {
                assert_eq!((one, other), first, "the first edge that meets another, and the first of these: {ring:?}");
            }
        }
    }
}

/// Another triangulation of the same set: diagonals of points on one circle are exchanged by chance.
fn flipped(mesh: &Mesh<Point>, random: &mut SplitMix64) -> Mesh<Point> {
    let mut triangles = mesh.triangles.clone();
    for _ in 0..20 {
        let view = Mesh::new(mesh.points.clone(), triangles.clone(), Vec::new(), Vec::new());
        let twins = view.halfedges();
        let halfedge = random.below(twins.len().max(1) as u64) as usize;
        let Some(twin) = twins.get(halfedge).map(|&twin| twin as usize).filter(|&twin| twin < twins.len()) else {
            continue;
        };
        let at = |halfedge: usize, k: usize| triangles[halfedge / 3][(halfedge % 3 + k) % 3];
        let [a, b, c] = [0, 1, 2].map(|k| at(halfedge, k));
        let d = at(twin, 2);
        let place = |index: u32| mesh.points[index as usize];
        if incircle(place(a), place(b), place(c), place(d)) == 0 {
            triangles[halfedge / 3] = [a, d, c];
            triangles[twin / 3] = [d, b, c];
        }
    }
    Mesh::new(mesh.points.clone(), triangles, mesh.hull.clone(), mesh.duplicates.clone())
}

#[test]
fn ties_leave_no_trace() {
    let mut random = SplitMix64::new(285);
    for _ in 0..sets() {
        let mesh = mesh_of(&draw(&mut random));
        let other = flipped(&mesh, &mut random);
        let (one, other) = (Voronoi::of(&mesh).expect("a diagram"), Voronoi::of(&other).expect("a diagram"));
        assert_eq!(one.vertex_count(), other.vertex_count());
        for (cell, same) in one.cells().zip(other.cells()) {
            assert_eq!(cell.neighbors(), same.neighbors(), "{:?}", mesh.points);
            let places = |voronoi: &Voronoi<'_>, vertices: &mut dyn Iterator<Item = u32>| -> Vec<Fraction> {
                vertices.map(|vertex| fraction(voronoi.vertex(vertex))).collect()
            };
            assert_eq!(places(&one, &mut cell.vertices()), places(&other, &mut same.vertices()));
            assert_eq!(cell.is_unbounded(), same.is_unbounded());
        }
    }
}

#[test]
fn wrong_meshes_and_clips_are_refused_in_a_sentence() {
    let points: Vec<Point> = [(0, 0), (4, 0), (4, 4)].map(Point::from).to_vec();
    let refusal = |triangles: &[[u32; 3]]| -> String {
        let mesh = Mesh::new(points.clone(), triangles.to_vec(), Vec::new(), Vec::new());
        Voronoi::of(&mesh).map_or_else(|error| std::format!("{error}"), |_| String::new())
    };
    assert!(refusal(&[[0, 1, 3]]).contains("names point 3, but has 3 points"));
    assert!(refusal(&[[0, 2, 1]]).contains("triangle 0 of the mesh is not counter-clockwise"));
    // Lists that are no mesh give a diagram without meaning.
    assert_eq!(refusal(&[[0, 1, 2], [0, 1, 2]]), "");
    let wide = Mesh::new(Vec::from([Point::new(1 << 31, 0)]), Vec::new(), Vec::new(), Vec::new());
    assert!(matches!(Voronoi::of(&wide), Err(Error::CoordinateOutOfRange { index: 0, .. })));
    let ring = |corners: &[(u32, u32)]| Clip::polygon(&corners.iter().copied().map(Point::from).collect::<Vec<_>>());
    assert_eq!(ring(&[(0, 0), (4, 4)]).err(), Some(Error::EmptyClip));
    assert_eq!(ring(&[(0, 0), (4, 4), (4, 0), (0, 4)]).err(), Some(Error::CrossedClip { one: 0, other: 2 }));
    assert_eq!(ring(&[(0, 0), (0, 4), (4, 4), (4, 0), (0, 0)]).expect("a square").twice_area(), 32);
    assert_eq!(Clip::rectangle(Point::new(1, 2), Point::new(1, 9)).err(), Some(Error::EmptyClip));
}

#[test]
fn the_whole_grid_is_not_too_large() {
    const MAX: u32 = (1 << 31) - 1;
    let mut random = SplitMix64::new(286);
    let side = |random: &mut SplitMix64| match random.below(3) {
        0 => random.below_u32(3),
        1 => MAX - random.below_u32(3),
        _ => random.below_u32(MAX),
    };
    for _ in 0..sets() / 10 {
        let points: Vec<Point> = (0..8).map(|_| Point::new(side(&mut random), side(&mut random))).collect();
        let ring: Vec<Point> = (0..5).map(|_| Point::new(side(&mut random), side(&mut random))).collect();
        let mesh = mesh_of(&points);
        let voronoi = Voronoi::of(&mesh).expect("a diagram");
        let square = Clip::rectangle(Point::new(0, 0), Point::new(MAX, MAX)).expect("a square");
        for clip in [square].into_iter().chain(Clip::polygon(&ring).ok()) {
            let mut cells = Cells::new(&voronoi, &clip);
            let (mut sum, mut exact) = (0.0, Area::default());
            for index in 0..points.len() as u32 {
                let cell = cells.cell(index);
                rings(&cell).iter().for_each(|ring| exact.add_twice(ring, 1));
                sum += cell.area();
            }
            assert_eq!(exact, whole(&clip), "{points:?} {ring:?}");
            let expected = clip.twice_area() as f64 / 2.0;
            assert!((sum - expected).abs() < 1e-9 * (MAX as f64).powi(2), "{sum} {expected}");
        }
    }
}
