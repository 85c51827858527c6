//! Tests of the validator of constrained meshes: what the builder makes is accepted, and nothing else.

use incircle_testkit::SplitMix64;

use core::num::NonZeroUsize;
use core::ops::ControlFlow;

use super::{verify_constrained, VerifyError};
use crate::constraints::{self, constrain, Error};
use crate::cpu::triangulate;
use crate::mesh::Mesh;
use crate::plan::{Domain, Mark, Plan};
use crate::plane_point::PlanePoint;
use crate::point::Point;

fn mesh_of<P: PlanePoint>(points: &[P]) -> Mesh<P> {
    triangulate(points.to_vec(), NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("finite points")
}

/// Rings and lines on a grid that is full of ties, as long as the library finds no crossing.
fn random_plan(random: &mut SplitMix64, points: &[Point], most: u64) -> (Vec<[u32; 2]>, usize) {
    let mesh = mesh_of(points);
    let any = |random: &mut SplitMix64| random.below(points.len() as u64) as u32;
    let (mut rings, mut lines): (Vec<[u32; 2]>, Vec<[u32; 2]>) = (Vec::new(), Vec::new());
    for _ in 0..most {
        let first = any(random);
        // Points near one another, so that rings and lines do not cross too often.
        let near = |random: &mut SplitMix64| {
            let at = points[first as usize];
            let close = |&index: &u32| {
                let other = points[index as usize];
                at.x.abs_diff(other.x) < 4 && at.y.abs_diff(other.y) < 4
            };
            (0..20).map(|_| any(random)).find(close).unwrap_or(first)
        };
        let is_ring = !random.once_in(3);
        let chain: Vec<u32> = core::iter::once(first).chain((0..2 + random.below(3)).map(|_| near(random))).collect();
        let sides = chain.windows(2).map(|two| [two[0], two[1]]);
        let before = (rings.len(), lines.len());
        if is_ring {
            rings.extend(sides);
            rings.push([chain[chain.len() - 1], first]);
        } else {
            lines.extend(sides);
        }
        let all = [&rings[..], &lines[..]].concat();
        if constrain(&mesh, &Plan::new(&all)).is_err() {
            rings.truncate(before.0);
            lines.truncate(before.1);
        }
    }
    let count = lines.len();
    rings.extend(lines);
    (rings, count)
}

/// Damages a list of triangles in one place, and sorts it again.
fn damaged(random: &mut SplitMix64, triangles: &[[u32; 3]], points: u32) -> Vec<[u32; 3]> {
    let mut wrong = triangles.to_vec();
    let at = random.below(wrong.len() as u64) as usize;
    match random.below(4) {
        0 => drop(wrong.remove(at)),
        1 => wrong[at][random.below(3) as usize] = random.below_u32(points),
        2 => {
            // The other diagonal, if the next triangle with a common edge has it.
            let [a, b, c] = wrong[at];
            let other = wrong.iter().position(|other| {
                let sides = [[other[0], other[1]], [other[1], other[2]], [other[2], other[0]]];
                sides.contains(&[b, a])
            });
            if let Some(other) = other {
                let d = wrong[other].into_iter().find(|&corner| corner != a && corner != b).unwrap_or(a);
                wrong[at] = [a, d, c];
                wrong[other] = [d, b, c];
            } else {
                wrong.remove(at);
            }
        }
        _ => wrong.push([(); 3].map(|()| random.below_u32(points))),
    }
    for triangle in &mut wrong {
        let first = (0..3).min_by_key(|&place| triangle[place]).unwrap_or(0);
        triangle.rotate_left(first);
    }
    wrong.sort_unstable();
    wrong
}

#[test]
fn meshes_of_plans_are_accepted_and_damaged_ones_are_not() {
    let mut random = SplitMix64::new(61);
    let (mut accepted, mut refused, mut empty, mut outside) = (0, 0, 0, 0);
    for round in 0..400 {
        let side = 6 + random.below_u32(9);
        let points: Vec<Point> = random.points((side * side / 2) as usize, side);
        let (constraints, lines) = random_plan(&mut random, &points, 4 + round % 12);
        let mark = |random: &mut SplitMix64| Point::new(random.below_u32(side), random.below_u32(side));
        let holes: Vec<Point> = (0..random.below(2)).map(|_| mark(&mut random)).collect();
        let mesh = mesh_of(&points);
        for domain in Domain::ALL {
            let plan = Plan { domain, lines, holes: &holes, ..Plan::new(&constraints) };
            let made = match constrain(&mesh, &plan) {
                Ok(made) => made,
                Err(Error::OnConstraint { number, .. }) => {
                    let found = verify_constrained(&points, &[], &plan);
                    assert!(
                        matches!(found, Err(VerifyError::MarkOnConstraint { kind: Mark::Hole, number: n, .. })
                        if n == number),
                        "{found:?}"
                    );
                    continue;
                }
                Err(Error::Empty { triangles }) => {
                    let found = verify_constrained(&points, &[], &plan);
                    assert_eq!(found, Err(VerifyError::EmptyDomain { triangles }));
                    empty += 1;
                    continue;
                }
                Err(Error::Outside { kind, number }) => {
                    let found = verify_constrained(&points, &[], &plan);
                    assert_eq!(found, Err(VerifyError::MarkOutside { kind, number }));
                    outside += 1;
                    continue;
                }
                Err(other) => panic!("{other}"),
            };
            let shown = || format!("{domain} {points:?} {constraints:?} {lines} {holes:?}");
            let found = verify_constrained(&points, &made.triangles, &plan);
            found.unwrap_or_else(|error| panic!("{error}: {}", shown()));
            accepted += 1;
            for _ in 0..8 {
                let wrong = damaged(&mut random, &made.triangles, points.len() as u32);
                if wrong != made.triangles {
                    assert!(verify_constrained(&points, &wrong, &plan).is_err(), "{wrong:?}: {}", shown());
                    refused += 1;
                }
            }
        }
    }
    assert!(accepted > 1000 && refused > 5000, "{accepted} {refused}");
    assert!(empty > 10 && outside > 5, "{empty} {outside}");
}

#[test]
fn plans_without_a_mesh_are_refused_whatever_the_triangles_are() {
    let points = [[0, 0], [8, 0], [8, 8], [0, 8]];
    let refused = |constraints: &[[u32; 2]], domain: Domain, holes: &[[i32; 2]]| {
        let plan = Plan { domain, holes, ..Plan::new(constraints) };
        let all = verify_constrained(&points, &[[0, 1, 2], [0, 2, 3]], &plan);
        assert_eq!(verify_constrained(&points, &[], &plan), all);
        let error = all.expect_err("no mesh");
        // The builder says the same with the same words.
        let built = constrain(&mesh_of(&points), &plan).expect_err("no mesh");
        assert_eq!(error.to_string(), built.to_string());
        error
    };
    let open = [[0, 1], [1, 2]];
    assert_eq!(refused(&open, Domain::EvenOdd, &[]), VerifyError::Open { point: 0, count: 1 });
    let two = [[0, 1], [1, 2], [0, 2]];
    assert_eq!(refused(&two, Domain::NonZero, &[]), VerifyError::Unbalanced { point: 0, begin: 2, end: 0 });
    for domain in [Domain::Holes, Domain::EvenOdd, Domain::NonZero] {
        assert_eq!(refused(&[], domain, &[]), VerifyError::EmptyDomain { triangles: 2 });
    }
    let ring = [[0, 1], [1, 2], [2, 0]];
    let outside = |number| VerifyError::MarkOutside { kind: Mark::Hole, number };
    assert_eq!(refused(&ring, Domain::Holes, &[[5, 3], [9, 3]]), outside(1));
    assert_eq!(refused(&ring, Domain::Holes, &[[9, 3], [4, 4]]), outside(0));
    let on = VerifyError::MarkOnConstraint { kind: Mark::Hole, number: 0, edge: [0, 2] };
    assert_eq!(refused(&ring, Domain::Holes, &[[4, 4], [9, 3]]), on);
}

#[test]
fn lines_inside_rings_are_told_from_those_outside() {
    // An L, whose notch is the square from (4, 4) to (8, 8).
    let points = [
        [0, 0],
        [8, 0],
        [8, 4],
        [4, 4],
        [4, 8],
        [0, 8], // the L
        [1, 1],
        [3, 1],
        [3, 3], // inside
        [5, 5],
        [7, 5],
        [7, 7], // in the notch
        [8, 2],
        [9, 9],
        [4, 6],
    ];
    let ring = [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 0]];
    let is_inside = |lines: &[[u32; 2]]| {
        let found = super::lie_inside(&points, &ring, lines).expect("no crossing");
        let doubles = points.map(|place| place.map(|value| 0.1 * f64::from(value)));
        assert_eq!(super::lie_inside(&doubles, &ring, lines), Ok(found));
        found
    };
    assert!(is_inside(&[]) && is_inside(&[[6, 7], [7, 8], [8, 6]]));
    assert!(!is_inside(&[[9, 10], [10, 11], [11, 9]]));
    // A hole may touch the ring in points and along a side of it.
    assert!(is_inside(&[[6, 12], [12, 3], [3, 6]]) && is_inside(&[[0, 1], [1, 8], [8, 0]]));
    // Both ends are on the ring, but the line between them is not inside.
    assert!(!is_inside(&[[2, 4], [4, 3], [3, 2]]) && !is_inside(&[[2, 14], [14, 3], [3, 2]]));
    assert!(!is_inside(&[[6, 3], [3, 13], [13, 2], [2, 6]]));
    // A ring along the ring is on its border.
    assert!(is_inside(&ring));
    // The side of two corners in a row is crossed by a line through a corner, which goes on outside.
    assert!(!is_inside(&[[8, 3], [3, 11]]));
}

