//! Runs `Responder` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::ethernet_frames::{arp, echo, reaction, sealed, udp, Party, ALL, DEVICE};
use crate::rig::head_bytes::OURS;
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::ethernet::Responder;
use incircle_testkit::SplitMix64;

named_ports!(
    Responder,
    [reset, station, frame_begins, head_valid, head, place, asks_address, asks_echo, begins],
    [waits, byte_data, byte_is_last],
    clock
);

/// Clocks from `begins` to the first byte.
const TO_FIRST: usize = 4;

/// What a frame asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Asks {
    Nothing,
    Address,
    Echo,
}

struct Rig {
    block: Stepper<Responder>,
    random: SplitMix64,
    /// Clocks since an answer began, while its bytes come.
    since_begin: Option<usize>,
    /// Lets an answer that waits begin in one clock out of this many, or never if this is 0.
    begins_in: u64,
    coming: Vec<u8>,
    answers: Vec<Vec<u8>>,
}

impl Rig {
    fn new(seed: u64) -> Self {
        let block = Stepper::new("ethernet_responder", Responder::default(), seed as u32);
        let random = SplitMix64::new(seed);
        let mut rig = Self { block, random, since_begin: None, begins_in: 0, coming: Vec::new(), answers: Vec::new() };
        rig.reset();
        rig
    }

    fn reset(&mut self) {
        // As many clocks as a byte takes through the block. The outputs mean nothing in them.
        self.block.set("reset", true);
        for port in ["frame_begins", "head_valid", "asks_address", "asks_echo", "begins"] {
            self.block.set(port, false);
        }
        self.block.set("station", OURS.packed());
        self.block.set("head", 0u32);
        self.block.set("place", 0u32);
        for _ in 0..6 {
            self.block.settle();
            self.block.edge();
        }
        self.block.set("reset", false);
        (self.since_begin, self.coming) = (None, Vec::new());
    }

    /// Passes a clock, in which a frame begins, a byte of it comes, or it ends and asks.
    fn clock(&mut self, frame_begins: bool, byte: Option<(usize, u8)>, asks: Asks) {
        let (place, data) = byte.unwrap_or((self.random.below(1500) as usize, self.random.below(256) as u8));
        self.block.set("station", OURS.packed());
        self.block.set("frame_begins", frame_begins);
        self.block.set("head_valid", byte.is_some());
        self.block.set("head", OURS.head(place, data, &mut self.random));
        self.block.set("place", place as u32);
        self.block.set("asks_address", asks == Asks::Address);
        self.block.set("asks_echo", asks == Asks::Echo);
        self.block.set("begins", false);
        self.block.settle();
        let may_begin = self.begins_in > 0 && self.random.below(self.begins_in) == 0;
        let begins = self.since_begin.is_none() && self.block.is("waits") && may_begin;
        self.block.set("begins", begins);
        self.block.settle();
        self.since_begin = if begins { Some(0) } else { self.since_begin.map(|since| since + 1) };
        if self.since_begin.is_some_and(|since| since > 0) {
            self.block.expect("waits", false);
        }
        if self.since_begin.is_some_and(|since| since >= TO_FIRST) {
            self.coming.push(self.block.get("byte_data") as u8);
            if self.block.is("byte_is_last") {
                self.answers.push(std::mem::take(&mut self.coming));
                self.since_begin = None;
            }
        }
        self.block.edge();
    }

    /// Gives the block a frame with its check sum. The last byte and the end come a clock or more apart.
    fn frame(&mut self, frame: &[u8], asks: Asks) {
        self.clock(true, None, Asks::Nothing);
        let stalls = self.random.below(2) == 0;
        let mut come = 0;
        while come < frame.len() {
            let comes = !stalls || self.random.below(4) > 0;
            self.clock(false, comes.then(|| (come, frame[come])), Asks::Nothing);
            come += usize::from(comes);
        }
        (0..self.random.below(3)).for_each(|_| self.clock(false, None, Asks::Nothing));
        self.clock(false, None, asks);
    }

    fn rest(&mut self, clocks: usize) {
        (0..clocks).for_each(|_| self.clock(false, None, Asks::Nothing));
    }
}

/// A frame that asks, and what it asks for.
fn question(random: &mut SplitMix64, run: usize) -> (Vec<u8>, Asks) {
    let host = Party::random(random);
    let longest = if run.is_multiple_of(10) { 1473 } else { 90 };
    let payload: Vec<u8> = (0..random.below(longest)).map(|_| random.below(256) as u8).collect();
    match run % 3 {
        0 => (sealed(arp(host, [ALL, DEVICE.mac][run % 2], DEVICE.address)), Asks::Address),
        _ => (sealed(echo(host, (DEVICE.mac, DEVICE.address), &payload)), Asks::Echo),
    }
}

/// The answer to a question, padded to the shortest frame, without its check sum.
fn answer(frame: &[u8]) -> Vec<u8> {
    let mut answer = reaction(frame).answer.expect("an answer");
    answer.truncate(answer.len() - 4);
    answer
}

/// The check sum that an echo request must have so that adding 0x0800 in ones' complement carries, or just does not.
fn with_sum(mut frame: Vec<u8>, sum: u16) -> Vec<u8> {
    frame[36..38].copy_from_slice(&sum.to_be_bytes());
    frame.truncate(frame.len() - 4);
    sealed(frame)
}

