//! Points that are hard for the predicates of a visit, and the predicates in plain integer arithmetic.
//!
//! The references share no formula with the hardware: orientation is a sum over the corners of the triangle, incircle
//! the 3 x 3 determinant of the lifted points.

use crate::rig::stepper::{Delay, Expected, NamedPorts, Stepper};
use incircle_testkit::SplitMix64;

const CYCLES: usize = 10_000;

pub const LARGEST: i64 = 65535;

pub const EDGE_FLAGS: [&str; 9] = [
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

pub const INCIRCLE_FLAGS: [&str; 2] = ["incircle_positive", "incircle_zero"];

pub const ORDER_FLAGS: [&str; 9] = [
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

pub const POINT_PORTS: [&str; 4] = ["r0", "r1", "r2", "p"];

/// A point; points compare by `x`, then by `y`.
pub type Point = (i64, i64);

pub fn word(point: Point) -> u64 {
    (point.0 | point.1 << 16) as u64
}

pub fn point(word: u64) -> Point {
    ((word & 0xffff) as i64, (word >> 16) as i64)
}

/// Returns `value` in two's complement with `bits` bits.
pub fn bits_of(value: i128, bits: u32) -> u128 {
    value as u128 & ((1 << bits) - 1)
}

/// Twice the signed area of a triangle, by the shoelace formula.
pub fn orientation(a: Point, b: Point, c: Point) -> i128 {
    let corner = |u: Point, v: Point| i128::from(u.0) * i128::from(v.1) - i128::from(v.0) * i128::from(u.1);
    corner(a, b) + corner(b, c) + corner(c, a)
}

/// Determinant of the points lifted to a paraboloid, relative to `p`: positive if `p` lies inside
/// the circle of a counter-clockwise triangle.
pub fn lifted_incircle(triangle: [Point; 3], p: Point) -> i128 {
    let [a, b, c] = triangle.map(|vertex| {
        let (x, y) = (i128::from(vertex.0 - p.0), i128::from(vertex.1 - p.1));
        [x, y, x * x + y * y]
    });
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}

pub fn flags<const N: usize>(values: [bool; N]) -> Vec<u128> {
    values.map(u128::from).to_vec()
}

pub fn edge_flags(e: [i128; 3]) -> Vec<u128> {
    flags([e[0] < 0, e[1] < 0, e[2] < 0, e[0] == 0, e[1] == 0, e[2] == 0, e[1] < e[0], e[2] < e[0], e[2] < e[1]])
}

pub fn order_flags(r: [Point; 3], p: Point) -> Vec<u128> {
    let before = flags([p < r[0], p < r[1], p < r[2]]);
    let equals = flags(r.map(|vertex| p == vertex));
    [before, equals, flags([r[0] < r[1], r[0] < r[2], r[1] < r[2]])].concat()
}

pub fn all_flags(r: [Point; 3], p: Point) -> Vec<u128> {
    let e = [0, 1, 2].map(|k| orientation(r[(k + 1) % 3], r[(k + 2) % 3], p));
    let incircle = lifted_incircle(r, p);
    [edge_flags(e), flags([incircle > 0, incircle == 0]), order_flags(r, p)].concat()
}

/// Outputs of a pipeline: known values, or `None` for each output while the pipeline fills.
pub fn shown(delayed: Option<Vec<u128>>, outputs: usize) -> Vec<Expected> {
    delayed.map_or(vec![None; outputs], |values| values.into_iter().map(Some).collect())
}

/// Four points, as the ports take them; the calls cycle through all the dangerous parts of the input space.
pub fn visit(numbers: &mut SplitMix64) -> Vec<u64> {
    let bits = [16, 16, 16, 4, 2, 8][numbers.below(6) as usize];
    let random = |numbers: &mut SplitMix64| (numbers.bits(bits) as i64, numbers.bits(bits) as i64);
    let mut points = [(); 4].map(|()| random(numbers));
    match numbers.below(8) {
        0 => points = points.map(|(x, y)| ((x & 1) * LARGEST, (y & 1) * LARGEST)),
        1 => points[3] = points[numbers.below(3) as usize],
        2 => {
            // All four points lie on one line through the corner at the origin.
            let (x, y) = (numbers.bits(6) as i64, numbers.bits(6) as i64);
            points = points.map(|(k, _)| (x * (k & 0x3ff), y * (k & 0x3ff)));
        }
        3 => {
            // All four points lie on one circle: they are reflections of one vector about a centre.
            let (x, y) = (numbers.bits(15) as i64, numbers.bits(15) as i64);
            let around = [(x, y), (-y, x), (-x, -y), (y, -x), (-x, y), (x, -y), (y, x)];
            points = points.map(|_| {
                let turn = around[numbers.below(7) as usize];
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

pub fn run_visits<U: NamedPorts>(
    name: &str,
    rust: U,
    outputs: &[&str],
    latency: usize,
    reference: impl Fn([Point; 3], Point) -> Vec<u128>,
) {
    let mut numbers = SplitMix64::new(11);
    let mut corners = vec![];
    for code in 0..256_u64 {
        let corner =
            |k: u64| word(((code >> (2 * k) & 1) as i64 * LARGEST, (code >> (2 * k + 1) & 1) as i64 * LARGEST));
        corners.push(vec![corner(0), corner(1), corner(2), corner(3)]);
    }
    corners.extend((0..CYCLES).map(|_| visit(&mut numbers)));
    let mut delay = Delay::new(latency);
    Stepper::new(name, rust, 1).run(&POINT_PORTS, outputs, corners, |values| {
        let r = [point(values[0]), point(values[1]), point(values[2])];
        shown(delay.pass(reference(r, point(values[3]))), outputs.len())
    });
}

pub fn signed(value: u64, bits: u32) -> i128 {
    i128::from(((value << (64 - bits)) as i64) >> (64 - bits))
}

/// Inputs of a product of two vectors.
pub const DIFFERENCE_PORTS: [&str; 4] = ["a_x", "a_y", "b_x", "b_y"];

/// Returns a difference of two coordinates in 18 bits.
fn difference(numbers: &mut SplitMix64) -> u64 {
    let value = match numbers.below(4) {
        0 => [0, 1, -1, LARGEST, -LARGEST][numbers.below(5) as usize],
        _ => numbers.bits(16) as i64 - numbers.bits(16) as i64,
    };
    bits_of(value.into(), 18) as u64
}

/// Values for [`DIFFERENCE_PORTS`]: differences of coordinates.
pub fn difference_stimuli() -> Vec<Vec<u64>> {
    let mut numbers = SplitMix64::new(13);
    (0..CYCLES).map(|_| (0..4).map(|_| difference(&mut numbers)).collect()).collect()
}
