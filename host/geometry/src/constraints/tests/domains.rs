//! Domains of small graphs beside the same by counting, triangle by triangle.

use std::collections::{BTreeMap, BTreeSet};

use incircle_testkit::{orient2d, SplitMix64};

use super::brute::Graph;
use super::canonical::{in_both_ways, mesh_of};
use crate::constraints::{constrain, Constrained, Domain, Error, Mark, Plan};
use crate::point::Point;

/// How often closed rings run around the centre of a triangle, counter-clockwise, and how many of their edges a ray
/// from there to the right meets. All coordinates are three times as large, so that the centre is a point.
fn turns(graph: &Graph, rings: &[[u32; 2]], triangle: [u32; 3]) -> (i64, u64) {
    let corners = triangle.map(|corner| graph.at(corner));
    let centre = [0, 1].map(|axis| corners.iter().map(|corner| i64::from(corner[axis])).sum::<i64>());
    let (mut turns, mut crossings) = (0, 0);
    for &[from, to] in rings {
        let [[x0, y0], [x1, y1]] = [from, to].map(|end| graph.at(end).map(|value| 3 * i64::from(value)));
        let [below, above] = [y0 <= centre[1], y1 <= centre[1]];
        if below != above {
            let cross = (x1 - x0) * (centre[1] - y0) - (y1 - y0) * (centre[0] - x0);
            // The ray meets the edge if the centre lies left of an edge that rises, or right of one that falls.
            if (cross > 0) == (y1 > y0) && cross != 0 {
                crossings += 1;
                turns += if y1 > y0 { 1 } else { -1 };
            }
        }
    }
    (turns, crossings)
}

/// A graph whose constraints are some closed rings, and lines behind them.
fn rings(random: &mut SplitMix64) -> (Graph, usize) {
    let mut graph = Graph::random(random, 1);
    let count = graph.points.len() as u64;
    for _ in 0..1 + random.below(3) {
        let ring: Vec<u32> = (0..3 + random.below(3)).map(|_| random.below(count) as u32).collect();
        graph.constraints.extend((0..ring.len()).map(|place| [ring[place], ring[(place + 1) % ring.len()]]));
    }
    let boundary = graph.constraints.len();
    for _ in 0..random.below(3) {
        graph.constraints.push([random.below(count) as u32, random.below(count) as u32]);
    }
    (graph, boundary)
}

fn made(graph: &Graph, boundary: usize, domain: Domain) -> Result<Constrained, Error> {
    let points: Vec<Point> = graph.points.iter().map(|&point| point.into()).collect();
    let lines = graph.constraints.len() - boundary;
    in_both_ways(&points, &Plan { domain, lines, ..Plan::new(&graph.constraints) })
}

fn area(graph: &Graph, [a, b, c]: [u32; 3]) -> i128 {
    orient2d(graph.at(a), graph.at(b), graph.at(c))
}

#[test]
fn rings_bound_the_triangles_whose_centres_they_surround() {
    let mut random = SplitMix64::new(11);
    let mut meshes = 0;
    while meshes < 3000 {
        let (graph, boundary) = rings(&mut random);
        if graph.crosses() {
            continue;
        }
        let Ok(all) = made(&graph, boundary, Domain::All) else { panic!("all triangles are an answer") };
        let rings = &graph.constraints[..boundary];
        let of = |triangle: &[u32; 3]| turns(&graph, rings, *triangle);
        for domain in [Domain::EvenOdd, Domain::NonZero] {
            let is_in = |triangle: &[u32; 3]| match domain {
                Domain::EvenOdd => of(triangle).1 % 2 != 0,
                _ => of(triangle).0 != 0,
            };
            let expected: Vec<[u32; 3]> = all.triangles.iter().copied().filter(is_in).collect();
            match made(&graph, boundary, domain) {
                Ok(made) => {
                    assert_eq!(made.triangles, expected, "{domain} {:?} {:?}", graph.points, graph.constraints);
                    let sum: i128 = expected.iter().map(|&triangle| area(&graph, triangle)).sum();
                    assert_eq!(made.twice_area, Some(sum));
                    check_regions(&made);
                }
                Err(error) => {
                    assert_eq!(error, Error::Empty { triangles: all.triangles.len() });
                    assert!(expected.is_empty());
                }
            }
        }
        // Each triangle counted as often as rings run around it makes the areas of the rings.
        let counted: i128 =
            all.triangles.iter().map(|triangle| i128::from(of(triangle).0) * area(&graph, *triangle)).sum();
        let origin = [0, 0];
        let of_rings: i128 = rings.iter().map(|&[a, b]| orient2d(origin, graph.at(a), graph.at(b))).sum();
        assert_eq!(counted, of_rings);
        meshes += 1;
    }
}

