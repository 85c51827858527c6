//! Runs `SoloWrites` in Rust and in Verilog beside a statement of what each state writes: all three must agree.

use crate::rig::stepper::bundles::{link_write, record_write, turned, LockFinding};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::SoloWrites;
use incircle_testkit::SplitMix64;

named_ports!(
    SoloWrites,
    [turn, is_test, vertex, second, third, root_id, root, triangle, beyond, visited, slot],
    [write]
);

/// A finding at a lock on which no write may depend.
const LOCKED: LockFinding = LockFinding { took: true, foreign: true, again: true };

/// Inputs of `SoloWrites` that are ids.
const IDS: [&str; 13] = [
    "vertex",
    "second",
    "third",
    "root_id",
    "triangle_id",
    "a",
    "b",
    "outer",
    "after",
    "preceding",
    "apex",
    "apex_after_a",
    "apex_before_b",
];

#[test]
fn solo_writes_what_each_state_asks_for() {
    let mut random = SplitMix64::new(11);
    let mut block = Stepper::new("solo_writes", SoloWrites::default(), 1);
    for _ in 0..4000 {
        let ids = IDS.map(|_| random.below((1 << 15) - 1));
        let [vertex, second, third, root_id, id, a, b, outer, after, preceding, apex, apex_after_a, apex_before_b] =
            ids;
        for (port, value) in IDS.into_iter().zip(ids) {
            block.set(port, value);
        }
        let [v0, v1, v2, n0, n1, n2] = [(); 6].map(|()| random.below(1 << 15));
        block.set("root", turned([v0, v1, v2], [n0, n1, n2], 1, LOCKED, [true; 3]));
        let (visited, slot) = (random.below(1 << 15), random.below(3));
        block.set("visited", visited);
        block.set("slot", slot);
        let act = random.below(4);
        let step = random.below([3, 2, 3, 3][act as usize]);
        for (port, doing) in [
            ("split1", (0, 0)),
            ("split2", (0, 1)),
            ("split3", (0, 2)),
            ("mend1", (1, 0)),
            ("mend2", (1, 1)),
            ("flip1", (3, 0)),
            ("flip2", (3, 1)),
        ] {
            block.set(port, (act, step) == doing);
        }
        block.set("is_test", act == 2);
        block.settle();
        block.expect(
            "write",
            match (act, step) {
                (0, 0) => record_write(root_id, [vertex, v1, v2], [n0, second, third]),
                (0, 1) => record_write(second, [vertex, v2, v0], [n1, third, root_id]),
                (0, _) => record_write(third, [vertex, v0, v1], [n2, root_id, second]),
                (1, _) => link_write(visited, slot, if step == 0 { second } else { third }),
                (2, _) => link_write(visited, slot, id),
                (_, 0) => record_write(id, [vertex, a, apex], [apex_after_a, outer, preceding]),
                (_, 1) => record_write(outer, [vertex, apex, b], [apex_before_b, after, id]),
                _ => link_write(after, 2, outer),
            },
        );
    }
}
