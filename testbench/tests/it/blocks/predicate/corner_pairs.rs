//! Runs `CornerPairs` in Rust and in Verilog beside plain integer arithmetic: all three must agree in every clock.

use crate::rig::nearest::{distance, is_ahead};
use crate::rig::stepper::{named_ports, Delay, Stepper};
use crate::rig::visit_points::{bits_of, point, shown, visit};
use incircle_hdl::predicate::CornerPairs;
use incircle_testbench::gate::cell_count;
use incircle_testkit::SplitMix64;

named_ports!([] CornerPairs, [corners, p, r1_by_r2], [flags], clock);

const CYCLES: usize = 10_000;
const FLAGS: [&str; 12] = [
    "nearer_10",
    "nearer_20",
    "nearer_21",
    "equal_10",
    "equal_20",
    "equal_21",
    "ahead_01",
    "ahead_02",
    "ahead_10",
    "ahead_12",
    "ahead_20",
    "ahead_21",
];
/// Clocks from the corners to the product that another block gives.
const PRODUCT: usize = 4;

#[test]
fn corner_pairs_compare_distances_and_angles() {
    let mut numbers = SplitMix64::new(81);
    let visits: Vec<Vec<u64>> = (0..CYCLES).map(|_| visit(&mut numbers)).collect();
    let product = |words: &[u64]| {
        let [r1, r2, p] = [1, 2, 3].map(|place| point(words[place]));
        let dot = (r1.0 - p.0) * (r2.0 - p.0) + (r1.1 - p.1) * (r2.1 - p.1);
        bits_of(dot.into(), 36)
    };
    let stimuli = visits.iter().enumerate().map(|(cycle, words)| {
        let late = cycle.checked_sub(PRODUCT).map_or(0, |before| product(&visits[before]));
        words.iter().copied().map(u128::from).chain([late]).collect::<Vec<u128>>()
    });
    let mut delay = Delay::new(CornerPairs::LATENCY);
    let mut seen = [0; FLAGS.len()];
    let block = Stepper::new("corner_pairs", CornerPairs::default(), 1);
    block.run(&["corners_r0", "corners_r1", "corners_r2", "p", "r1_by_r2"], &FLAGS, stimuli, |values| {
        let [r0, r1, r2, p] = [0, 1, 2, 3].map(|place| point(values[place] as u64));
        let [d0, d1, d2] = [r0, r1, r2].map(|corner| distance(corner, p));
        let ahead = [(r0, r1), (r0, r2), (r1, r0), (r1, r2), (r2, r0), (r2, r1)].map(|(a, b)| is_ahead(a, b, p));
        let flags = [&[d1 < d0, d2 < d0, d2 < d1, d1 == d0, d2 == d0, d2 == d1][..], &ahead].concat();
        seen.iter_mut().zip(&flags).for_each(|(count, &flag)| *count += usize::from(flag));
        shown(delay.pass(flags.into_iter().map(u128::from).collect()), FLAGS.len())
    });
    assert!(seen.iter().all(|count| *count > CYCLES / 50), "each flag is set often: {seen:?}");
}

#[test]
fn corner_pairs_take_ten_multipliers() {
    let blocks = incircle_blocks::blocks();
    let (name, verilog) = blocks.iter().find(|block| block.0 == "corner_pairs").expect("the block is exported");
    let cells = cell_count(verilog, name).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(cells.multipliers, CornerPairs::MULTIPLIERS as u64);
    assert_eq!((cells.multipliers, cells.block_ram), (10, 0));
}
