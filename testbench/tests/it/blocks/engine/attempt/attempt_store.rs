//! Runs `AttemptStore` in Rust and in Verilog beside a plain statement of the rule: all
//! three must agree on random visits.

use crate::rig::attempt_state::State;
use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::AttemptStore;
use incircle_protocol::SMALL;
use incircle_testkit::SplitMix64;

named_ports!(AttemptStore, [ring_capacity, early_visit, visit, found, step, after], [held], clock);

const ROUNDS: usize = 6000;

#[test]
fn attempt_store_has_every_state_at_hand_when_its_visit_completes() {
    let mut random = SplitMix64::new(54);
    let mut block = Stepper::new("attempt_store_small", AttemptStore::new(SMALL), 2);
    let ring = u64::from(SMALL.ring);
    // States are written before they are read, whatever the memory holds at first.
    let mut states = [(); 4].map(|()| None::<State>);
    let (mut context, mut cavity_entry, mut seen) = (0, 0, [0; 4]);
    block.set("ring_capacity", ring);
    for _ in 0..4 * ROUNDS {
        let entries = [2, ring][random.below(2) as usize];
        let (next_context, early_entry) = (random.below(4), random.below(entries));
        let before = states[context as usize];
        let opens = random.below(12) == 0 || before.is_none_or(|state| state.outstanding == 0);
        let splits = !opens && flip(&mut random) && before.is_some_and(|state| state.count < ring);
        let revisits = !opens && !splits && random.below(4) == 0;
        let is_test = !opens && (splits || random.below(4) > 0);
        // No other visit of a context that opens a cavity is out.
        let early_context = if opens && next_context == context { (context + 1) % 4 } else { next_context };
        for (port, value) in [
            ("early_visit_context", early_context),
            ("early_visit_cavity_entry", early_entry),
            ("visit_context", context),
            ("visit_cavity_entry", cavity_entry),
        ] {
            block.set(port, value);
        }
        let mut after = before.unwrap_or_default();
        let passes_root = splits && cavity_entry == 0 && after.half_open & 3 == 1;
        if opens {
            after = State { outstanding: 3, count: 3, logged: 1, ..State::default() };
        } else {
            after.outstanding += if splits { 2 } else { u64::from(revisits) };
            after.outstanding = after.outstanding.saturating_sub(1);
            after.count += u64::from(splits);
            after.logged = random.below(64);
            if splits {
                after.passes(cavity_entry);
            }
        }
        block.set("after", after.packed());
        for (port, value) in [
            ("opens", opens),
            ("is_test", is_test),
            ("splits", splits),
            ("revisits", revisits),
            ("passes_root", passes_root),
        ] {
            block.set(port, value);
        }
        block.settle();
        if let Some(state) = before {
            let flags = [state.outstanding == 1, state.count == ring, state.half_open >> cavity_entry & 1 == 1];
            block.expect("attempt", state.packed());
            block.expect("entry_bit", 1u64 << cavity_entry);
            for ((port, flag), seen) in ["is_last", "is_full", "edge_was_passed"].into_iter().zip(flags).zip(&mut seen)
            {
                block.expect(port, flag);
                *seen += usize::from(flag);
            }
            seen[3] += usize::from(is_test && early_context == context);
        }
        block.edge();
        if is_test || opens {
            states[context as usize] = Some(after);
        }
        (context, cavity_entry) = (early_context, early_entry);
    }
    assert!(seen.iter().all(|times| *times > 100), "{seen:?}");
}
