//! Runs `MovedStar` in Rust and in Verilog beside a statement of the rules, with a visit in every clock: the corners
//! and the point of a visit come two clocks after its record, and its mark of a torn point three clocks after.

use std::collections::VecDeque;

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::MovedStar;
use incircle_protocol::{Config, TINY};
use incircle_testkit::SplitMix64;

named_ports!(
    MovedStar,
    [moving, start, carried, valid, early, visit, record, arrival, test_fetches, corners, fetched, turned],
    [fetches, fetch_id, corners_after, is_moved, target, turned_after],
    clock
);

const CONTEXTS: usize = 8;

/// What the block must have stored for a context.
#[derive(Clone, Copy, Debug, Default)]
struct Stored {
    vertex: u64,
    target: u64,
    inserts: bool,
    left: u64,
    right: u64,
}

/// What a visit must come to.
#[derive(Clone, Copy, Debug, Default)]
struct Wanted {
    /// Its slots whose corner is the fetched point.
    swapped: [bool; 3],
    is_moved: bool,
    target: u64,
    is_torn: bool,
}

/// A visit.
#[derive(Clone, Copy, Debug, Default)]
struct Visit {
    valid: bool,
    context: usize,
    rotates: bool,
    locks: bool,
    entry: u64,
    after: u64,
    cavity_record: u64,
}

impl Visit {
    fn random(random: &mut SplitMix64) -> Self {
        Self {
            valid: !random.once_in(8),
            context: random.below(CONTEXTS as u64) as usize,
            rotates: !random.once_in(4),
            locks: !random.once_in(4),
            entry: if random.once_in(4) { 0 } else { random.bits(6) },
            after: if random.once_in(3) { 32 } else { random.bits(6) },
            cavity_record: random.bits(7),
        }
    }

    fn set(&self, block: &mut Stepper<MovedStar>, port: &str) {
        block.set(&format!("{port}_context"), self.context as u64);
        block.set(&format!("{port}_rotates"), self.rotates);
        block.set(&format!("{port}_locks"), self.locks);
        block.set(&format!("{port}_entry"), self.entry);
        block.set(&format!("{port}_after"), self.after);
        block.set(&format!("{port}_cavity_record"), self.cavity_record);
    }
}

#[test]
fn stars_of_moves_are_judged_by_the_new_place() {
    let mut random = SplitMix64::new(96);
    let mut block = Stepper::new("moved_star", MovedStar::new(Config { contexts: 8, ..TINY }), 1);
    let mut stored = [Stored::default(); CONTEXTS];
    let mut known = [false; CONTEXTS];
    let mut wanted: VecDeque<Option<Wanted>> = VecDeque::from([None, None, None]);
    let mut seen = [0; 4];
    let mut runs = true;
    let mut early = Visit::default();
    for clock in 0..20_000 {
        if clock % 50 == 0 {
            runs = !random.once_in(4);
        }
        let all_known = known.iter().all(|&known| known);
        // The visit whose record comes in this clock, and the one whose record comes in the next.
        let visit = early;
        early = Visit::random(&mut random);
        // A context takes a vertex, or its chains carry others on, while it has no visit in these stages.
        let is_quiet = |clock: u64| !(1..46).contains(&(clock % 50));
        early.valid &= all_known && !is_quiet(clock + 1);
        let Visit { valid, context, rotates, locks, entry, after, cavity_record } = visit;
        let own = stored[context];
        let slot = random.below(6) as usize;
        let v = [0, 1, 2].map(|k| if k == slot { own.vertex } else { random.bits(15) | 1 << 14 });
        block.set("moving_runs", runs);
        block.set("valid", early.valid);
        early.set(&mut block, "early");
        visit.set(&mut block, "visit");
        for (k, vertex) in v.into_iter().enumerate() {
            block.set(&format!("record_v{k}"), vertex);
        }
        let writes = random.once_in(4);
        let written = if flip(&mut random) { v[random.below(3) as usize] } else { random.bits(15) };
        block.set("arrival_came", writes);
        let test_fetches = random.once_in(6);
        block.set("test_fetches", test_fetches);
        block.set("arrival_id", written);
        let corners = [0; 3].map(|_| random.bits(32));
        let fetched = random.bits(32);
        for (k, corner) in corners.into_iter().enumerate() {
            block.set(&format!("corners_r{k}"), corner);
        }
        block.set("fetched", fetched);
        let again = random.once_in(5);
        let (turned_v0, turned_slot) = (random.bits(15), random.below(3));
        block.set("turned_again", again);
        block.set("turned_v0", turned_v0);
        block.set("turned_slot", turned_slot);
        let changed = random.below(CONTEXTS as u64) as usize;
        let may_change = !all_known || clock % 50 >= 48;
        let takes = may_change && flip(&mut random);
        let new = Stored {
            vertex: random.bits(14),
            target: random.bits(32),
            inserts: random.once_in(3),
            left: random.bits(15),
            right: random.bits(15),
        };
        let [sets_left, sets_right] = [may_change && !random.once_in(3), may_change && !random.once_in(3)];
        block.set("start_takes", takes);
        block.set("start_context", changed as u64);
        block.set("start_id", new.vertex);
        block.set("moving_target", new.target);
        block.set("moving_returns", new.inserts);
        block.set("carried_context", changed as u64);
        block.set("carried_sets_left", sets_left);
        block.set("carried_sets_right", sets_right);
        block.set("carried_left", new.left);
        block.set("carried_right", new.right);
        block.settle();

        let is_out = !runs || own.inserts;
        let goes_round = valid && !is_out && rotates && locks && entry != 0 && after != 32;
        if all_known {
            block.expect("fetches", goes_round);
        }
        if goes_round {
            block.expect("fetch_id", if entry < 32 { own.left } else { own.right });
            seen[0] += 1;
        }
        wanted.push_back(valid.then(|| Wanted {
            swapped: [0, 1, 2].map(|k| goes_round && v[k] == own.vertex),
            is_moved: !is_out && (locks || rotates && cavity_record & 64 != 0),
            target: own.target,
            is_torn: writes && (v.contains(&written) || goes_round || test_fetches),
        }));
        // The visits of two and of three clocks ago.
        if let Some(two) = wanted[1] {
            block.expect("is_moved", two.is_moved);
            if two.is_moved {
                block.expect("target", two.target);
                seen[1] += 1;
            }
            for (k, (swapped, corner)) in two.swapped.into_iter().zip(corners).enumerate() {
                block.expect(&format!("corners_after_r{k}"), if swapped { fetched } else { corner });
                seen[2] += usize::from(swapped);
            }
        }
        if let Some(three) = wanted.pop_front().flatten() {
            block.expect("turned_after_again", again || three.is_torn);
            block.expect("turned_after_v0", turned_v0);
            block.expect("turned_after_slot", turned_slot);
            seen[3] += usize::from(three.is_torn);
        }
        block.edge();
        if takes {
            stored[changed] = Stored { left: stored[changed].left, right: stored[changed].right, ..new };
        }
        if sets_left {
            stored[changed].left = new.left;
        }
        if sets_right {
            stored[changed].right = new.right;
        }
        known[changed] |= takes && sets_left && sets_right;
    }
    assert!(seen.iter().all(|&count| count > 1_000), "{seen:?}");
}
