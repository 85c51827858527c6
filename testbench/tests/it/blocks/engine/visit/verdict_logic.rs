//! Runs `VerdictLogic` in Rust and in Verilog beside plain arithmetic: all three must agree in every clock.

use super::visit_reader::record;
use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::visit_model::{incircle, orientation, verdict_parts, Point, VERDICT_PARTS};
use incircle_hdl::engine::VerdictLogic;
use incircle_testkit::SplitMix64;

named_ports!([] VerdictLogic, [turned, signs], [verdict]);

const CYCLES: usize = 6_000;

const INFINITE: u64 = 0x7fff;

/// Four points, either of few places, so that lines, circles and equal points are common, or of the whole range.
pub fn points(numbers: &mut SplitMix64) -> [Point; 4] {
    let bits = [1, 2, 2, 3, 4, 16][numbers.below(6) as usize];
    let shift = if bits < 16 { [0, 12][numbers.bits(1) as usize] } else { 0 };
    let mut coordinate = || (numbers.bits(bits) << shift) as i64;
    [(); 4].map(|()| (coordinate(), coordinate()))
}

#[test]
fn verdict_logic_agrees_with_the_geometry() {
    let mut numbers = SplitMix64::new(34);
    let mut cases = vec![];
    let stimuli: Vec<Vec<u128>> = (0..4 * CYCLES)
        .map(|_| {
            let [r0, r1, r2, p] = points(&mut numbers);
            let r = [r0, r1, r2];
            let record = record(&mut numbers);
            let slot = numbers.below(3) as usize;
            cases.push((record, slot, r, p));
            let e = [0, 1, 2].map(|k| orientation(r[(k + 1) % 3], r[(k + 2) % 3], p));
            let inside = incircle(r, p);
            let flags = [
                e[0] < 0,
                e[1] < 0,
                e[2] < 0,
                e[0] == 0,
                e[1] == 0,
                e[2] == 0,
                e[1] < e[0],
                e[2] < e[0],
                e[2] < e[1],
                inside > 0,
                inside == 0,
                p < r0,
                p < r1,
                p < r2,
                p == r0,
                p == r1,
                p == r2,
                r0 < r1,
                r0 < r2,
                r1 < r2,
            ];
            let turned = record.turned(slot).pack_turned(slot, [false; 3], INFINITE);
            [&[turned][..], &flags.map(u128::from)].concat()
        })
        .collect();
    let mut cases = cases.into_iter();
    let mut seen = [0; 5];
    Stepper::new("verdict_logic", VerdictLogic::default(), 1).run(
        &[
            "turned",
            "e0_negative",
            "e1_negative",
            "e2_negative",
            "e0_zero",
            "e1_zero",
            "e2_zero",
            "e1_below_e0",
            "e2_below_e0",
            "e2_below_e1",
            "incircle_positive",
            "incircle_zero",
            "p_before_r0",
            "p_before_r1",
            "p_before_r2",
            "p_equals_r0",
            "p_equals_r1",
            "p_equals_r2",
            "r0_before_r1",
            "r0_before_r2",
            "r1_before_r2",
        ],
        &VERDICT_PARTS,
        stimuli,
        |_| {
            let (record, slot, r, p) = cases.next().expect("a case for each stimulus");
            let verdict = record.verdict(slot, r, p, INFINITE);
            seen[0] += usize::from(verdict & 1 == 1);
            seen[1] += usize::from(verdict >> 1 & 1 == 1);
            seen[2] += usize::from(incircle(r, p) == 0 && !r.contains(&p));
            seen[3] += usize::from(record.v.contains(&INFINITE));
            seen[4] += usize::from(slot > 0 && incircle(r, p) == 0 && verdict & 1 == 1);
            verdict_parts(verdict, slot, r, p).to_vec()
        },
    );
    assert!(
        seen.iter().all(|count| *count > CYCLES / 10),
        "conflicts, located, cocircular, ghosts, turned ties: {seen:?}"
    );
}
