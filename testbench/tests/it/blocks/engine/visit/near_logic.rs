//! Runs `NearLogic` in Rust and in Verilog beside plain geometry: all three must agree.

use super::verdict_logic::points;
use crate::rig::nearest::{is_ahead, Nearest};
use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::visit_model::orientation;
use incircle_hdl::engine::NearLogic;
use incircle_testkit::SplitMix64;

named_ports!([] NearLogic, [nearest, edges, first_slot], [verdict]);

const ROUNDS: usize = 20_000;

#[test]
fn near_logic_follows_the_spokes() {
    let mut numbers = SplitMix64::new(83);
    let mut block = Stepper::new("near_logic", NearLogic::default(), 1);
    let mut seen = [[0; 2]; 5];
    for _ in 0..ROUNDS {
        let [r0, r1, r2, p] = points(&mut numbers);
        let (corners, infinite, first) = ([r0, r1, r2], numbers.below(6) as usize, numbers.below(3) as usize);
        let infinite = Some(infinite).filter(|&slot| slot < 3);
        // A triangle turns left; an infinite corner lies anywhere.
        if infinite.is_none() && orientation(r0, r1, r2) <= 0 || r0 == r1 || r1 == r2 || r0 == r2 {
            continue;
        }
        let nearest = Nearest::of(corners, infinite, p);
        let [next, before] = [(nearest.slot + 1) % 3, (nearest.slot + 2) % 3];
        block.set("nearest_slot", nearest.slot as u64);
        block.set("next_is_ahead", is_ahead(corners[nearest.slot], corners[next], p));
        block.set("before_is_ahead", is_ahead(corners[nearest.slot], corners[before], p));
        block.set("next_is_infinite", infinite == Some(next));
        block.set("before_is_infinite", infinite == Some(before));
        for slot in 0..3 {
            let side = orientation(corners[(slot + 1) % 3], corners[(slot + 2) % 3], p);
            block.set(&format!("edges_e{slot}_negative"), side < 0);
            block.set(&format!("edges_e{slot}_zero"), side == 0);
        }
        block.set("first_slot", first as u64);
        block.settle();
        block.expect("verdict", nearest.packed(first));
        let flags = [nearest.begins[0], nearest.begins[1], nearest.goes[0], nearest.goes[1], infinite.is_some()];
        seen.iter_mut().zip(flags).for_each(|(count, flag)| count[usize::from(flag)] += 1);
    }
    assert!(seen.as_flattened().iter().all(|count| *count > ROUNDS / 50), "each flag is often off and on: {seen:?}");
}