/// The parts of some triangles that no piece cuts, and the two sides of each edge.
fn labels(triangles: &[[u32; 3]], made: &Constrained) -> (Vec<usize>, BTreeMap<[u32; 2], usize>) {
    let mut sides = BTreeMap::new();
    for (number, &[a, b, c]) in triangles.iter().enumerate() {
        sides.extend([[a, b], [b, c], [c, a]].map(|side| (side, number)));
    }
    let mut labels: Vec<usize> = (0..triangles.len()).collect();
    let mut is_done = false;
    while !is_done {
        is_done = true;
        for (&[a, b], &one) in &sides {
            if let Some(&other) = sides.get(&[b, a]).filter(|_| made.pieces.of_edge([a, b]).is_empty()) {
                let least = labels[one].min(labels[other]);
                is_done &= labels[one] == labels[other];
                (labels[one], labels[other]) = (least, least);
            }
        }
    }
    (labels, sides)
}

/// Checks that regions are the parts that no piece cuts, numbered in the order of their first triangles.
fn check_regions(made: &Constrained) {
    let (labels, _) = labels(&made.triangles, made);
    let mut firsts: Vec<usize> = labels.clone();
    firsts.sort_unstable();
    firsts.dedup();
    let expected: Vec<u32> = labels.iter().map(|label| firsts.binary_search(label).expect("a label") as u32).collect();
    assert_eq!(made.regions, expected);
    assert_eq!(made.region_count as usize, firsts.len());
}

