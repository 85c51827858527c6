//! `CrossProduct`: Rust, Verilog and plain integer arithmetic agree clock by clock.

use crate::rig::cosimulation::{named_ports, Cosimulation, Delay, Numbers};
use crate::rig::visit_points::{bits_of, signed, LARGEST};
use incircle_hdl::predicate::{CrossProduct, DotProduct};

named_ports!([] CrossProduct, [a_x, a_y, b_x, b_y], [product], clock);

const CYCLES: usize = 10_000;

/// Differences of coordinates as 18 bits, and what they stand for.
fn difference(numbers: &mut Numbers) -> u64 {
    let value = match numbers.next() % 4 {
        0 => [0, 1, -1, LARGEST, -LARGEST][(numbers.next() % 5) as usize],
        _ => numbers.bits(16) as i64 - numbers.bits(16) as i64,
    };
    bits_of(value.into(), 18) as u64
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
