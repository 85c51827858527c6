//! Parts of the control blocks that hold no state: Rust, Verilog and a statement of each rule agree over random inputs.

use crate::rig::stepper::bundles::{flip, id, turned, LockFinding, Visit};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::SoloVisit;
use incircle_hdl::link::{CommandGate, RecordWords};
use incircle_protocol::{Layout, CORE_COORD_BITS, MAX_POINTS};

named_ports!(SoloVisit, [owner, is_locate, is_mend, is_second, is_fetch, root_id, root, id, outer, back], [bundle]);
named_ports!(
    CommandGate,
    [command.valid, command.data, state, sweeps, none_is_left, came, engine], [command.ready, taken, awaits_point]
);
named_ports!(RecordWords, [record], [word0, word1, word2]);

const ROUNDS: usize = 4000;

#[test]
fn solo_visit_looks_where_each_state_must() {
    let mut random = SplitMix64::new(21);
    let mut block = Stepper::new("solo_visit", SoloVisit::default(), 1);
    for _ in 0..ROUNDS {
        let [root_id, star, outer, back, v, n0, n1, n2] = [(); 8].map(|()| id(&mut random));
        let act = random.below(4);
        let (owner, is_second) = (random.below(24), flip(&mut random));
        block.set("owner", owner);
        block.set("is_locate", act == 3);
        block.set("is_mend", act == 0);
        block.set("is_fetch", act == 1);
        block.set("is_second", is_second);
        let lock = LockFinding { took: true, foreign: true, again: true };
        block.set("root", turned([v; 3], [n0, n1, n2], 2, lock, [true; 3]));
        for (port, value) in [("root_id", root_id), ("id", star), ("outer", outer), ("back", back)] {
            block.set(port, value);
        }
        let from = |f, u| Visit { rotates: true, f, ..Visit::look(u) };
        let visit = match act {
            0 => from(root_id, if is_second { n2 } else { n1 }),
            1 => Visit::look(star),
            2 => from(back, outer),
            _ => Visit::look(root_id),
        };
        block.settle();
        block.expect("bundle", Visit { owner, ..visit }.bundle(1, 0, 0, 0));
    }
}

#[test]
fn command_gate_waits_for_the_point_before_and_the_first_triangle() {
    let mut random = SplitMix64::new(23);
    let mut block = Stepper::new("command_gate", CommandGate::default(), 1);
    for _ in 0..ROUNDS {
        let meaning = random.below(4);
        let [valid, sweeps, none_is_left, came, start_is_open, stuck] = [(); 6].map(|()| flip(&mut random));
        for (port, value) in [
            ("command_valid", valid),
            ("sweeps", sweeps),
            ("none_is_left", none_is_left),
            ("came", came),
            ("start_is_open", start_is_open),
            ("stuck", stuck),
        ] {
            block.set(port, value);
        }
        let word = if flip(&mut random) { random.below(1 << 32) } else { 0 };
        block.set("command_data", word);
        // The states are, in order, a command, two arguments, points, and two without words.
        block.set("state", [0, 1 + random.below(2), 3, 4 + random.below(2)][meaning as usize]);
        let is_undecided = start_is_open && !stuck;
        let ready = match meaning {
            0 => !sweeps,
            1 => true,
            2 => !(none_is_left || came || is_undecided),
            _ => false,
        };
        block.settle();
        block.expect("command_ready", ready);
        block.expect("taken_word", word);
        block.expect("is_command", valid && ready && meaning == 0 && word != 0);
        block.expect("is_point", valid && ready && meaning == 2);
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