#[test]
fn holes_and_the_outside_eat_triangles_up_to_constraints() {
    let mut random = SplitMix64::new(12);
    let mut counts = [0; 4];
    while counts[0] < 3000 {
        let graph = Graph::random(&mut random, 12);
        let points: Vec<Point> = graph.points.iter().map(|&[x, y]| Point::new(2 * x, 2 * y)).collect();
        let mesh = mesh_of(&points);
        if graph.crosses() || mesh.is_collinear() {
            continue;
        }
        let Ok(all) = constrain(&mesh, &Plan::new(&graph.constraints)) else { panic!("all triangles are an answer") };
        let mark = |random: &mut SplitMix64| Point::new(random.below_u32(10), random.below_u32(10));
        let marks: Vec<Point> = (0..random.below(3)).map(|_| mark(&mut random)).collect();
        let plan = Plan { domain: Domain::Holes, holes: &marks, ..Plan::new(&graph.constraints) };
        let found = in_both_ways(&points, &plan);
        let (labels, sides) = labels(&all.triangles, &all);
        let corners = |triangle: usize| all.triangles[triangle].map(|corner| points[corner as usize]);
        let holds = |triangle: usize, at: Point| {
            let [a, b, c] = corners(triangle);
            [(a, b), (b, c), (c, a)].iter().all(|&(p, q)| orient2d(p, q, at) >= 0)
        };
        let fixed: BTreeSet<[u32; 2]> = all.pieces.edges().iter().copied().collect();
        let on = |&[a, b]: &[u32; 2], at: Point| {
            let (p, q) = (points[a as usize], points[b as usize]);
            orient2d(p, q, at) == 0 && p.min(q) <= at && at <= p.max(q)
        };
        let mut eaten: BTreeSet<usize> = BTreeSet::new();
        for (&[a, b], &one) in &sides {
            if !sides.contains_key(&[b, a]) && !fixed.contains(&[a.min(b), a.max(b)]) {
                eaten.insert(labels[one]);
            }
        }
        let mut error = None;
        for (number, &at) in marks.iter().enumerate() {
            let inside = (0..labels.len()).find(|&triangle| holds(triangle, at));
            let is_on_fixed = fixed.iter().any(|edge| on(edge, at));
            match inside {
                None => error = error.or(Some((number, false))),
                Some(_) if is_on_fixed => error = error.or(Some((number, true))),
                Some(triangle) => drop(eaten.insert(labels[triangle])),
            }
        }
        let left = (0..labels.len()).filter(|&triangle| !eaten.contains(&labels[triangle]));
        let expected: Vec<[u32; 3]> = left.map(|triangle| all.triangles[triangle]).collect();
        let kind = Mark::Hole;
        let shown = || format!("{:?} {:?} {marks:?}", graph.points, graph.constraints);
        match (found, error) {
            (Err(Error::Empty { .. }), None) if expected.is_empty() => counts[1] += 1,
            (Err(Error::Outside { kind: found, number }), Some((first, false))) => {
                assert_eq!((found, number), (kind, first));
                counts[2] += 1;
            }
            (Err(Error::OnConstraint { kind: found, number, .. }), Some((first, true))) => {
                assert_eq!((found, number), (kind, first));
                counts[3] += 1;
            }
            (Ok(made), None) => assert_eq!(made.triangles, expected, "{}", shown()),
            (found, error) => panic!("{found:?} {error:?}: {}", shown()),
        }
        counts[0] += 1;
    }
    assert!(counts.iter().all(|&count| count > 50), "{counts:?}");
}

#[test]
fn places_in_regions_tell_their_numbers() {
    let points = [[0, 0], [9, 0], [9, 9], [0, 9]].map(Point::from);
    let made = |places: &[[u32; 2]]| {
        let places: Vec<Point> = places.iter().map(|&place| place.into()).collect();
        in_both_ways(&points, &Plan { regions: &places, ..Plan::new(&[[0, 2]]) }).map(|made| made.marked)
    };
    assert_eq!(made(&[[1, 8], [8, 1], [7, 2]]), Ok(vec![1, 0, 0]));
    assert_eq!(made(&[[9, 9]]), Err(Error::OnConstraint { kind: Mark::Region, number: 0, edge: [0, 2] }));
    assert_eq!(made(&[[1, 8], [10, 1]]), Err(Error::Outside { kind: Mark::Region, number: 1 }));
}

#[test]
fn boundaries_that_are_not_closed_are_refused() {
    let points: Vec<Point> = [[0, 0], [9, 0], [9, 9], [0, 9]].map(Point::from).to_vec();
    let made = |constraints: &[[u32; 2]], lines, domain| {
        in_both_ways(&points, &Plan { domain, lines, ..Plan::new(constraints) }).map(|made| made.triangles)
    };
    let open = [[0, 1], [1, 2], [2, 3]];
    assert_eq!(made(&open, 0, Domain::EvenOdd), Err(Error::Open { point: 0, count: 1 }));
    assert_eq!(made(&open, 3, Domain::EvenOdd), Err(Error::Empty { triangles: 2 }));
    let turned = [[0, 1], [1, 2], [0, 2]];
    assert_eq!(made(&turned, 0, Domain::NonZero), Err(Error::Unbalanced { point: 0, begin: 2, end: 0 }));
    assert_eq!(made(&turned, 0, Domain::EvenOdd), Ok(vec![[0, 1, 2]]));
}
