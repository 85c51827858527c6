//! The predicates of a visit: Rust behaviour, Verilog and plain integer arithmetic agree clock by clock.
//!
//! The references share no formula with the hardware: orientation is a sum over the corners of the triangle, incircle the 3 x 3
//! determinant of the lifted points.

use crate::rig::cosimulation::{named_ports, Cosimulation, Delay, Expected, NamedPorts, Numbers};
use incircle_hdl::predicate::{
    CrossProduct, DotProduct, EdgeSigns, PointDifference, VertexOrder, VisitPredicates, WideProduct,
};
use incircle_testbench::gate::cell_count;

named_ports!([] PointDifference, [from, to], [x, y]);
named_ports!([] CrossProduct, [a_x, a_y, b_x, b_y], [product], clock);
named_ports!([] DotProduct, [a_x, a_y, b_x, b_y], [product], clock);
named_ports!([] WideProduct, [a, b], [product], clock);
named_ports!([] EdgeSigns, [e0, e1, e2],
    [e0_negative, e1_negative, e2_negative, e0_zero, e1_zero, e2_zero, e1_below_e0, e2_below_e0, e2_below_e1], clock);
named_ports!([] VertexOrder, [r0, r1, r2, p],
    [p_before_r0, p_before_r1, p_before_r2, p_equals_r0, p_equals_r1, p_equals_r2, r0_before_r1, r0_before_r2,
     r1_before_r2], clock);
named_ports!([] VisitPredicates, [r0, r1, r2, p],
    [e0_negative, e1_negative, e2_negative, e0_zero, e1_zero, e2_zero, e1_below_e0, e2_below_e0, e2_below_e1,
     incircle_positive, incircle_zero,
     p_before_r0, p_before_r1, p_before_r2, p_equals_r0, p_equals_r1, p_equals_r2, r0_before_r1, r0_before_r2,
     r1_before_r2], clock);

const CYCLES: usize = 10_000;
const LARGEST: i64 = 65535;
const EDGE_FLAGS: [&str; 9] = [
    "e0_negative",
    "e1_negative",
    "e2_negative",
    "e0_zero",
    "e1_zero",
    "e2_zero",
    "e1_below_e0",
    "e2_below_e0",
    "e2_below_e1",
];
const INCIRCLE_FLAGS: [&str; 2] = ["incircle_positive", "incircle_zero"];
const ORDER_FLAGS: [&str; 9] = [
    "p_before_r0",
    "p_before_r1",
    "p_before_r2",
    "p_equals_r0",
    "p_equals_r1",
    "p_equals_r2",
    "r0_before_r1",
    "r0_before_r2",
    "r1_before_r2",
];
const POINT_PORTS: [&str; 4] = ["r0", "r1", "r2", "p"];

/// A point; compared by `x`, then by `y`.
type Point = (i64, i64);

fn word(point: Point) -> u64 {
    (point.0 | point.1 << 16) as u64
}

fn point(word: u64) -> Point {
    ((word & 0xffff) as i64, (word >> 16) as i64)
}

/// `value` in two's complement of `bits` bits.
fn bits_of(value: i128, bits: u32) -> u128 {
    value as u128 & ((1 << bits) - 1)
}

/// Twice the signed area of a triangle, by the shoelace formula.
fn orientation(a: Point, b: Point, c: Point) -> i128 {
    let corner = |u: Point, v: Point| i128::from(u.0) * i128::from(v.1) - i128::from(v.0) * i128::from(u.1);
    corner(a, b) + corner(b, c) + corner(c, a)
}

/// The determinant of the points lifted to a paraboloid, relative to `p`: positive inside the circle of a counter-clockwise triangle.
fn lifted_incircle(triangle: [Point; 3], p: Point) -> i128 {
    let [a, b, c] = triangle.map(|vertex| {
        let (x, y) = (i128::from(vertex.0 - p.0), i128::from(vertex.1 - p.1));
        [x, y, x * x + y * y]
    });
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}

fn flags<const N: usize>(values: [bool; N]) -> Vec<u128> {
    values.map(u128::from).to_vec()
}

fn edge_flags(e: [i128; 3]) -> Vec<u128> {
    flags([e[0] < 0, e[1] < 0, e[2] < 0, e[0] == 0, e[1] == 0, e[2] == 0, e[1] < e[0], e[2] < e[0], e[2] < e[1]])
}

fn order_flags(r: [Point; 3], p: Point) -> Vec<u128> {
    let before = flags([p < r[0], p < r[1], p < r[2]]);
    let equals = flags(r.map(|vertex| p == vertex));
    [before, equals, flags([r[0] < r[1], r[0] < r[2], r[1] < r[2]])].concat()
}

fn all_flags(r: [Point; 3], p: Point) -> Vec<u128> {
    let e = [0, 1, 2].map(|k| orientation(r[(k + 1) % 3], r[(k + 2) % 3], p));
    let incircle = lifted_incircle(r, p);
    [edge_flags(e), flags([incircle > 0, incircle == 0]), order_flags(r, p)].concat()
}

