//! Parts of the control blocks that hold no state: Rust, Verilog and a statement of each rule agree over random inputs.

mod block_ports;
mod stepper;

use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::{PushChoice, SoloVisit, StarId};
use incircle_hdl::link::{CommandGate, RecordWords};
use incircle_protocol::{Layout, CORE_COORD_BITS, MAX_POINTS};
use stepper::bundles::{turned, Edge, Visit};
use stepper::{named_ports, Stepper};

named_ports!(StarId, [ahead, ahead_is_first, current, first, inner_id, inner_is_used_up, records], [id, shares]);
named_ports!(SoloVisit, [is_mend, is_second, is_fetch, root_id, root, id, outer, back], [bundle]);
named_ports!(
    PushChoice,
    [looks, look_id, opens, root_bundle, split, split_bundle, solo_push, solo_bundle],
    [push, bundle]
);
named_ports!(
    CommandGate,
    [is_command, is_argument, is_points, sweeps, none_is_left, point_waits, arrived, seeded, collinear],
    [ready, awaits_point]
);
named_ports!(RecordWords, [v0, v1, v2, n0, n1, n2, was_set], [word0, word1, word2]);

const ROUNDS: usize = 4000;

fn id(random: &mut SplitMix64) -> u64 {
    random.below(1 << 15)
}

fn flip(random: &mut SplitMix64) -> bool {
    random.below(2) == 1
}

#[test]
fn star_id_takes_an_id_that_nobody_has() {
    let mut random = SplitMix64::new(20);
    let mut block = Stepper::new("star_id", StarId::default(), 1);
    for _ in 0..ROUNDS {
        // Few triangles, so that they meet; ids that differ in one bit alone.
        let base = id(&mut random);
        let [ahead, current, first] = [(); 3].map(|()| Edge {
            a: id(&mut random),
            u: id(&mut random),
            slot: random.below(3),
            f: base ^ (random.below(2) << random.below(15)),
            after: random.below(64),
        });
        let (closes, used_up) = (flip(&mut random), flip(&mut random));
        let (inner, records) = (id(&mut random), id(&mut random));
        for (port, edge) in [("ahead", ahead), ("current", current), ("first", first)] {
            block.set(port, edge.entry());
        }
        block.set("ahead_is_first", closes);
        block.set("inner_id", inner);
        block.set("inner_is_used_up", used_up);
        block.set("records", records);
        let has_gone = [current.f, first.f].contains(&ahead.f);
        let (shares, expected) = match (closes, has_gone, used_up) {
            (true, _, _) => (false, first.f),
            (false, false, _) => (false, ahead.f),
            (false, true, false) => (true, inner),
            (false, true, true) => (true, records),
        };
        block.settle();
        block.expect("shares", shares);
        block.expect("id", expected);
    }
}

#[test]
fn solo_visit_looks_where_each_state_must() {
    let mut random = SplitMix64::new(21);
    let mut block = Stepper::new("solo_visit", SoloVisit::default(), 1);
    for _ in 0..ROUNDS {
        let [root_id, star, outer, back, v, n0, n1, n2] = [(); 8].map(|()| id(&mut random));
        let act = random.below(3);
        let is_second = flip(&mut random);
        block.set("is_mend", act == 0);
        block.set("is_fetch", act == 1);
        block.set("is_second", is_second);
        block.set("root", turned([v; 3], [n0, n1, n2], 2, true, [true; 3]));
        for (port, value) in [("root_id", root_id), ("id", star), ("outer", outer), ("back", back)] {
            block.set(port, value);
        }
        let from = |f, u| Visit { rotates: true, f, ..Visit::look(u) };
        let visit = match act {
            0 => from(root_id, if is_second { n2 } else { n1 }),
            1 => Visit::look(star),
            _ => from(back, outer),
        };
        block.settle();
        block.expect("bundle", visit.bundle(false, [0; 3]));
    }
}

#[test]
fn push_choice_hands_on_the_one_that_asks() {
    let mut random = SplitMix64::new(22);
    let mut block = Stepper::new("push_choice", PushChoice::default(), 1);
    for _ in 0..ROUNDS {
        let bundles = [(); 3].map(|()| (u128::from(random.next_u64()) << 64 | u128::from(random.next_u64())) >> 50);
        let look = id(&mut random);
        let asks = random.below(5);
        for (code, (port, bundle)) in
            ["root_bundle", "split_bundle", "solo_bundle"].into_iter().zip(bundles).enumerate()
        {
            block.set(port, bundle);
            block.set(["opens", "split", "solo_push"][code], asks == code as u64);
        }
        block.set("look_id", look);
        block.set("looks", asks == 3);
        block.settle();
        block.expect("push", asks < 4);
        match asks {
            0..=2 => block.expect("bundle", bundles[asks as usize]),
            3 => block.expect("bundle", Visit::look(look).bundle(false, [0; 3])),
            _ => {}
        }
    }
}

#[test]
fn command_gate_waits_for_the_point_before_and_the_first_triangle() {
    let mut random = SplitMix64::new(23);
    let mut block = Stepper::new("command_gate", CommandGate::default(), 1);
    for _ in 0..ROUNDS {
        let meaning = random.below(4);
        let [sweeps, none_is_left, point_waits, seeded, collinear] = [(); 5].map(|()| flip(&mut random));
        let arrived = [3, 3 | (1 << random.below(15)), random.below(6), id(&mut random)][random.below(4) as usize];
        for (port, value) in [
            ("is_command", meaning == 0),
            ("is_argument", meaning == 1),
            ("is_points", meaning == 2),
            ("sweeps", sweeps),
            ("none_is_left", none_is_left),
            ("point_waits", point_waits),
            ("seeded", seeded),
            ("collinear", collinear),
        ] {
            block.set(port, value);
        }
        block.set("arrived", arrived);
        let is_undecided = arrived == 3 && !(seeded || collinear);
        let ready = match meaning {
            0 => !sweeps,
            1 => true,
            2 => !(none_is_left || point_waits || is_undecided),
            _ => false,
        };
        block.settle();
        block.expect("ready", ready);
        block.expect("awaits_point", meaning == 2 && !none_is_left);
    }
}

#[test]
fn record_words_are_those_of_the_protocol() {
    let mut random = SplitMix64::new(24);
    let mut block = Stepper::new("record_words", RecordWords::default(), 1);
    let layout = Layout::of(CORE_COORD_BITS, MAX_POINTS);
    for _ in 0..ROUNDS {
        let columns = [(); 6].map(|()| [0, 0x7fff, random.below(1 << 15)][random.below(3) as usize] as u32);
        let [v0, v1, v2, n @ ..] = columns;
        let lock = flip(&mut random);
        for (port, value) in ["v0", "v1", "v2", "n0", "n1", "n2"].into_iter().zip(columns) {
            block.set(port, value);
        }
        block.set("was_set", lock);
        block.settle();
        let words = layout.record_to_words([v0, v1, v2], n, lock);
        for (port, word) in ["word0", "word1", "word2"].into_iter().zip(words) {
            block.expect(port, word);
        }
    }
}
