//! Runs `SoloVisit` in Rust and in Verilog beside a statement of the rule: all three must agree over random inputs.

use crate::rig::stepper::bundles::{flip, id, turned, LockFinding, Visit};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::SoloVisit;
use incircle_testkit::SplitMix64;

named_ports!(SoloVisit, [context_id, phase, is_second, root_id, root, triangle], [bundle]);

const ROUNDS: usize = 4000;

#[test]
fn solo_visit_looks_where_each_state_must() {
    let mut random = SplitMix64::new(21);
    let mut block = Stepper::new("solo_visit", SoloVisit::default(), 1);
    for _ in 0..ROUNDS {
        let [root_id, star, outer, back, v, n0, n1, n2] = [(); 8].map(|()| id(&mut random));
        let act = random.below(4);
        let (context, is_second) = (random.below(24), flip(&mut random));
        block.set("context_id", context);
        block.set("is_locate", act == 3);
        block.set("is_mend", act == 0);
        block.set("is_fetch", act == 1);
        block.set("is_second", is_second);
        let lock = LockFinding { took: true, foreign: true, again: true };
        block.set("root", turned([v; 3], [n0, n1, n2], 2, lock, [true; 3]));
        for (port, value) in [("root_id", root_id), ("id", star), ("outer", outer), ("back", back)] {
            block.set(port, value);
        }
        let from = |cavity_record, record| Visit { rotates: true, cavity_record, ..Visit::look(record) };
        let visit = match act {
            0 => from(root_id, if is_second { n2 } else { n1 }),
            1 => Visit::look(star),
            2 => from(back, outer),
            _ => Visit::look(root_id),
        };
        block.settle();
        block.expect("bundle", Visit { context, ..visit }.bundle(1, 0, 0, 0));
    }
}
