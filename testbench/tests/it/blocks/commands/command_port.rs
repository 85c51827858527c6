//! Runs the command stream in Rust and in Verilog beside a list of the words that are wanted: all three must agree in
//! every clock, with a host that pauses, an engine and a responder that take their time, and resets.

use std::collections::VecDeque;

use crate::rig::command_reference::{Meaning, Pins, Reference, Shape, Surroundings};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::commands::CommandPort;
use incircle_protocol::{batch_word, clear_word, command_word, Opcode, CLEAR_MESHES_SHIFT, CLEAR_TAG_SHIFT, PADDING};
use incircle_testkit::SplitMix64;

named_ports!(
    CommandPort,
    [reset, capacity, built, command.valid, command.data, sweeps, engine, answer],
    [command.ready, arrival, clearing, deal, answers, request, tally, activity],
    clock
);

/// Words of a random command.
fn command(random: &mut SplitMix64) -> Vec<u32> {
    match random.below(14) {
        12 => vec![PADDING; 1 + random.below(3) as usize],
        13 => vec![
            command_word(Opcode::Triangles) | random.below(16) as u32,
            random.next_u64() as u32,
            random.next_u64() as u32,
        ],
        0 => vec![command_word(Opcode::Hello)],
        1 | 2 => {
            let contexts = [0, random.below(6) as u32, random.below(300) as u32][random.below(3) as usize];
            let jobs = [0, 1 + random.below(6) as u32, random.below(128) as u32][random.below(3) as usize];
            let word = if random.below(2) == 0 { clear_word(contexts) } else { batch_word(contexts) };
            vec![word | jobs << CLEAR_MESHES_SHIFT | (random.below(256) as u32) << CLEAR_TAG_SHIFT]
        }
        3 => vec![command_word(Opcode::Counters)],
        4 => vec![(random.below(256) as u32 | 8) << 24],
        5 | 6 => vec![command_word(Opcode::Read), random.next_u64() as u32, random.next_u64() as u32],
        _ => {
            let points = random.below(10) as u32;
            let mut words = vec![command_word(Opcode::Insert), points];
            words.extend((0..points).map(|_| random.next_u64() as u32));
            words
        }
    }
}

/// Outputs of the last clock, for a wave.
#[derive(Clone, Copy, Debug, Default)]
struct Shown {
    ready: bool,
    came: Option<(u32, u32)>,
    is_quiet: bool,
    answers: bool,
}

/// The command port between a host and the surroundings that the test plays.
struct Rig {
    block: Stepper<CommandPort>,
    random: SplitMix64,
    reference: Reference,
    around: Surroundings,
    shape: Shape,
    words: VecDeque<u32>,
    is_offered: bool,
    refused: u32,
    /// Number of answers that were due while the core was stuck.
    stuck_answers: u32,
    shown: Shown,
}

impl Rig {
    fn new(shape: Shape) -> Self {
        let mut rig = Self {
            block: Stepper::new("command_port", CommandPort::default(), 1),
            random: SplitMix64::new(shape.capacity.into()),
            reference: Reference::new(shape),
            around: Surroundings::default(),
            shape,
            words: VecDeque::new(),
            is_offered: false,
            refused: 0,
            stuck_answers: 0,
            shown: Shown::default(),
        };
        rig.block.set("capacity", shape.capacity);
        rig.block.set("built", shape.contexts);
        rig.reset();
        rig
    }

    fn reset(&mut self) {
        self.block.set("reset", true);
        self.block.settle();
        self.block.edge();
        self.block.set("reset", false);
        self.reference = Reference::new(self.shape);
        self.around = Surroundings { sweeping: self.random.below(20), ..Surroundings::default() };
        self.words.clear();
        self.is_offered = false;
    }

    fn pins(&self) -> Pins {
        Pins {
            is_quiet: self.around.busy == 0 && self.reference.came.is_none(),
            responder_is_idle: self.around.answering == 0,
            answer_ends: self.around.answering == 1,
        }
    }

    fn clock(&mut self, pace: u64) {
        self.is_offered |= !self.words.is_empty() && self.random.below(100) < pace;
        let pins = self.pins();
        self.around.answer_is_taken = self.random.below(100) < pace;
        let data = if self.is_offered { self.words[0] } else { self.random.next_u64() as u32 };
        self.set_pins(pins, data);
        let ready = self.reference.is_ready(&self.around);
        self.block.expect("command_ready", ready);
        self.block.set("command_valid", self.is_offered);
        self.block.settle();
        // The port must not wait for `command_valid`.
        self.block.expect("command_ready", ready);
        self.expect();
        let answers = self.reference.answers_now();
        self.shown = Shown { ready, came: self.reference.came, is_quiet: pins.is_quiet, answers };
        self.block.edge();
        let word = if ready && self.is_offered { self.words.pop_front() } else { None };
        self.is_offered &= word.is_none();
        let refused = self.reference.refused;
        let around = self.around;
        self.live();
        self.reference.edge(word, pins, &around, self.shape);
        self.refused += u32::from(self.reference.refused > refused);
        self.stuck_answers += u32::from(self.reference.answers && !answers && around.stuck);
    }

