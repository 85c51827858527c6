//! Runs `DatagramSender` in Rust and in Verilog beside plain code: all three must agree.

use std::collections::VecDeque;

use crate::rig::ethernet_frames::{udp, Party, DEVICE};
use crate::rig::head_bytes::OURS;
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::ethernet::DatagramSender;
use incircle_testkit::SplitMix64;

named_ports!(
    DatagramSender,
    [reset, station, holds, length, read_data, begins],
    [read_index, lets_go, waits, byte_data, byte_is_last],
    clock
);

/// Clocks from `holds` to `waits`, and from `begins` to the first byte.
const TO_WAITS: usize = 21;
const TO_FIRST: usize = 4;

/// The sender between a memory that takes two clocks to read, and whoever lets frames begin.
struct Rig {
    block: Stepper<DatagramSender>,
    random: SplitMix64,
    /// The datagrams that the memory holds, the oldest first.
    datagrams: VecDeque<Vec<u8>>,
    /// The bytes that were read one clock and two clocks ago.
    read: [u8; 2],
}

impl Rig {
    fn new(seed: u64) -> Self {
        let block = Stepper::new("ethernet_datagram_sender", DatagramSender::default(), seed as u32);
        let mut rig = Self { block, random: SplitMix64::new(seed), datagrams: VecDeque::new(), read: [0; 2] };
        rig.block.set("station", OURS.packed());
        rig.reset();
        rig
    }

    /// Resets the block for as many clocks as a byte takes through it, in which its outputs mean nothing.
    fn reset(&mut self) {
        self.block.set("reset", true);
        for _ in 0..8 {
            self.settle(false);
            self.block.edge();
        }
        self.block.set("reset", false);
    }

    /// Passes a clock, and returns `waits`, the byte of this clock and whether the byte is the last one.
    fn clock(&mut self, begins: bool) -> (bool, u8, bool) {
        self.settle(begins);
        let (waits, last) = (self.block.is("waits"), self.block.is("byte_is_last"));
        let byte = self.block.get("byte_data") as u8;
        self.edge();
        (waits, byte, last)
    }

    fn settle(&mut self, begins: bool) {
        self.block.set("holds", !self.datagrams.is_empty());
        let length = self.datagrams.front().map(Vec::len);
        let length = length.unwrap_or(self.random.below(1500) as usize);
        self.block.set("length", length as u32);
        self.block.set("begins", begins);
        self.block.set("read_data", self.read[1]);
        self.block.settle();
    }

    fn edge(&mut self) {
        // The memory may hold anything where there is no datagram.
        let noise = self.random.below(256) as u8;
        let index = self.block.get("read_index") as usize;
        let byte = self.datagrams.front().and_then(|bytes| bytes.get(index)).copied().unwrap_or(noise);
        self.read = [byte, self.read[0]];
        if self.block.is("lets_go") {
            self.datagrams.pop_front().expect("a datagram to let go");
        }
        self.block.edge();
    }

    /// Awaits the frame of a datagram, lets it begin after some clocks, and returns its bytes.
    fn frame(&mut self, datagram: Vec<u8>, pause: u64) -> Vec<u8> {
        self.datagrams.push_back(datagram);
        (0..TO_WAITS).for_each(|_| assert!(!self.clock(false).0, "a frame waits too early"));
        (0..pause).for_each(|_| assert!(self.clock(false).0, "a frame waits until it may begin"));
        assert!(self.clock(true).0, "a frame waits");
        (1..TO_FIRST).for_each(|_| assert!(!self.clock(false).2, "a last byte before the first one"));
        let mut frame = Vec::new();
        loop {
            let (waits, byte, is_last) = self.clock(false);
            assert!(!waits, "two frames wait");
            frame.push(byte);
            if is_last {
                break;
            }
            assert!(frame.len() < 1600, "a frame without an end");
        }
        assert!(self.datagrams.is_empty(), "the datagram was not let go");
        frame
    }
}

