//! Frames in which all points move: lattices that lose their ties, duplicates that meet and part, triangles that turn
//! over, and steps of all lengths, also those for which the mesh is made anew.

use incircle_testkit::SplitMix64;

use super::changes::check;
use crate::living::Triangulation;
use crate::plane_point::PlanePoint;
use crate::point::Point;

/// Moves the points of a mesh again and again, with a check after each frame.
fn run<P: PlanePoint + PartialEq + core::fmt::Debug>(
    mut places: Vec<Point>,
    frames: usize,
    mut step: impl FnMut(&mut [Point]),
    to_point: fn(Point) -> P,
) {
    let points = |places: &[Point]| -> Vec<P> { places.iter().map(|&place| to_point(place)).collect() };
    let mut mesh = Triangulation::from(points(&places)).expect("finite points");
    for _ in 0..frames {
        step(&mut places);
        mesh.move_all(&points(&places)).expect("one place for each point");
        check(&mesh);
    }
}

/// Runs the same frames on the grid, on a grid of 32 bits, on wide integers and on doubles.
fn run_all(places: &[Point], frames: usize, step: fn(&mut SplitMix64, &mut [Point])) {
    const WIDE: u32 = 3 << 30;
    let random = || SplitMix64::new(31);
    let step = |mut random: SplitMix64| move |places: &mut [Point]| step(&mut random, places);
    run(places.to_vec(), frames, step(random()), |place| place);
    run(places.to_vec(), frames, step(random()), |p| Point::new(p.x + WIDE, p.y + WIDE));
    run(places.to_vec(), frames, step(random()), |p| [i64::from(p.x) << 40, i64::from(p.y) << 40]);
    run(places.to_vec(), frames, step(random()), |p| [0.1 * f64::from(p.x), 0.1 * f64::from(p.y)]);
}

fn moved(random: &mut SplitMix64, place: Point, most: u32) -> Point {
    let step = |value: u32, random: &mut SplitMix64| (value + random.below_u32(2 * most + 1)).saturating_sub(most);
    Point::new(step(place.x, random), step(place.y, random))
}

fn lattice(side: u32, spacing: u32) -> Vec<Point> {
    (0..side * side).map(|cell| Point::new((cell / side + 1) * spacing, (cell % side + 1) * spacing)).collect()
}

#[test]
fn lattices_keep_and_lose_their_ties() {
    // All points by the same step, then one in eight by a step of one.
    run_all(&lattice(9, 10), 6, |random, places| {
        let [x, y] = [(); 2].map(|()| random.below_u32(20));
        places.iter_mut().for_each(|place| *place = Point::new(place.x + x, place.y + y));
        for place in places {
            if random.once_in(8) {
                *place = moved(random, *place, 1);
            }
        }
    });
    // A shear keeps each row on its line, and swaps the diagonals of all cells.
    run_all(&lattice(7, 12), 8, |_, places| places.iter_mut().for_each(|place| place.x += place.y / 4));
}

#[test]
fn duplicates_meet_and_part() {
    // On the cells of a small lattice many points share a place, others after each frame.
    run_all(&lattice(8, 2), 12, |random, places| {
        for place in places {
            let most = 1 + random.below_u32(2);
            *place = moved(random, *place, most);
        }
    });
}

#[test]
fn triangles_turn_over_by_steps_of_all_lengths() {
    let mut random = SplitMix64::new(32);
    let low: Vec<Point> = random.points(300, 1000);
    let places: Vec<Point> = low.into_iter().map(|p| Point::new(p.x + 2000, p.y + 2000)).collect();
    // The mean distance is 58.
    run_all(&places, 14, |random, places| {
        let most = random.pick(&[0, 1, 3, 6, 12, 30, 60, 2000]);
        places.iter_mut().for_each(|place| *place = moved(random, *place, most));
    });
}

#[test]
fn the_whole_set_turns_over_or_falls_on_a_line() {
    run_all(&lattice(6, 9), 9, |random, places| match random.below(4) {
        0 => places.iter_mut().for_each(|place| *place = Point::new(1000 - place.x, place.y)),
        1 => places.iter_mut().for_each(|place| *place = Point::new(place.y, place.x)),
        2 => places.iter_mut().for_each(|place| place.y = 2 * place.x),
        _ => places.iter_mut().for_each(|place| *place = moved(random, *place, 200)),
    });
}

#[test]
fn frames_between_other_changes() {
    let mut random = SplitMix64::new(33);
    let mut mesh = Triangulation::from(random.points(120, 64)).expect("room");
    for round in 0..60 {
        let indices = mesh.indices();
        for _ in 0..6 {
            let index = random.pick(&indices);
            // The index may be gone already.
            let _ = mesh.delete(index);
            mesh.insert(moved(&mut random, Point::new(30, 30), 29)).expect("room");
        }
        let most = 1 + round % 3;
        let living: Vec<Point> = mesh.indices().into_iter().filter_map(|index| mesh.point(index)).collect();
        let places: Vec<Point> = living.into_iter().map(|place| moved(&mut random, place, most)).collect();
        mesh.move_all(&places).expect("one place for each point");
        check(&mesh);
    }
}
