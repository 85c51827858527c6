//! Runs `NearCorner` in Rust and in Verilog beside plain arithmetic: all three must agree in every clock.

use super::verdict_logic::points;
use super::visit_reader::record;
use crate::rig::nearest::{distance, is_ahead};
use crate::rig::stepper::{named_ports, Delay, Stepper};
use crate::rig::visit_model::{word, Point, Record};
use incircle_hdl::engine::NearCorner;
use incircle_testkit::SplitMix64;

named_ports!([] NearCorner, [corners, rotated, pairs], [nearest], clock);

const CYCLES: usize = 8_000;
const INFINITE: u64 = 0x7fff;
/// Clocks from the corners to their comparisons.
const PAIRS: usize = 5;

/// Corners that differ, a place, the record and the slot that comes first.
type Case = ([Point; 3], Point, Record, usize);

fn case(numbers: &mut SplitMix64) -> Case {
    loop {
        let [r0, r1, r2, p] = points(numbers);
        if r0 != r1 && r0 != r2 && r1 != r2 {
            return ([r0, r1, r2], p, record(numbers), numbers.below(3) as usize);
        }
    }
}

fn pairs(&([r0, r1, r2], p, ..): &Case) -> u128 {
    let [d0, d1, d2] = [r0, r1, r2].map(|corner| distance(corner, p));
    let ahead = [(r0, r1), (r0, r2), (r1, r0), (r1, r2), (r2, r0), (r2, r1)].map(|(a, b)| is_ahead(a, b, p));
    let flags = [&[d1 < d0, d2 < d0, d2 < d1, d1 == d0, d2 == d0, d2 == d1][..], &ahead].concat();
    flags.iter().enumerate().map(|(bit, &flag)| u128::from(flag) << bit).sum()
}

#[test]
fn near_corner_chooses_the_nearest_and_the_smallest_of_a_tie() {
    let mut numbers = SplitMix64::new(82);
    let cases: Vec<Case> = (0..CYCLES).map(|_| case(&mut numbers)).collect();
    let stimuli = cases.iter().enumerate().map(|(cycle, (corners, _, record, slot))| {
        let rotated = record.turned(*slot).pack_turned(*slot, [false; 3], INFINITE);
        let late = cycle.checked_sub(PAIRS).map_or(0, |before| pairs(&cases[before]));
        [&corners.map(|corner| u128::from(word(corner)))[..], &[rotated, late]].concat()
    });
    let mut delay = Delay::new(NearCorner::LATENCY);
    let (mut cycle, mut ties, mut slots) = (0, 0, [0; 3]);
    Stepper::new("near_corner", NearCorner::default(), 1).run(
        &["corners_r0", "corners_r1", "corners_r2", "rotated", "pairs"],
        &["nearest_slot", "next_is_ahead", "before_is_ahead", "next_is_infinite", "before_is_infinite"],
        stimuli,
        |_| {
            let (corners, p, record, _) = cases[cycle];
            cycle += 1;
            let is_infinite = |slot: usize| record.v[slot] == INFINITE;
            let finite = || (0..3).filter(|&slot| !is_infinite(slot));
            let slot = finite().min_by_key(|&slot| (distance(corners[slot], p), corners[slot])).unwrap_or(0);
            let least = distance(corners[slot], p);
            ties += usize::from(finite().filter(|&slot| distance(corners[slot], p) == least).count() > 1);
            slots[slot] += 1;
            let [next, before] = [(slot + 1) % 3, (slot + 2) % 3];
            let ahead =
                |far: usize| Some(u128::from(is_ahead(corners[slot], corners[far], p))).filter(|_| !is_infinite(far));
            let infinite = |far: usize| Some(u128::from(is_infinite(far)));
            let found = vec![Some(slot as u128), ahead(next), ahead(before), infinite(next), infinite(before)];
            delay.pass(found).unwrap_or(vec![None; 5])
        },
    );
    assert!(ties > CYCLES / 50 && slots.iter().all(|count| *count > CYCLES / 10), "{ties} ties; slots: {slots:?}");
}
