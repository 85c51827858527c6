//! The predicates beside integers of any size, on points that sit near the edge of every stage.

use incircle_testkit::{incircle_of_doubles, orient2d_of_doubles, SplitMix64};

use super::{incircle, orient2d, Bounds, View};

/// Coordinates of many kinds: small and large, near one another, with few bits and with all, denormals and the widest.
fn coordinate(random: &mut SplitMix64, kind: u64) -> f64 {
    let small = |random: &mut SplitMix64| random.below(5) as f64;
    let unit = |random: &mut SplitMix64| random.below(1 << 53) as f64 / (1u64 << 53) as f64;
    let near = |random: &mut SplitMix64, value: f64| (0..random.below(3)).fold(value, |value, _| value.next_up());
    match kind {
        0 => small(random) - 2.0,
        1 => {
            let value = small(random) * 0.1;
            near(random, value)
        }
        2 => unit(random),
        3 => small(random) * 5e-324,
        4 => (small(random) - 2.0) * 8e307,
        5 => (unit(random) - 0.5) * 2f64.powi(random.below(2000) as i32 - 1000),
        6 => 1e15 + small(random) / 8.0,
        _ => {
            let value = small(random);
            if random.below(2) == 0 {
                near(random, value)
            } else {
                -near(random, value)
            }
        }
    }
}

fn point(random: &mut SplitMix64, kind: u64) -> [f64; 2] {
    [coordinate(random, kind), coordinate(random, kind)]
}

#[test]
fn signs_are_those_of_integers_of_any_size() {
    let mut random = SplitMix64::new(21);
    let mut ties = [0; 9];
    for round in 0..40_000 {
        let kind = round % 9;
        let own = |random: &mut SplitMix64| if kind == 8 { random.below(8) } else { kind };
        let [a, b, c, d] = [(); 4].map(|()| {
            let kind = own(&mut random);
            point(&mut random, kind)
        });
        assert_eq!(orient2d(a, b, c), orient2d_of_doubles(a, b, c), "{a:?} {b:?} {c:?}");
        let side = incircle_of_doubles(a, b, c, d);
        assert_eq!(incircle(a, b, c, d), side, "{a:?} {b:?} {c:?} {d:?}");
        ties[kind as usize] += usize::from(side.is_eq());
    }
    assert!(ties[0] > 100 && ties[3] > 100 && ties[4] > 100, "{ties:?}");
}

#[test]
fn the_corners_of_a_rotated_square_are_on_one_circle_up_to_their_last_bit() {
    let mut random = SplitMix64::new(22);
    for _ in 0..4000 {
        let angle = random.below(1 << 53) as f64 / (1u64 << 50) as f64;
        let at = |turns: f64| [libm::cos(angle + turns), libm::sin(angle + turns)];
        let [a, b, c, d] = [0.0, 1.5, 3.0, 4.5].map(at);
        assert_eq!(incircle(a, b, c, d), incircle_of_doubles(a, b, c, d));
        // A line through three points of a chord.
        let middle = [(a[0] + c[0]) / 2.0, (a[1] + c[1]) / 2.0];
        assert_eq!(orient2d(a, c, middle), orient2d_of_doubles(a, c, middle));
    }
}

/// Checks the filter with these bounds of a set against integers of any size. Returns how many of the two questions
/// about the points the filter answers.
fn answers_of_bounds(bounds: Bounds, [a, b, c, q]: [[f64; 2]; 4]) -> usize {
    let (from_c, from_q) = (View::of(a, b, c), View::of(a, b, q));
    let side = bounds.side(from_c);
    let exact_side = orient2d_of_doubles(a, b, c);
    assert!(side.is_none_or(|side| side == exact_side), "{a:?} {b:?} {c:?}");
    let inside = bounds.is_left_and_inside(from_c, from_q);
    // For a point `c` to the right the answer is no, whatever the circle.
    let expected = exact_side.is_gt() && incircle_of_doubles(a, b, c, q).is_gt();
    assert!(inside.is_none_or(|inside| inside == expected), "{a:?} {b:?} {c:?} {q:?}");
    usize::from(side.is_some()) + usize::from(inside.is_some())
}

#[test]
fn bounds_of_a_set_never_contradict_integers_of_any_size() {
    let mut random = SplitMix64::new(23);
    let mut answers = [0; 9];
    for round in 0..40_000 {
        let kind = round % 9;
        let own = |random: &mut SplitMix64| if kind == 8 { random.below(8) } else { kind };
        let points = [(); 4].map(|()| {
            let kind = own(&mut random);
            point(&mut random, kind)
        });
        answers[kind as usize] += answers_of_bounds(Bounds::of(points), points);
    }
    // Random points (kind 2) rarely lie near one circle. Denormals (3) and the largest doubles (4) have infinite
    // bounds.
    assert!(answers[2] > 8000 && answers[3] == 0 && answers[4] == 0, "{answers:?}");
}

#[test]
fn bounds_of_a_set_hold_for_all_scales() {
    let mut random = SplitMix64::new(24);
    for exponent in [-1070, -538, -242, -241, -240, -239, -100, 0, 248, 249, 250, 251, 1022] {
        let scale = 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
        let mut answers = 0;
        for _ in 0..500 {
            // The corners of a square, within some units in the last place of one circle. In every fourth round, one
            // corner lies away from it.
            let away = if random.once_in(4) { 0.1 } else { 0.0 };
            let mut near = |value: f64| scale * (value + random.below(8) as f64 * f64::EPSILON);
            let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [away, 1.0]].map(|point| point.map(&mut near));
            answers += answers_of_bounds(Bounds::of(points), points);
        }
        assert_eq!(answers > 500, (-240..=249).contains(&exponent), "2^{exponent}: {answers}");
    }
}
