//! Runs `DatagramGate` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::head_bytes::OURS;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::ethernet::DatagramGate;
use incircle_testkit::SplitMix64;

named_ports!(
    DatagramGate,
    [reset, begins, head_valid, head, kinds, state, ends, is_sound, is_full],
    [push, entry],
    clock
);

/// Places of the sender's addresses, and the first place of the payload.
const PEER: [usize; 12] = [6, 7, 8, 9, 10, 11, 26, 27, 28, 29, 34, 35];
const PAYLOAD: usize = 42;

/// A frame, and what the blocks before the gate say of it.
#[derive(Clone, Debug)]
struct Frame {
    bytes: Vec<u8>,
    /// Bytes that come before one shows that the frame is no datagram for the device.
    is_udp_for: usize,
    /// Bytes up to the end of the datagram.
    length: usize,
    is_to_all: bool,
    is_sound: bool,
    /// The header, the length and UDP are right.
    is_right: [bool; 3],
}

impl Frame {
    fn random(random: &mut SplitMix64) -> Self {
        let length = 60 + random.below(40) as usize;
        let mut one_in = |count: u64| random.below(count) == 0;
        let (stops, is_to_all, is_sound) = (one_in(4), one_in(3), !one_in(8));
        let is_right = [!one_in(8), !one_in(8), !one_in(8)];
        Self {
            is_udp_for: if stops { random.below(length as u64) as usize } else { length + 1 },
            length: PAYLOAD + random.below((length - PAYLOAD) as u64 + 1) as usize,
            bytes: (0..length).map(|_| random.below(256) as u8).collect(),
            is_to_all,
            is_sound,
            is_right,
        }
    }

    /// Whether the byte at this place is one of the datagram with its sender.
    fn passes(&self, place: usize) -> bool {
        place < self.is_udp_for && (PEER.contains(&place) || (PAYLOAD..self.length).contains(&place))
    }

    /// Whether the datagram counts if all of its bytes found room.
    fn counts(&self) -> bool {
        self.is_udp_for > self.bytes.len() && self.is_sound && self.is_right == [true; 3]
    }
}

/// The gate, the entries that were taken, and whether the FIFO had room in the clock before.
struct Rig {
    block: Stepper<DatagramGate>,
    random: SplitMix64,
    entries: Vec<u16>,
    resets: bool,
    /// The FIFO is full in one clock out of this many, and for this many clocks.
    full_in: u64,
    full_for: u64,
    is_full_for: u64,
    had_room: bool,
}

impl Rig {
    /// Passes a clock. Of a byte the place is given, and of an end nothing.
    fn clock(&mut self, frame: &Frame, begins: bool, place: Option<usize>, ends: bool, come: usize) -> bool {
        self.is_full_for = match self.is_full_for {
            0 if self.full_in > 0 && self.random.below(self.full_in) == 0 => 1 + self.random.below(self.full_for),
            left => left.saturating_sub(1),
        };
        let is_full = self.is_full_for > 0;
        let data = place.map_or(self.random.below(256) as u8, |place| frame.bytes[place]);
        let shown = place.unwrap_or(self.random.below(64) as usize);
        self.block.set("begins", begins);
        self.block.set("head_valid", place.is_some());
        self.block.set("head", OURS.head(shown, data, &mut self.random));
        self.block.set("is_udp", come < frame.is_udp_for);
        self.block.set("is_to_all", frame.is_to_all);
        self.block.set("has_more", come < frame.length);
        for (port, flag) in ["header_is_right", "is_whole", "udp_is_right"].into_iter().zip(frame.is_right) {
            self.block.set(port, flag);
        }
        self.block.set("ends", ends);
        self.block.set("is_sound", frame.is_sound);
        self.block.set("is_full", is_full);
        self.block.settle();
        if !self.resets && self.block.is("push") && !is_full {
            self.entries.push(self.block.get("entry") as u16);
        }
        self.block.edge();
        self.had_room = !is_full;
        self.had_room
    }
}