/// Outputs of a pipeline: known values, or nothing while it fills.
fn shown(delayed: Option<Vec<u128>>, outputs: usize) -> Vec<Expected> {
    delayed.map_or(vec![None; outputs], |values| values.into_iter().map(Some).collect())
}

/// Four points, as the ports take them: from every corner of the input space that is dangerous, in turn.
fn visit(numbers: &mut Numbers) -> Vec<u64> {
    let bits = [16, 16, 16, 4, 2, 8][(numbers.next() % 6) as usize];
    let random = |numbers: &mut Numbers| (numbers.bits(bits) as i64, numbers.bits(bits) as i64);
    let mut points = [(); 4].map(|()| random(numbers));
    match numbers.next() % 8 {
        0 => points = points.map(|(x, y)| ((x & 1) * LARGEST, (y & 1) * LARGEST)),
        1 => points[3] = points[(numbers.next() % 3) as usize],
        2 => {
            // All on one line through the origin corner.
            let (x, y) = (numbers.bits(6) as i64, numbers.bits(6) as i64);
            points = points.map(|(k, _)| (x * (k & 0x3ff), y * (k & 0x3ff)));
        }
        3 => {
            // On one circle: reflections of one vector about a centre.
            let (x, y) = (numbers.bits(15) as i64, numbers.bits(15) as i64);
            let around = [(x, y), (-y, x), (-x, -y), (y, -x), (-x, y), (x, -y), (y, x)];
            points = points.map(|_| {
                let turn = around[(numbers.next() % 7) as usize];
                (32768 + turn.0, 32768 + turn.1)
            });
            if numbers.once_in(3) {
                points[3].0 ^= 1;
            }
        }
        4 => points = points.map(|(x, y)| (x ^ LARGEST, y)),
        _ => {}
    }
    points.map(word).to_vec()
}

fn run_visits<U: NamedPorts>(
    name: &str,
    rust: U,
    outputs: &[&str],
    latency: usize,
    reference: impl Fn([Point; 3], Point) -> Vec<u128>,
) {
    let mut numbers = Numbers::new(11);
    let mut corners = vec![];
    for code in 0..256_u64 {
        let corner =
            |k: u64| word(((code >> (2 * k) & 1) as i64 * LARGEST, (code >> (2 * k + 1) & 1) as i64 * LARGEST));
        corners.push(vec![corner(0), corner(1), corner(2), corner(3)]);
    }
    corners.extend((0..CYCLES).map(|_| visit(&mut numbers)));
    let mut delay = Delay::new(latency);
    Cosimulation { name, rust, inputs: &POINT_PORTS, outputs }.run(corners, |values| {
        let r = [point(values[0]), point(values[1]), point(values[2])];
        shown(delay.pass(reference(r, point(values[3]))), outputs.len())
    });
}

#[test]
fn visit_predicates_agree_with_the_lifted_determinant() {
    let outputs = [&EDGE_FLAGS[..], &INCIRCLE_FLAGS, &ORDER_FLAGS].concat();
    assert_eq!(VisitPredicates::LATENCY, 10);
    run_visits("visit_predicates", VisitPredicates::default(), &outputs, VisitPredicates::LATENCY, all_flags);
}

#[test]
fn vertex_order_sorts_by_x_then_y() {
    run_visits("vertex_order", VertexOrder::new(1), &ORDER_FLAGS, 1, order_flags);
}

#[test]
fn dangerous_visits_are_among_the_random_ones() {
    let mut numbers = Numbers::new(11);
    let mut seen = [0; 4];
    for _ in 0..CYCLES {
        let r: Vec<Point> = visit(&mut numbers).into_iter().map(point).collect();
        let triangle = [r[0], r[1], r[2]];
        let proper = orientation(r[0], r[1], r[2]) != 0 && !triangle.contains(&r[3]);
        seen[0] += usize::from(orientation(r[0], r[1], r[2]) == 0);
        seen[1] += usize::from(triangle.contains(&r[3]));
        seen[2] += usize::from(proper && lifted_incircle(triangle, r[3]) == 0);
        seen[3] += usize::from(proper && lifted_incircle(triangle, r[3]) > 0);
    }
    assert!(
        seen.iter().all(|count| *count > CYCLES / 100),
        "collinear triangles, points on vertices, cocircular, inside: {seen:?}"
    );
}

#[test]
fn incircle_fits_its_width() {
    let corner = |code: u32| ((code & 1) as i64 * LARGEST, (code >> 1 & 1) as i64 * LARGEST);
    let mut largest = 0;
    for code in 0..256 {
        let points = [0, 2, 4, 6].map(|shift| corner(code >> shift));
        largest = largest.max(lifted_incircle([points[0], points[1], points[2]], points[3]).abs());
    }
    assert!(largest < 1 << (incircle_hdl::predicate::INCIRCLE_BITS - 1));
}