#[test]
fn frames_carry_the_datagrams_behind_right_headers() {
    let mut rig = Rig::new(3);
    for run in 0..60 {
        let to = Party::random(&mut rig.random);
        let length = [0, 1, 17, 18, 250, 1472, rig.random.below(400) as usize][run % 7];
        let payload: Vec<u8> = (0..length).map(|_| rig.random.below(256) as u8).collect();
        let pause = rig.random.below(30);
        let frame = rig.frame([to.bytes(), payload.clone()].concat(), pause);
        assert_eq!(frame, udp(DEVICE, (to.mac, to.address, to.port), &payload, false), "{length} bytes");
        (0..rig.random.below(9)).for_each(|_| assert!(!rig.clock(false).0, "a frame of nothing waits"));
    }
}

#[test]
fn datagrams_one_behind_another_do_not_mix() {
    let mut rig = Rig::new(6);
    let (mut expected, mut sent, mut coming) = (Vec::new(), Vec::new(), Vec::new());
    for run in 0..40 {
        let to = Party::random(&mut rig.random);
        let payload = vec![run as u8; [0, 1, 30, 100][run % 4]];
        expected.push(udp(DEVICE, (to.mac, to.address, to.port), &payload, false));
        rig.datagrams.push_back([to.bytes(), payload].concat());
    }
    let mut since_begin: Option<usize> = None;
    for _ in 0..9000 {
        rig.settle(false);
        let begins = since_begin.is_none() && rig.block.is("waits") && rig.random.below(6) == 0;
        rig.settle(begins);
        since_begin = if begins { Some(0) } else { since_begin.map(|since| since + 1) };
        if since_begin.is_some_and(|since| since >= TO_FIRST) {
            coming.push(rig.block.get("byte_data") as u8);
            if rig.block.is("byte_is_last") {
                sent.push(std::mem::take(&mut coming));
                since_begin = None;
            }
        }
        rig.edge();
    }
    assert_eq!(sent, expected);
}

#[test]
fn a_reset_forgets_the_frame() {
    let mut rig = Rig::new(4);
    for run in 0..40 {
        let to = Party::random(&mut rig.random);
        let datagram = [to.bytes(), vec![run; 60]].concat();
        let clocks = rig.random.below(90);
        for _ in 0..clocks {
            rig.datagrams = VecDeque::from([datagram.clone()]);
            rig.settle(false);
            let waits = rig.block.is("waits");
            rig.block.set("begins", waits);
            rig.block.settle();
            rig.edge();
        }
        rig.datagrams.clear();
        rig.reset();
        let frame = rig.frame(datagram, 3);
        assert_eq!(frame, udp(DEVICE, (to.mac, to.address, to.port), &[run; 60], false));
    }
}

#[test]
fn wave_of_the_beginning_and_the_end_of_a_frame() {
    let mut rig = Rig::new(5);
    let receiver = [40, 41, 42, 43, 44, 45, 10, 0, 7, 9, 1, 2].to_vec();
    rig.datagrams.push_back([receiver, vec![71, 72]].concat());
    (0..TO_WAITS - 1).for_each(|_| {
        rig.clock(false);
    });
    let mut wave = Wave::default();
    for clock in TO_WAITS - 1..70 {
        let begins = clock == TO_WAITS;
        rig.settle(begins);
        let byte = clock.checked_sub(TO_WAITS + TO_FIRST).filter(|byte| *byte < 44);
        let data = byte.map_or(Cell::Open, |_| Cell::Number(rig.block.get("byte_data")));
        if !(TO_WAITS + TO_FIRST + 3..TO_WAITS + TO_FIRST + 38).contains(&clock) {
            wave.take(&[
                ("holds", Cell::Bit(!rig.datagrams.is_empty())),
                ("waits", Cell::Bit(rig.block.is("waits"))),
                ("begins", Cell::Bit(begins)),
                ("byte_data", data),
                ("lets_go", Cell::Bit(rig.block.is("lets_go"))),
                ("byte_is_last", Cell::Bit(rig.block.is("byte_is_last"))),
            ]);
        }
        rig.edge();
    }
    wave.assert_drawn_in("datagram_sender");
}