#[test]
fn numbers_of_all_kinds_are_checked() {
    let mut random = SplitMix64::new(62);
    for _ in 0..60 {
        let points: Vec<Point> = random.points(80, 12);
        let (constraints, lines) = random_plan(&mut random, &points, 8);
        let unit = 2f64.powi(900);
        let doubles: Vec<[f64; 2]> = points.iter().map(|p| [f64::from(p.x) * unit, f64::from(p.y) * unit]).collect();
        let odd: Vec<[f64; 2]> = points.iter().map(|p| [0.1 * f64::from(p.x) + 1e9, 0.3 * f64::from(p.y)]).collect();
        let long = |value: u32| (1i64 << 62) + (i64::from(value) << 40);
        let whole: Vec<[i64; 2]> = points.iter().map(|p| [long(p.x), -long(p.y)]).collect();
        for domain in Domain::ALL {
            check(&doubles, &constraints, lines, domain);
            check(&whole, &constraints, lines, domain);
            check(&odd, &constraints, lines, domain);
        }
    }
}

/// Checks the mesh of some points, if constraints that are free of crossings on a grid are so here, too.
fn check<P: PlanePoint + core::fmt::Debug>(points: &[P], constraints: &[[u32; 2]], lines: usize, domain: Domain) {
    let plan = Plan { domain, lines, ..Plan::new(constraints) };
    if let Ok(made) = constrain(&mesh_of(points), &plan) {
        verify_constrained(points, &made.triangles, &plan).unwrap_or_else(|error| panic!("{error}: {points:?}"));
    }
}

