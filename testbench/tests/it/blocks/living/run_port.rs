//! Runs `RunPort` in Rust and in Verilog beside the rules of the protocol: all three must agree.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::living::RunPort;
use incircle_testkit::SplitMix64;

named_ports!(
    RunPort,
    [reset, begins, opcode, signature, contexts, has_mesh, command.valid, command.data, taken, is_over],
    [command.ready, dealt, is_question, is_change, is_delete, is_move, vertex, head, is_active, is_nearest],
    clock
);

const LOCATE: u64 = 8;
const INTERPOLATE: u64 = 9;
const NEAREST: u64 = 10;
const INSERT_AS: u64 = 11;
const DELETE: u64 = 12;
const MOVE: u64 = 13;
const BAD_RANGE: u64 = 2;
const NO_MESH: u64 = 7;

fn reset(block: &mut Stepper<RunPort>) {
    for port in ["begins", "command_valid", "taken"] {
        block.set(port, false);
    }
    block.set("is_over", true);
    block.set("reset", true);
    block.settle();
    block.edge();
    block.set("reset", false);
}

/// A run, and what its reader does.
struct Run {
    opcode: u64,
    count: u64,
    has_mesh: bool,
    contexts: u64,
}

impl Run {
    /// Number of words of the part of an item.
    fn part_words(&self) -> u64 {
        match self.opcode {
            INTERPOLATE => 10,
            NEAREST | INSERT_AS | DELETE | MOVE => 2,
            _ => 4,
        }
    }

    /// Number of words of an item.
    fn item_words(&self) -> u64 {
        if [INSERT_AS, MOVE].contains(&self.opcode) {
            2
        } else {
            1
        }
    }

    fn status(&self) -> u64 {
        match self.has_mesh {
            false => NO_MESH,
            true if self.count * self.part_words() >= 1 << 32 => BAD_RANGE,
            true => 0,
        }
    }

    /// Plays the run up to its end, or up to this many words of items.
    fn play(&self, block: &mut Stepper<RunPort>, random: &mut SplitMix64, most: u64) {
        let signature = random.bits(16);
        block.set("opcode", self.opcode);
        block.set("signature", signature);
        block.set("contexts", self.contexts);
        block.set("has_mesh", self.has_mesh);
        block.set("begins", true);
        block.set("command_valid", random.once_in(2));
        block.settle();
        block.expect("is_active", false);
        block.expect("command_ready", false);
        block.edge();
        block.set("begins", false);
        let status = self.status();
        let (mut words, mut dealt, mut heads) = (0, 0, 0);
        let mut given = Vec::new();
        let (wants_words, takes) = (1 + random.below(3), 1 + random.below(3));
        let mut rest = 4 + random.below(5);
        for clock in 0.. {
            assert!(clock < 60_000, "the run ends");
            let word = if words == 0 { self.count } else { random.bits(32) };
            let offers = random.once_in(wants_words);
            block.set("command_valid", offers);
            block.set("command_data", word);
            block.set("taken", false);
            // The answer is under way until some clocks after the head and the last item.
            let is_done = heads == 1 && (status != 0 || dealt == self.count);
            rest -= u64::from(is_done && rest > 0);
            block.set("is_over", heads == 0 || is_done && rest == 0);
            block.settle();
            if !block.is("is_active") {
                for kind in ["is_question", "is_change", "is_delete", "is_move"] {
                    block.expect(kind, false);
                }
                break;
            }
            if block.is("head_valid") {
                let all = 1 + self.count * self.item_words();
                assert!(status == 0 || words == all, "a refused run is answered behind its words");
                let parts = if status == 0 { self.count } else { 0 };
                block.expect("head_header", self.opcode << 24 | status << 16 | signature);
                block.expect("head_length", self.part_words() * parts);
                block.expect("head_last_beat", self.part_words() / 2 - 1);
                block.expect("head_parts", parts);
                block.expect("is_nearest", self.opcode == NEAREST);
                heads += 1;
            }
            let taken = block.is("dealt_valid") && random.once_in(takes);
            if block.is("dealt_valid") {
                assert_eq!(status, 0, "no item of a refused run is dealt");
                block.expect("dealt_context", dealt % self.contexts);
                block.expect("dealt_item_number", dealt & 0xff_ffff);
                let end = ((dealt + 1) * self.item_words()) as usize;
                block.expect("dealt_item_place", given[end - 1]);
                block.expect("is_question", self.opcode < INSERT_AS);
                block.expect("is_change", self.opcode >= INSERT_AS);
                block.expect("is_delete", self.opcode == DELETE);
                block.expect("is_move", self.opcode == MOVE);
                block.expect("dealt_item_target", given[end - 1]);
                if self.opcode == DELETE {
                    block.expect("vertex", given[end - 1]);
                }
                if self.item_words() == 2 {
                    block.expect("vertex", given[end - 2]);
                    block.expect("dealt_item_vertex", given[end - 2] & 0x7fff);
                }
            }
            let is_taken = offers && block.is("command_ready");
            block.set("taken", taken);
            block.settle();
            block.expect("command_ready", block.get("command_ready"));
            block.edge();
            dealt += u64::from(taken);
            if is_taken {
                if words > 0 {
                    given.push(word);
                }
                words += 1;
                if words > most {
                    return;
                }
            }
        }
        assert_eq!(
            (words, heads),
            (1 + self.count * self.item_words(), 1),
            "all words are taken, and one head is given"
        );
        assert!(status != 0 || dealt == self.count, "all items are dealt");
    }
}