/// Gives the gate this many frames, and compares the entries with what must have found room.
fn run(full_in: u64, full_for: u64, frames: usize) -> [usize; 3] {
    let block = Stepper::new("ethernet_datagram_gate", DatagramGate::default(), 1);
    let random = SplitMix64::new(full_in * 100 + full_for);
    let mut rig =
        Rig { block, random, entries: Vec::new(), resets: true, full_in, full_for, is_full_for: 0, had_room: true };
    let mut counts = [0; 3];
    rig.block.set("reset", true);
    let first = Frame::random(&mut rig.random);
    rig.clock(&first, false, None, false, 0);
    rig.block.set("reset", false);
    rig.resets = false;
    // A frame that began before the reset does not pass.
    (6..50).for_each(|place| {
        rig.clock(&first, false, Some(place), false, 0);
    });
    assert!(rig.entries.is_empty(), "a frame without its beginning");
    let (mut expected, mut owed): (Vec<u16>, Option<u16>) = (Vec::new(), None);
    for _ in 0..frames {
        let frame = Frame::random(&mut rig.random);
        let room = rig.clock(&frame, true, None, false, 0);
        expected.extend(owed.take_if(|_| room));
        // The end of the datagram before still waits when this one begins, which is lost for that.
        let is_shut = owed.is_some();
        let (mut taken, mut is_lost, mut come) = (0, is_shut, 0);
        while come < frame.bytes.len() {
            let place = (rig.random.below(5) > 0).then_some(come);
            let room = rig.clock(&frame, false, place, false, come);
            expected.extend(owed.take_if(|_| room));
            come += usize::from(place.is_some());
            let Some(place) = place.filter(|place| frame.passes(*place) && !is_lost) else { continue };
            if room {
                expected.push(frame.bytes[place].into());
                taken += 1;
            }
            is_lost |= !room;
        }
        let room = rig.clock(&frame, false, None, true, come);
        expected.extend(owed.take_if(|_| room));
        if taken > 0 {
            let counts = frame.counts() && !is_lost;
            owed = Some(0x100 | u16::from(counts) | u16::from(frame.is_to_all) << 1);
        }
        for _ in 0..[0, 1, 12][rig.random.below(3) as usize] {
            let room = rig.clock(&frame, false, None, false, come);
            expected.extend(owed.take_if(|_| room));
        }
        counts[0] += usize::from(is_shut);
        counts[1] += usize::from(taken > 0 && is_lost);
        counts[2] += usize::from(frame.counts() && !is_lost);
        assert_eq!(rig.entries, expected, "{frame:?}");
    }
    counts
}

#[test]
fn bytes_of_datagrams_pass_and_their_end_says_whether_they_count() {
    let [shut, cut, whole] = run(0, 1, 600);
    assert!(shut == 0 && cut == 0 && whole > 150, "{shut} {cut} {whole}");
}

#[test]
fn a_full_fifo_costs_whole_datagrams() {
    let [shut, cut, whole] = run(150, 60, 600);
    assert!(shut > 10 && cut > 80 && whole > 30, "{shut} {cut} {whole}");
    // A FIFO that is full for single clocks costs the datagrams that need one of them.
    let [_, cut, whole] = run(60, 1, 600);
    assert!(cut > 80 && whole > 30, "{cut} {whole}");
}

#[test]
fn wave_of_two_bytes_and_an_end_that_waits_for_room() {
    let mut random = SplitMix64::new(1);
    let mut stimuli = vec![(0, "begins", 1), (6, "ends", 1)];
    for (clock, place, data) in [(1, 11, 25), (2, 12, 8), (3, 42, 70), (5, 43, 0)] {
        stimuli.extend([(clock, "head_valid", 1), (clock, "head", OURS.head(place, data, &mut random))]);
    }
    for clock in 0..10 {
        // All is right; the datagram has one byte of payload.
        stimuli.extend([(clock, "kinds", 1), (clock, "state", if clock < 4 { 0b1111 } else { 0b0111 })]);
        stimuli.extend([(clock, "is_sound", 1), (clock, "is_full", u128::from((6..8).contains(&clock)))]);
    }
    let lanes = [
        ("begins", "begins", 0, 1, When::Always),
        ("head_valid", "head_valid", 0, 1, When::Always),
        ("is_peer", "head", 18, 1, When::If("head_valid")),
        ("is_payload", "head", 28, 1, When::If("head_valid")),
        ("has_more", "state", 3, 1, When::If("head_valid")),
        ("ends", "ends", 0, 1, When::Always),
        ("is_full", "is_full", 0, 1, When::Always),
        ("push", "push", 0, 1, When::Always),
        ("entry[8]", "entry", 8, 1, When::If("push")),
        ("entry[7:0]", "entry", 0, 8, When::If("push")),
    ];
    draw("ethernet_datagram_gate", DatagramGate::default(), &stimuli, 10, &lanes).assert_drawn_in("datagram_gate");
}