/// Checks a plan whose numbers are so large that a step for each pair of constraints or points would take minutes.
fn check_large(points: &[Point], constraints: &[[u32; 2]], more: &[[u32; 2]], domain: Domain) {
    let plan = Plan { domain, ..Plan::new(constraints) };
    let made = constrain(&mesh_of(points), &plan).expect("no crossing");
    let again = constraints::triangulate(points, &plan, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()));
    assert!(again.expect("no crossing").made == made);
    // Constraints that overlap change nothing but the lists of the pieces, which would be too long here.
    let all = [constraints, more].concat();
    verify_constrained(points, &made.triangles, &Plan { lines: more.len(), ..Plan { domain, ..Plan::new(&all) } })
        .expect("the right mesh");
    let wrong = &made.triangles[1..];
    assert!(verify_constrained(points, wrong, &Plan { domain, ..Plan::new(&all) }).is_err());
}

const LARGE: u32 = 60_000;

#[test]
fn a_line_with_many_constraints_on_one_another_is_checked_soon() {
    // All points but one are on a line and in one square of any coarse grid.
    let mut points: Vec<Point> = (0..LARGE).map(|k| Point::new(k, 2 * k)).collect();
    points.push(Point::new(1 << 30, 0));
    let pieces: Vec<[u32; 2]> = (1..LARGE).map(|k| [k, k - 1]).collect();
    let nested: Vec<[u32; 2]> = (0..LARGE / 2).map(|k| [k, LARGE - 1 - k]).collect();
    let chained: Vec<[u32; 2]> = (0..LARGE / 2).map(|k| [k, k + LARGE / 2]).collect();
    check_large(&points, &pieces, &[nested, chained].concat(), Domain::All);
}