#[test]
fn run_port_deals_the_items_in_turn() {
    let mut random = SplitMix64::new(65);
    let mut block = Stepper::new("living_run_port", RunPort::default(), 1);
    reset(&mut block);
    for number in 0..300 {
        let run = Run {
            opcode: LOCATE + random.below(6),
            count: [0, 1, 5, 60][number % 4],
            has_mesh: !random.once_in(4),
            contexts: 1 + random.below(24),
        };
        run.play(&mut block, &mut random, u64::MAX);
    }
}

#[test]
fn run_port_refuses_a_run_whose_answer_is_too_long() {
    let mut random = SplitMix64::new(66);
    for (opcode, count, is_refused) in [
        (LOCATE, 1 << 30, true),
        (LOCATE, (1 << 30) - 1, false),
        (LOCATE, 0xffff_ffff, true),
        (INTERPOLATE, 429_496_730, true),
        (INTERPOLATE, 429_496_729, false),
        (INTERPOLATE, 1 << 31, true),
        (INSERT_AS, 1 << 31, true),
        (INSERT_AS, (1 << 31) - 1, false),
        (DELETE, 1 << 31, true),
        (MOVE, 1 << 31, true),
        (MOVE, (1 << 31) - 1, false),
        (NEAREST, 1 << 31, true),
        (NEAREST, (1 << 31) - 1, false),
    ] {
        let mut block = Stepper::new("living_run_port", RunPort::default(), 1);
        reset(&mut block);
        let run = Run { opcode, count, has_mesh: true, contexts: 3 };
        assert_eq!(run.status() != 0, is_refused);
        // Its words are passed over, so no item is dealt.
        run.play(&mut block, &mut random, 50);
        reset(&mut block);
        Run { opcode, count: 3, has_mesh: true, contexts: 3 }.play(&mut block, &mut random, u64::MAX);
    }
}

#[test]
fn run_port_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("living_run_port", RunPort::default(), 2);
    reset(&mut block);
    block.set("contexts", 2u64);
    block.set("opcode", 8u64);
    block.set("signature", 0u64);
    block.set("has_mesh", true);
    let mut wave = Wave::default();
    for clock in 0..11 {
        let [begins, valid, taken] = [clock == 0, clock >= 1, clock == 5 || clock == 7];
        let is_over = !(3..9).contains(&clock);
        for (port, value) in [("begins", begins), ("command_valid", valid), ("taken", taken), ("is_over", is_over)] {
            block.set(port, value);
        }
        block.set("command_data", 2u64);
        block.settle();
        let dealt = block.is("dealt_valid");
        let context = if dealt { Cell::Number(block.get("dealt_context")) } else { Cell::Open };
        wave.take(&[
            ("begins", Cell::Bit(begins)),
            ("command_valid", Cell::Bit(valid)),
            ("command_ready", Cell::Bit(block.is("command_ready"))),
            ("head", Cell::Bit(block.is("head_valid"))),
            ("dealt", Cell::Bit(dealt)),
            ("dealt.context", context),
            ("taken", Cell::Bit(taken)),
            ("is_over", Cell::Bit(is_over)),
            ("is_active", Cell::Bit(block.is("is_active"))),
        ]);
        block.edge();
    }
    wave.assert_drawn_in("run_port");
}
