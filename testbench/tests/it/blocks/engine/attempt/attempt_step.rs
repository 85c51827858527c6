//! Runs `AttemptStep` in Rust and in Verilog beside a plain statement of the rule: all
//! three must agree on random visits.

use crate::rig::attempt_state::State;
use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::AttemptStep;
use incircle_testkit::SplitMix64;

named_ports!(AttemptStep, [held, took, found], [after, step]);

const ROUNDS: usize = 6000;

#[test]
fn attempt_step_counts_visits_entries_triangles_and_locks() {
    let mut random = SplitMix64::new(51);
    let mut block = Stepper::new("attempt_step", AttemptStep::default(), 1);
    let (mut inners, mut ends) = (0, [0; 2]);
    for _ in 0..ROUNDS {
        let before = State::random(&mut random);
        let entries = [2, 64][random.below(2) as usize];
        let y = random.below(entries);
        let case = random.below(6);
        let [no_test, splits, revisits, aborts, overflows] = [0, 1, 2, 3, 4].map(|code| case == code);
        let is_test = !no_test;
        let took = flip(&mut random);
        block.set("attempt", before.packed());
        block.set("entry_bit", 1u64 << y);
        block.set("is_last", before.outstanding == 1);
        block.set("edge_was_passed", before.half_open >> y & 1 == 1);
        for (port, value) in [
            ("took", took),
            ("is_test", is_test),
            ("splits", splits),
            ("revisits", revisits),
            ("aborts", aborts),
            ("overflows", overflows),
        ] {
            block.set(port, value);
        }
        let mut after = before;
        let mut finds_inner = false;
        let passes_root = splits && y == 0 && before.half_open & 3 == 1;
        after.drains |= aborts || overflows;
        after.logged += u64::from(took);
        after.outstanding -= 1;
        after.outstanding += if splits { 2 } else { u64::from(revisits) };
        if splits {
            after.count += 1;
            finds_inner = after.passes(y);
            after.inners += u64::from(finds_inner);
        }
        let is_over = is_test && after.outstanding == 0;
        block.settle();
        block.expect("is_over", is_over);
        block.expect("succeeds", is_over && !after.drains);
        block.expect("finds_inner", finds_inner);
        block.expect("passes_root", passes_root);
        // A visit that is no test changes no state, or begins another one.
        if is_test {
            block.expect("after", after.packed());
        }
        inners += usize::from(finds_inner);
        ends[usize::from(after.drains)] += usize::from(is_over);
    }
    assert!(inners > 200 && ends[0] > 200 && ends[1] > 200, "{inners} {ends:?}");
}