#[test]
fn a_star_with_many_arms_is_checked_soon() {
    // Points around a square, each joined to the middle; every second arm has a point halfway.
    let (side, middle) = (LARGE / 4, 2 * LARGE);
    let mut points = vec![Point::new(middle, middle)];
    for k in 0..side {
        points.extend(
            [(8 * k, 0), (4 * middle, 8 * k), (4 * middle - 8 * k, 4 * middle), (0, 4 * middle - 8 * k)]
                .map(|(x, y)| Point::new(x / 2, y / 2)),
        );
    }
    let arms: Vec<[u32; 2]> = (1..points.len() as u32).map(|k| [0, k]).collect();
    check_large(&points, &arms, &[], Domain::All);
}

#[test]
fn many_islands_and_a_comb_are_checked_soon() {
    let corners = |x: u32, y: u32| [(0, 0), (4, 0), (4, 4), (0, 4)].map(|(u, v)| Point::new(x + u, y + v));
    let points: Vec<Point> = (0..LARGE / 4).flat_map(|k| corners(10 * (k % 100), 10 * (k / 100))).collect();
    let rings: Vec<[u32; 2]> = (0..LARGE).map(|k| [k, if k % 4 == 3 { k - 3 } else { k + 1 }]).collect();
    check_large(&points, &rings, &[], Domain::EvenOdd);
    // The teeth of a comb are long and all lie above one another.
    let teeth = LARGE / 4;
    let points: Vec<Point> = (0..teeth)
        .flat_map(|k| [(0, 4 * k), (1 << 28, 4 * k + 1), (0, 4 * k + 2), (3, 4 * k + 3)].map(Point::from))
        .collect();
    let comb: Vec<[u32; 2]> = (0..teeth).flat_map(|k| [[4 * k, 4 * k + 1], [4 * k + 2, 4 * k + 1]]).collect();
    check_large(&points, &comb, &[], Domain::All);
}

#[test]
fn a_hole_whose_place_is_no_number_is_named() {
    let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]];
    let holes = [[1.0, 1.0], [f64::NAN, 0.0]];
    let plan = Plan { domain: Domain::Holes, holes: &holes, ..Plan::new(&[]) };
    let found = verify_constrained(&points, &[], &plan);
    assert_eq!(found, Err(VerifyError::MarkNotFinite { kind: Mark::Hole, number: 1 }));
}