#[test]
fn point_difference_never_wraps() {
    let mut numbers = Numbers::new(12);
    let ends = [0, 1, 0x7fff, 0x8000, 0xfffe, 0xffff];
    let mut stimuli: Vec<Vec<u64>> = vec![];
    for from in ends {
        for to in ends {
            stimuli.push(vec![from | to << 16, to | from << 16]);
        }
    }
    stimuli.extend((0..CYCLES).map(|_| vec![numbers.bits(32), numbers.bits(32)]));
    Cosimulation {
        name: "point_difference",
        rust: PointDifference::default(),
        inputs: &["from", "to"],
        outputs: &["x", "y"],
    }
    .run(stimuli, |values| {
        let (from, to) = (point(values[0]), point(values[1]));
        [to.0 - from.0, to.1 - from.1].map(|part| Some(bits_of(part.into(), 18))).to_vec()
    });
}

/// Differences of coordinates as 18 bits, and what they stand for.
fn difference(numbers: &mut Numbers) -> u64 {
    let value = match numbers.next() % 4 {
        0 => [0, 1, -1, LARGEST, -LARGEST][(numbers.next() % 5) as usize],
        _ => numbers.bits(16) as i64 - numbers.bits(16) as i64,
    };
    bits_of(value.into(), 18) as u64
}

fn signed(value: u64, bits: u32) -> i128 {
    i128::from(((value << (64 - bits)) as i64) >> (64 - bits))
}

#[test]
fn cross_and_dot_products() {
    let mut numbers = Numbers::new(13);
    let stimuli: Vec<Vec<u64>> = (0..CYCLES).map(|_| (0..4).map(|_| difference(&mut numbers)).collect()).collect();
    let inputs = ["a_x", "a_y", "b_x", "b_y"];
    let mut delay = Delay::new(CrossProduct::LATENCY);
    Cosimulation { name: "cross_product", rust: CrossProduct::default(), inputs: &inputs, outputs: &["product"] }.run(
        stimuli.clone(),
        |values| {
            let [a_x, a_y, b_x, b_y] = [0, 1, 2, 3].map(|k| signed(values[k], 18));
            vec![delay.pass(bits_of(a_x * b_y - a_y * b_x, 36))]
        },
    );
    let mut delay = Delay::new(DotProduct::LATENCY);
    Cosimulation { name: "dot_product", rust: DotProduct::default(), inputs: &inputs, outputs: &["product"] }.run(
        stimuli,
        |values| {
            let [a_x, a_y, b_x, b_y] = [0, 1, 2, 3].map(|k| signed(values[k], 18));
            vec![delay.pass(bits_of(a_x * b_x + a_y * b_y, 36))]
        },
    );
}

#[test]
fn wide_product_of_all_limbs() {
    let mut numbers = Numbers::new(14);
    let limit = 1_i64 << 33;
    let corners = [0, 1, -1, 0x1_ffff, 0x2_0000, -0x1_ffff, -0x2_0000, -0x2_0001, limit - 1, -limit, 1 - limit];
    let mut stimuli = vec![];
    for a in corners {
        stimuli.extend(corners.map(|b| [a, b]));
    }
    stimuli.extend((0..CYCLES).map(|_| [(); 2].map(|()| numbers.bits(34) as i64 - limit)));
    let words = stimuli.into_iter().map(|pair| pair.map(|factor| bits_of(factor.into(), 36) as u64).to_vec());
    let mut delay = Delay::new(WideProduct::LATENCY);
    Cosimulation { name: "wide_product", rust: WideProduct::default(), inputs: &["a", "b"], outputs: &["product"] }
        .run(words, |values| vec![delay.pass(bits_of(signed(values[0], 36) * signed(values[1], 36), 68))]);
}

#[test]
fn edge_signs_compare_signed() {
    let mut numbers = Numbers::new(15);
    let limit = 1_i64 << 32;
    let corners = [0, 1, -1, limit - 1, -limit];
    let stimuli: Vec<Vec<u64>> = (0..CYCLES)
        .map(|_| {
            let mut value = || match numbers.next() % 3 {
                0 => corners[(numbers.next() % 5) as usize],
                1 => numbers.bits(2) as i64 - 2,
                _ => numbers.bits(33) as i64 - limit,
            };
            (0..3).map(|_| bits_of(value().into(), 36) as u64).collect()
        })
        .collect();
    let latency = 2;
    let mut delay = Delay::new(latency);
    Cosimulation {
        name: "edge_signs",
        rust: EdgeSigns::new(latency),
        inputs: &["e0", "e1", "e2"],
        outputs: &EDGE_FLAGS,
    }
    .run(stimuli, |values| {
        let e = [0, 1, 2].map(|k| signed(values[k], 36));
        shown(delay.pass(edge_flags(e)), EDGE_FLAGS.len())
    });
}

#[test]
fn visit_predicates_take_twenty_multipliers() {
    let blocks = incircle_hdl::export::blocks();
    let (name, verilog) = blocks.iter().find(|block| block.0 == "visit_predicates").expect("the block is exported");
    let cells = cell_count(verilog, name).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(cells.multipliers, VisitPredicates::MULTIPLIERS as u64);
    assert_eq!(cells.multipliers, 20);
    assert_eq!((cells.block_ram, cells.distributed_ram), (0, 0));
}
