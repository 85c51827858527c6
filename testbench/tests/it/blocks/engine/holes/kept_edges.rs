//! Runs `KeptEdges` in Rust and in Verilog beside a statement of the rules for each kind of visit: all three must
//! agree.

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::KeptEdges;
use incircle_testkit::SplitMix64;

named_ports!(
    KeptEdges,
    [visit, turned, opens, names1, names2, is_outside, is_last_edge, goes_round, flags, conflict, turns_left],
    [keeps, carried]
);

/// The kind of a visit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// The root, with the vertex in this slot.
    Root(usize),
    Outside,
    LastEdge,
    /// A record of the star, of the chain to the left or to the right.
    Star {
        is_left: bool,
    },
}

#[test]
fn edges_stay_where_every_visit_says_so() {
    let mut random = SplitMix64::new(93);
    let mut block = Stepper::new("kept_edges", KeptEdges::default(), 1);
    let mut seen = [[0; 2]; 5];
    for _ in 0..6_000 {
        let kinds = [
            Kind::Root(random.below(3) as usize),
            Kind::Outside,
            Kind::LastEdge,
            Kind::Star { is_left: true },
            Kind::Star { is_left: false },
        ];
        let number = random.below(5) as usize;
        let kind = kinds[number];
        let entry = match kind {
            Kind::Star { is_left: true } => 1 + random.below(31),
            Kind::Star { is_left: false } => 32 + random.below(32),
            _ => random.bits(6),
        };
        // The slot of the record that comes first; a root comes as stored.
        let first = if matches!(kind, Kind::Root(_)) { 0 } else { random.below(3) as usize };
        // The sign of the point against each side of the corners as stored.
        let signs = [0; 3].map(|_| random.below(3));
        let [conflict, turns_left, counts] = [flip(&mut random), flip(&mut random), flip(&mut random)];
        let v = [0; 3].map(|_| random.bits(15));
        let context = random.below(24);
        block.set("visit_context", context);
        block.set("visit_entry", entry);
        block.set("turned_slot", first as u64);
        for k in 0..3 {
            block.set(&format!("turned_v{k}"), v[k]);
            block.set(&format!("flags_e{k}_negative"), signs[k] == 0);
            block.set(&format!("flags_e{k}_zero"), signs[k] == 1);
        }
        let is_star = matches!(kind, Kind::Star { .. });
        let goes_round = is_star && counts;
        for (port, value) in [
            ("opens", matches!(kind, Kind::Root(_))),
            ("names1", kind == Kind::Root(1)),
            ("names2", kind == Kind::Root(2)),
            ("is_outside", kind == Kind::Outside),
            ("is_last_edge", kind == Kind::LastEdge),
            ("goes_round", goes_round),
            ("conflict", conflict),
            ("turns_left", turns_left),
        ] {
            block.set(port, value);
        }
        block.settle();
        let turns = |turned_slot: usize| signs[(first + turned_slot) % 3] == 2;
        let keeps = match kind {
            Kind::Root(slot) => turns(slot),
            Kind::Outside => !conflict,
            Kind::LastEdge => !turns_left || conflict,
            // The vertex stands in slot 1 to the left, and in slot 2 to the right.
            Kind::Star { is_left } => turns(if is_left { 1 } else { 2 }) && (!turns_left || conflict),
        };
        block.expect("keeps", keeps);
        seen[number][usize::from(keeps)] += 1;
        let (left, right) = match kind {
            Kind::Root(slot) => (Some(v[(slot + 1) % 3]), Some(v[(slot + 2) % 3])),
            Kind::Star { is_left: true } if counts => (Some(v[2]), None),
            Kind::Star { is_left: false } if counts => (None, Some(v[1])),
            _ => (None, None),
        };
        for (port, id, wanted) in
            [("carried_sets_left", "carried_left", left), ("carried_sets_right", "carried_right", right)]
        {
            block.expect(port, wanted.is_some());
            if let Some(wanted) = wanted {
                block.expect(id, wanted);
                block.expect("carried_context", context);
            }
        }
    }
    assert!(seen.as_flattened().iter().all(|&count| count > 200), "{seen:?}");
}
