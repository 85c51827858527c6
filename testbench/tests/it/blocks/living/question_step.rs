//! Runs `QuestionStep` in Rust and in Verilog beside a statement of the rules: all three must agree.

use crate::rig::nearest::Nearest;
use crate::rig::stepper::bundles::{flip, id, Visit};
use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::visit_model::{orientation, Point, Record};
use incircle_hdl::living::QuestionStep;
use incircle_protocol::{Config, TINY};
use incircle_testkit::SplitMix64;

named_ports!(
    QuestionStep,
    [is_nearest, completion, sides, nearest],
    [asks, bundle, arrives, ends, finding, corner],
    clock
);

const ROUNDS: usize = 20_000;
const INFINITE: u64 = 0x7fff;
const MOST_CONTEXTS: Config = Config { contexts: 24, ..TINY };

/// What must follow a visit.
#[derive(Debug, PartialEq, Eq)]
enum Follows {
    /// A visit of this record; in the search along the hull with the end of a hull edge.
    Visit(u64, Option<u64>),
    /// An outcome with three vertices and their weights.
    End(u64, [u64; 3], [u64; 3]),
}

/// What follows the visit of a record that holds the place or not, by the signs of its sides.
fn follows(visit: Visit, record: Record, located: bool, walk_next: u64, sides: [i64; 3]) -> (Follows, bool) {
    let is_search = visit.entry == 1;
    let arrives = located && !is_search;
    if let Some(slot) = record.v.iter().position(|&v| v == INFINITE) {
        let end = record.v[(slot + 1) % 3];
        return match (located, is_search) {
            (true, _) => (Follows::Visit(record.n[(slot + 1) % 3], Some(end)), arrives),
            (false, true) => (Follows::End(4, [end, visit.cavity_record, 0], [0; 3]), false),
            (false, false) => (Follows::Visit(walk_next, None), false),
        };
    }
    if !located {
        return (Follows::Visit(walk_next, None), false);
    }
    let mut named: Vec<usize> = (0..3).filter(|&slot| sides[slot] != 0).collect();
    let outcome = named.len() as u64;
    named.resize(3, 3);
    let vertices = [0, 1, 2].map(|place| record.v.get(named[place]).copied().unwrap_or(0));
    let weights = [0, 1, 2].map(|place| sides.get(named[place]).copied().unwrap_or(0) as u64);
    (Follows::End(outcome, vertices, weights), arrives)
}

/// Three corners of a triangle that turns left, and a place, in a box so small that lines and equal points are common.
fn geometry(random: &mut SplitMix64) -> ([Point; 3], Point) {
    let side = [2, 3, 4, 1 << 16][random.below(4) as usize];
    loop {
        let mut point = || (random.below(side) as i64, random.below(side) as i64);
        let (corners, place) = ([(); 3].map(|()| point()), point());
        if orientation(corners[0], corners[1], corners[2]) > 0 {
            return (corners, place);
        }
    }
}

fn new_block(is_nearest: bool) -> Stepper<QuestionStep> {
    let mut block = Stepper::new("living_question_step", QuestionStep::new(MOST_CONTEXTS), 1);
    block.set("is_nearest", is_nearest);
    block
}

/// Shows a walk in a run of `Nearest` that has come to a record with these chains, and then the visit of the chain to
/// the left, which ends. `holds` says whether the record holds the place.
fn search(block: &mut Stepper<QuestionStep>, random: &mut SplitMix64, holds: bool, begins: [bool; 2]) {
    let record = Record { v: [1, 2, 3], n: [(); 3].map(|()| id(random)) };
    let mut walk = Visit { context: random.below(24), ..Visit::look(id(random)) };
    let slot = random.below(3) as usize;
    let links = record.turned(slot).n;
    let walk_next = id(random);
    block.set("completion_done", true);
    block.set("completion_turned", record.pack_turned(0, [false; 3], INFINITE));
    block.set("completion_visit", walk.packed());
    block.set("located", holds);
    block.set("walk_next", walk_next);
    block.set("nearest", Nearest { slot, begins, goes: begins }.packed(0));
    block.settle();
    let has_chain = begins.contains(&true);
    block.expect("arrives", holds);
    block.expect("ends", holds && !has_chain);
    block.expect("asks", !holds || has_chain);
    if !holds {
        assert_eq!(Visit::of_bundle(block.get("bundle")).record, walk_next);
        block.expect_masked("bundle", 3, 0u128);
    } else if !has_chain {
        block.expect("finding_outcome", 1u64);
        block.expect("finding_v0", record.v[slot]);
    } else {
        let first = Visit::of_bundle(block.get("bundle"));
        assert!(first.rotates && first.cavity_record == walk.record && first.context == walk.context);
        assert_eq!((first.entry, first.record), if begins[1] { (6, links[1]) } else { (2, links[2]) });
        block.expect_masked("bundle", 3, u128::from(begins == [true; 2]));
    }
    block.edge();
    if holds && begins[1] {
        walk = Visit::of_bundle(block.get("bundle"));
        walk.entry = 6;
        block.set("completion_visit", walk.packed());
        block.set("nearest", Nearest { slot: 1, begins, goes: [false; 2] }.packed(0));
        block.settle();
        block.expect("arrives", false);
        block.expect("asks", false);
        block.expect("ends", !begins[0]);
        block.expect("finding_outcome", 1u64);
        block.expect("finding_v0", record.v[1]);
        block.edge();
    }
    block.set("completion_done", false);
    block.settle();
    for port in ["arrives", "asks", "ends"] {
        block.expect(port, false);
    }
    block.edge();
}

