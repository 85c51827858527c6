//! Runs `AttemptLists` in Rust and in Verilog beside a statement of each rule: all three must agree for every
//! combination of single bits and for random values of the wider inputs.

use crate::rig::attempt_state::State;
use crate::rig::stepper::bundles::{commit_job, flip, id, release_job, turned, Edge, LockFinding, Visit};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::AttemptLists;
use incircle_testkit::SplitMix64;

named_ports!(
    AttemptLists,
    [completion, attempt, after, vertex, since, found, step, fails, stops_at_root],
    [entry, inner, lock, commit, releases]
);

const ROUNDS: usize = 6000;

#[test]
fn attempt_lists_add_what_was_found_and_hand_over_what_was_counted() {
    let mut random = SplitMix64::new(53);
    let mut block = Stepper::new("attempt_lists", AttemptLists::default(), 1);
    for _ in 0..ROUNDS {
        let visit = Visit::random(&mut random);
        let [v0, v1, v2, n0, n1, n2, vertex] = [(); 7].map(|()| id(&mut random));
        let lock = LockFinding { took: flip(&mut random), ..LockFinding::default() };
        let (slot, since) = (random.below(3), random.below(1 << 22));
        let [before, after] = [(); 2].map(|()| State::random(&mut random));
        block.set("visit", visit.packed());
        block.set("turned", turned([v0, v1, v2], [n0, n1, n2], slot, lock, [false; 3]));
        block.set("attempt", before.packed());
        block.set("after", after.packed());
        block.set("vertex", vertex);
        block.set("since", since);
        let ports = ["is_done", "is_root", "settles", "finds_inner", "succeeds", "fails", "stops_at_root"];
        let flags = ports.map(|_| flip(&mut random));
        let [done, is_root, settles, finds_inner, succeeds, fails, stops_at_root] = flags;
        for (port, value) in ports.into_iter().zip(flags) {
            block.set(port, value);
        }
        block.settle();
        block.expect("entry_valid", settles);
        block.expect("entry_place", visit.entry);
        block.expect(
            "entry_entry",
            Edge {
                first_vertex: v2,
                outside_record: visit.record,
                slot,
                cavity_record: visit.cavity_record,
                after: visit.after,
            }
            .entry(),
        );
        block.expect("inner_valid", finds_inner);
        block.expect("inner_place", before.inners);
        block.expect("inner_id", visit.cavity_record);
        block.expect("lock_valid", done && lock.took);
        block.expect("lock_place", if is_root { 0 } else { before.logged });
        block.expect("lock_id", visit.record);
        block.expect("commit_valid", succeeds);
        block.expect("commit_job", commit_job(visit.context, vertex, before.inners, after.logged, since));
        block.expect("releases_valid", fails || stops_at_root);
        block.expect("releases_job", release_job(visit.context, if stops_at_root { 1 } else { after.logged }));
    }
}