    fn set_pins(&mut self, pins: Pins, data: u32) {
        for (port, value) in [
            ("sweeps", self.around.sweeping > 0),
            ("start_is_open", self.reference.start_is_open(&self.around)),
            ("collinear", self.around.collinear),
            ("is_quiet", pins.is_quiet),
            ("stuck", self.around.stuck),
            ("answer_is_idle", pins.responder_is_idle),
            ("answer_ends", pins.answer_ends),
            ("answer_is_taken", self.around.answer_is_taken),
            // Wrong values first: no output that is read now may depend on these inputs.
            ("command_valid", !self.is_offered),
        ] {
            self.block.set(port, value);
        }
        self.block.set("command_data", data);
        self.block.settle();
    }

    fn expect(&self) {
        let (block, reference) = (&self.block, &self.reference);
        for (port, expected) in [
            ("came", reference.came.is_some()),
            ("clears", reference.clears),
            ("is_checking", reference.checked.is_some()),
            ("answers", reference.answers_now()),
            ("inserting", reference.inserting),
            ("reading", reference.reading),
            ("awaits_point", reference.wants.front() == Some(&Meaning::Point)),
        ] {
            block.expect(port, expected);
        }
        let (id, point) = (reference.came.map(|point| point.0), reference.came.map(|point| point.1));
        block.expect("deal", reference.deal().bits());
        for (port, expected) in [
            ("arrival_id", id),
            ("point", point),
            ("opcode", reference.opcode.map(u32::from)),
            ("first", reference.first),
            ("count", reference.count),
            ("has_short_ids", reference.ids.map(|(is_short, _)| is_short.into())),
            ("has_rests", reference.ids.map(|(_, has_rests)| has_rests.into())),
            ("is_refused", reference.is_refused.map(u32::from)),
            ("tag", Some(reference.tag.into())),
            ("arrived", Some(reference.arrived)),
            ("refused", Some(reference.refused)),
            ("some_refused", Some((reference.refused > 0).into())),
        ] {
            if let Some(expected) = expected {
                block.expect(port, expected);
            }
        }
    }

    /// Lets the engine and the responder go on for a clock.
    fn live(&mut self) {
        let around = &mut self.around;
        around.sweeping = around.sweeping.saturating_sub(1);
        if !around.stuck {
            around.stuck = self.random.below(1500) == 0;
            around.busy = around.busy.saturating_sub(1);
        }
        if around.busy == 0 && around.triple_is_in && !around.seeded && !around.collinear {
            around.collinear = self.random.below(4) == 0;
            around.seeded = !around.collinear;
        }
        if let Some((id, _)) = self.reference.came {
            around.busy = 1 + self.random.below(12);
            around.triple_is_in |= id == 2;
        }
        if around.answering > 0 {
            around.answering -= 1;
        } else if self.reference.answers_now() {
            around.answering = 1 + self.random.below(12);
        }
        if self.reference.clears {
            (around.seeded, around.collinear, around.triple_is_in) = (false, false, false);
            // A clear sweeps the histogram for a number of clocks.
            around.sweeping = self.random.below(20);
        }
    }
}

fn run(capacity: u32, contexts: u32, pace: u64) {
    let mut rig = Rig::new(Shape { capacity, contexts });
    for _ in 0..8000 {
        if rig.random.below(if rig.around.stuck { 100 } else { 700 }) == 0 {
            rig.reset();
        }
        if rig.words.is_empty() {
            rig.words.extend(command(&mut rig.random));
        }
        rig.clock(pace);
    }
    assert!(rig.refused > 0, "some points are refused");
    assert!(rig.stuck_answers > 0, "some answers come although the core is stuck");
}

#[test]
fn command_port_at_full_speed() {
    run(8, 2, 100);
}

#[test]
fn command_port_with_a_slow_host() {
    run(4, 1, 30);
}

#[test]
fn command_port_with_a_slower_host_and_a_large_memory() {
    run(16384, 24, 60);
}

/// Inserts three points into an empty core.
#[test]
fn command_port_shows_the_wave_of_its_header() {
    let mut rig = Rig::new(Shape { capacity: 8, contexts: 2 });
    rig.around.sweeping = 2;
    rig.words = [command_word(Opcode::Insert), 3, 0x70005, 0x90008, 0x10002].into();
    let mut wave = Wave::default();
    for _ in 0..16 {
        let sweeps = rig.around.sweeping > 0;
        let offers = !rig.words.is_empty();
        rig.clock(100);
        // The engine and the responder need few clocks here.
        rig.around.busy = rig.around.busy.min(2);
        rig.around.answering = rig.around.answering.min(2);
        let shown = rig.shown;
        wave.take(&[
            ("sweeps", Cell::Bit(sweeps)),
            ("command_valid", Cell::Bit(offers)),
            ("command_ready", Cell::Bit(shown.ready)),
            ("came", Cell::Bit(shown.came.is_some())),
            ("came_id", shown.came.map_or(Cell::Open, |(id, _)| Cell::Number(id.into()))),
            ("is_quiet", Cell::Bit(shown.is_quiet)),
            ("answers", Cell::Bit(shown.answers)),
        ]);
    }
    wave.assert_drawn_in("command_port");
}