#[test]
fn question_step_searches_in_a_run_of_nearest() {
    let mut random = SplitMix64::new(85);
    let mut block = new_block(true);
    for _ in 0..ROUNDS / 10 {
        let [holds, right, left] = [(); 3].map(|()| flip(&mut random));
        search(&mut block, &mut random, holds, [right, left]);
    }
}

#[test]
fn question_step_follows_the_rules() {
    let mut random = SplitMix64::new(61);
    let mut block = new_block(false);
    let mut seen = [0; 5];
    for _ in 0..ROUNDS {
        let (corners, place) = geometry(&mut random);
        let mut record =
            Record { v: [(); 3].map(|()| 1 + random.below(INFINITE - 1)), n: [(); 3].map(|()| id(&mut random)) };
        let is_search = random.once_in(4);
        if is_search || flip(&mut random) {
            record.v[random.below(3) as usize] = INFINITE;
        }
        let visit = Visit {
            context: random.below(24),
            entry: is_search.into(),
            cavity_record: id(&mut random),
            ..Visit::look(id(&mut random))
        };
        let verdict = record.verdict(0, corners, place, INFINITE);
        let (located, walk_next) = (verdict >> 1 & 1 == 1, (verdict >> 5) as u64);
        let sides = [0, 1, 2].map(|k| orientation(corners[(k + 1) % 3], corners[(k + 2) % 3], place));
        let done = !random.once_in(8);
        block.set("completion_done", done);
        block.set("completion_visit", visit.packed());
        block.set("completion_turned", record.pack_turned(0, [false; 3], INFINITE));
        block.set("completion_verdict", verdict);
        for (port, side) in ["sides_flags_e0_zero", "sides_flags_e1_zero", "sides_flags_e2_zero"].into_iter().zip(sides)
        {
            block.set(port, side == 0);
        }
        for (port, side) in ["sides_weights_w0", "sides_weights_w1", "sides_weights_w2"].into_iter().zip(sides) {
            block.set(port, side as u64 & 0xffff_ffff);
        }
        block.settle();
        let (follows, arrives) = follows(visit, record, located, walk_next, sides);
        block.expect("arrives", arrives && done);
        match follows {
            Follows::Visit(next, end) => {
                block.expect("asks", done);
                block.expect("ends", false);
                let found = Visit::of_bundle(block.get("bundle"));
                let wanted = Visit { context: visit.context, entry: end.is_some().into(), ..Visit::look(next) };
                let cavity_record = end.unwrap_or(found.cavity_record);
                assert_eq!(found, Visit { cavity_record, ..wanted });
                block.expect_masked("bundle", 3, 0u128);
                seen[0] += 1;
            }
            Follows::End(outcome, [v0, v1, v2], [w0, w1, w2]) => {
                block.expect("asks", false);
                block.expect("ends", done);
                block.expect("finding_outcome", outcome);
                block.expect("finding_v0", v0);
                block.expect("finding_v1", v1);
                if outcome == 1 {
                    block.expect("corner", v0);
                }
                block.expect("finding_v2", v2);
                block.expect("finding_w0", w0);
                block.expect("finding_w1", w1);
                block.expect("finding_w2", w2);
                seen[outcome as usize] += 1;
            }
        }
    }
    assert!(seen.iter().all(|&count| count > ROUNDS / 100), "visits, then ends by their outcome: {seen:?}");
}