#[test]
fn each_question_comes_back_as_its_answer() {
    let mut rig = Rig::new(2);
    rig.begins_in = 9;
    for run in 0..80 {
        let (mut frame, asks) = question(&mut rig.random, run);
        // The check sum of an echo request is not checked, so that it may have any value.
        if asks == Asks::Echo && run % 4 == 0 {
            frame = with_sum(frame, [0xf7ff, 0xf800, 0xffff, 0x00ff, 0xf6ff][run / 4 % 5]);
        }
        rig.frame(&frame, asks);
        let rest = frame.len() + 80;
        rig.rest(rest);
        assert_eq!(std::mem::take(&mut rig.answers), [answer(&frame)], "{asks:?} {frame:x?}");
    }
}

#[test]
fn frames_that_ask_for_nothing_get_no_answer() {
    let mut rig = Rig::new(5);
    rig.begins_in = 1;
    for run in 0..30 {
        let host = Party::random(&mut rig.random);
        let to = (DEVICE.mac, DEVICE.address, DEVICE.port);
        rig.frame(&sealed(udp(host, to, &[7; 50], true)), Asks::Nothing);
        rig.rest(90);
        assert!(rig.answers.is_empty(), "an answer to a datagram");
        // The next question finds nothing of the frame before.
        let (frame, asks) = question(&mut rig.random, run);
        rig.frame(&frame, asks);
        rig.rest(frame.len() + 40);
        assert_eq!(std::mem::take(&mut rig.answers), [answer(&frame)]);
    }
}

#[test]
fn a_question_that_comes_while_an_answer_is_under_way_gets_none() {
    let mut rig = Rig::new(7);
    for run in 0..30 {
        let (first, asks) = question(&mut rig.random, run);
        rig.begins_in = 0;
        rig.frame(&first, asks);
        // The next one begins before or while the answer goes out, and does not change it.
        rig.begins_in = [0, 20, 1][run % 3];
        rig.rest(if run % 3 == 2 { 20 } else { 0 });
        let (second, asks) = question(&mut rig.random, run + 1);
        rig.frame(&second, asks);
        rig.begins_in = 1;
        rig.rest(first.len() + second.len() + 40);
        assert_eq!(std::mem::take(&mut rig.answers), [answer(&first)], "run {run}");
    }
}

#[test]
fn a_reset_forgets_question_and_answer() {
    let mut rig = Rig::new(9);
    for run in 0..30 {
        let (frame, asks) = question(&mut rig.random, run);
        rig.begins_in = u64::from(run % 2 == 0);
        // The reset comes within the frame, or while the answer waits or goes out.
        let is_whole = run % 3 == 0;
        let some = if is_whole { frame.len() } else { rig.random.below(frame.len() as u64) as usize };
        rig.clock(true, None, Asks::Nothing);
        (0..some).for_each(|place| rig.clock(false, Some((place, frame[place])), Asks::Nothing));
        if is_whole {
            let clocks = rig.random.below(40) as usize;
            rig.clock(false, None, asks);
            rig.rest(clocks);
        }
        rig.reset();
        rig.answers.clear();
        rig.begins_in = 1;
        // The end of a frame that began before the reset asks for nothing.
        (some..frame.len()).for_each(|place| rig.clock(false, Some((place, frame[place])), Asks::Nothing));
        rig.clock(false, None, asks);
        rig.rest(frame.len() + 40);
        assert!(rig.answers.is_empty(), "an answer from before the reset");
    }
}

#[test]
fn wave_of_a_question_and_the_beginning_and_the_end_of_its_answer() {
    let mut rig = Rig::new(1);
    let host = Party { mac: [40, 41, 42, 43, 44, 45], address: [10, 0, 7, 9], port: 0 };
    let frame = sealed(arp(host, ALL, DEVICE.address));
    rig.clock(true, None, Asks::Nothing);
    (0..frame.len() - 1).for_each(|place| rig.clock(false, Some((place, frame[place])), Asks::Nothing));
    let mut wave = Wave::default();
    for clock in 0..73 {
        let (is_last_byte, asks, begins) = (clock == 0, clock == 1, clock == 3);
        let data = if is_last_byte { frame[frame.len() - 1] } else { 0 };
        rig.block.set("head_valid", is_last_byte);
        rig.block.set("head", OURS.head(frame.len() - 1, data, &mut rig.random));
        rig.block.set("place", frame.len() as u32 - 1);
        rig.block.set("asks_address", asks);
        rig.block.set("begins", begins);
        rig.block.settle();
        let comes = (3 + TO_FIRST..3 + TO_FIRST + 60).contains(&clock);
        let byte = if comes { Cell::Number(rig.block.get("byte_data")) } else { Cell::Open };
        if !(11..65).contains(&clock) {
            wave.take(&[
                ("head_valid", Cell::Bit(is_last_byte)),
                ("asks_address", Cell::Bit(asks)),
                ("waits", Cell::Bit(rig.block.is("waits"))),
                ("begins", Cell::Bit(begins)),
                ("byte_data", byte),
                ("byte_is_last", Cell::Bit(rig.block.is("byte_is_last"))),
            ]);
        }
        rig.block.edge();
    }
    wave.assert_drawn_in("responder");
}
