//! Runs `DatagramQueue` in Rust and in Verilog beside plain code: all three must agree, at ratios of the clocks of up to
//! 1 to 4 either way.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Cell, Delay, Stepper, Wave};
use crate::rig::stream_rig::{rise, Clocks, PERIODS};
use incircle_hdl::ethernet::DatagramQueue;
use incircle_testkit::SplitMix64;

named_ports!(
    DatagramQueue,
    [
        write_clock,
        write_reset,
        byte_valid,
        byte_data,
        byte_is_last,
        byte_drops,
        read_clock,
        read_reset,
        read_index,
        lets_go
    ],
    [byte_ready, holds, length, read_data]
);

/// Bytes of the ring, and of the longest datagram with its receiver.
const RING: usize = 4096;
const LONGEST: usize = 1484;
/// Most datagrams in the ring.
const MOST: usize = 4;
/// Most clocks of the writer from a place that is free to `byte_ready`, and of the reader from a datagram that has
/// ended to `holds`.
const TO_READY: usize = 6;
const TO_HOLDS: usize = 4;

/// The queue between a writer and a reader.
struct Rig {
    block: Stepper<DatagramQueue>,
    clocks: Clocks,
    random: SplitMix64,
    /// The bytes of the datagram that is being written, and its length.
    written: Vec<u8>,
    length: usize,
    /// The datagrams that have ended and were not let go, with the reader's clocks since their end.
    held: VecDeque<(Vec<u8>, usize)>,
    was_ready: bool,
    /// Clocks of the writer for which there has been room for another datagram.
    room_for: usize,
    read: Delay<Option<u8>>,
    /// The writer offers a byte in one clock out of this many; the reader lets go in one out of this many, or never.
    write_in: u64,
    lets_go_in: u64,
    /// The writer drops a datagram in one clock out of this many, or never.
    drop_in: u64,
    passed: usize,
    drops: usize,
    /// Most datagrams and bytes that the ring has held.
    most: (usize, usize),
}

impl Rig {
    fn new(periods: [u64; 2], seed: u64) -> Self {
        let mut rig = Self {
            block: Stepper::new("ethernet_datagram_queue", DatagramQueue::new(), seed as u32),
            clocks: Clocks::new(periods, seed),
            random: SplitMix64::new(seed),
            written: Vec::new(),
            length: 20,
            held: VecDeque::new(),
            was_ready: false,
            room_for: 0,
            read: Delay::new(2),
            write_in: 1,
            lets_go_in: 0,
            drop_in: 0,
            passed: 0,
            drops: 0,
            most: (0, 0),
        };
        rig.reset();
        rig
    }

    /// Holds both resets for four clocks of either, and forgets all datagrams.
    fn reset(&mut self) {
        for (port, value) in [("byte_valid", 0u8), ("byte_is_last", 0), ("byte_drops", 0), ("lets_go", 0)] {
            self.block.set(port, value);
        }
        for (port, value) in [("byte_data", 0u8), ("read_index", 0), ("write_reset", 1), ("read_reset", 1)] {
            self.block.set(port, value);
        }
        let mut edges = [0; 2];
        while edges.iter().any(|edges| *edges < 4) {
            let rises = self.clocks.next();
            self.block.settle();
            rise(&mut self.block, [("write_clock", rises[0]), ("read_clock", rises[1])]);
            edges = [0, 1].map(|side| edges[side] + usize::from(rises[side]));
        }
        self.block.set("write_reset", false);
        self.block.set("read_reset", false);
        self.block.settle();
        self.held.clear();
        self.written.clear();
        (self.was_ready, self.room_for, self.read) = (false, 0, Delay::new(2));
    }

    fn bytes_held(&self) -> usize {
        self.held.iter().map(|(bytes, _)| bytes.len()).sum()
    }

    /// Passes the next edge of either clock, or of both.
    fn step(&mut self) {
        let rises = self.clocks.next();
        let byte = if rises[0] { self.offer() } else { None };
        let lets_go = rises[1] && self.read_one();
        rise(&mut self.block, [("write_clock", rises[0]), ("read_clock", rises[1])]);
        if let Some((byte, is_last)) = byte {
            self.written.push(byte);
            if is_last {
                self.held.push_back((std::mem::take(&mut self.written), 0));
                (self.was_ready, self.room_for) = (false, 0);
                self.length = self.random_length();
            }
        }
        if lets_go {
            self.held.pop_front();
            self.passed += 1;
        }
        self.most = (self.most.0.max(self.held.len()), self.most.1.max(self.bytes_held()));
    }

    fn random_length(&mut self) -> usize {
        [12, 13, 40, 500, LONGEST, 12 + self.random.below(300) as usize][self.random.below(6) as usize]
    }

    /// Sets the inputs of the writer for a clock, and returns the byte that is taken.
    fn offer(&mut self) -> Option<(u8, bool)> {
        let is_ready = self.block.is("byte_ready");
        let has_room = self.held.len() < MOST && self.bytes_held() + LONGEST <= RING;
        assert!(!is_ready || self.was_ready || has_room, "ready without room");
        assert!(is_ready || !self.was_ready, "ready falls within a datagram");
        assert!(is_ready || self.room_for < TO_READY, "not ready, with room for {} clocks", self.room_for);
        self.was_ready = is_ready;
        self.room_for = if has_room { self.room_for + 1 } else { 0 };
        let drops = !self.written.is_empty() && self.drop_in > 0 && self.random.below(self.drop_in) == 0;
        let offers = !drops && self.random.below(self.write_in) == 0;
        let (byte, is_last) = (self.random.below(256) as u8, self.written.len() + 1 == self.length);
        self.block.set("byte_valid", offers);
        self.block.set("byte_data", byte);
        self.block.set("byte_is_last", offers && is_last);
        self.block.set("byte_drops", drops);
        self.block.settle();
        if drops {
            self.written.clear();
            self.length = self.random_length();
            self.drops += 1;
        }
        (offers && is_ready).then_some((byte, is_last))
    }

    /// Compares what the reader sees in a clock, and returns whether it lets the oldest datagram go.
    fn read_one(&mut self) -> bool {
        let holds = self.block.is("holds");
        let oldest = self.held.front().map(|(bytes, waited)| (bytes.clone(), *waited));
        assert!(!holds || oldest.is_some(), "a datagram that nobody wrote");
        assert!(holds || oldest.as_ref().is_none_or(|(_, waited)| *waited < TO_HOLDS), "a datagram that is not seen");
        self.held.iter_mut().for_each(|(_, waited)| *waited += 1);
        let oldest = oldest.filter(|_| holds).map(|(bytes, _)| bytes);
        let index = self.random.below(oldest.as_ref().map_or(LONGEST, Vec::len) as u64) as usize;
        if let Some(bytes) = &oldest {
            self.block.expect("length", bytes.len() as u32);
        }
        if let Some(byte) = self.read.pass(oldest.as_ref().map(|bytes| bytes[index])).flatten() {
            self.block.expect("read_data", byte);
        }
        let lets_go = holds && self.lets_go_in > 0 && self.random.below(self.lets_go_in) == 0;
        self.block.set("read_index", index as u32);
        self.block.set("lets_go", lets_go);
        self.block.settle();
        lets_go
    }

    /// Writes a datagram of this many bytes without a pause.
    fn write(&mut self, length: usize) {
        let held = self.held.len();
        self.length = length;
        for _ in 0..40 * LONGEST {
            if self.held.len() > held {
                return;
            }
            self.step();
        }
        panic!("a datagram of {length} bytes finds no room beside {} bytes of {held}", self.bytes_held());
    }
}

#[test]
fn datagrams_come_out_in_order_and_find_room_as_soon_as_there_is_some() {
    let (mut drops, mut most) = (0, (0, 0));
    for (seed, periods) in PERIODS.into_iter().enumerate() {
        let mut rig = Rig::new(periods, seed as u64);
        rig.drop_in = 1000;
        for (write_in, lets_go_in) in [(1, 300), (1, 1500), (4, 40), (1, 1)] {
            (rig.write_in, rig.lets_go_in) = (write_in, lets_go_in);
            (0..9000).for_each(|_| rig.step());
        }
        assert!(rig.passed > 10, "{} passed at {periods:?}", rig.passed);
        drops += rig.drops;
        most = (most.0.max(rig.most.0), most.1.max(rig.most.1));
    }
    assert!(drops > 30 && most.0 == MOST && most.1 > LONGEST, "{drops} dropped, at most {most:?}");
}

#[test]
fn two_of_the_longest_and_two_of_the_shortest_fit() {
    let mut rig = Rig::new(PERIODS[0], 20);
    for length in [LONGEST, 12, 12] {
        rig.write(length);
    }
    while rig.held.len() < MOST {
        rig.length = LONGEST;
        rig.step();
    }
    (0..200).for_each(|_| rig.step());
    assert_eq!((rig.most, rig.block.is("byte_ready")), ((MOST, 2 * LONGEST + 24), false));
    // A datagram begins only when there is room for the longest one, to the byte.
    for (beyond, begins) in [(0, true), (1, false)] {
        let mut rig = Rig::new(PERIODS[0], 21);
        rig.write(LONGEST);
        rig.write(RING - 2 * LONGEST + beyond);
        rig.write_in = u64::MAX;
        (0..200).for_each(|_| rig.step());
        assert_eq!((rig.held.len(), rig.block.is("byte_ready")), (2, begins));
    }
}

#[test]
fn a_reset_of_both_sides_forgets_all() {
    for (seed, periods) in PERIODS.into_iter().enumerate() {
        let mut rig = Rig::new(periods, 40 + seed as u64);
        rig.drop_in = 1000;
        for run in 0..20 {
            rig.lets_go_in = [0, 100][run % 2];
            let steps = 300 + rig.random.below(3000);
            (0..steps).for_each(|_| rig.step());
            rig.reset();
            let shown = [rig.block.is("holds"), rig.block.is("byte_ready")];
            assert_eq!(shown, [false; 2], "holds and ready in run {run} at {periods:?}");
        }
    }
}

#[test]
fn wave_of_a_datagram_of_three_bytes_at_equal_clocks() {
    let mut block = Stepper::new("ethernet_datagram_queue", DatagramQueue::new(), 1);
    for port in ["byte_drops", "lets_go", "read_index", "byte_valid", "byte_data", "byte_is_last"] {
        block.set(port, 0u8);
    }
    for clock in 0..6 {
        block.set("write_reset", clock < 4);
        block.set("read_reset", clock < 4);
        block.settle();
        rise(&mut block, [("write_clock", true), ("read_clock", true)]);
    }
    let mut wave = Wave::default();
    for clock in 0..12usize {
        let (valid, is_last, lets_go) = (clock < 3, clock == 2, clock == 8);
        let index = clock.checked_sub(5).filter(|index| *index < 3);
        block.set("byte_valid", valid);
        block.set("byte_data", 50 + clock as u32);
        block.set("byte_is_last", is_last);
        block.set("read_index", index.unwrap_or(0) as u32);
        block.set("lets_go", lets_go);
        block.settle();
        let number = |shows: bool, port: &str| if shows { Cell::Number(block.get(port)) } else { Cell::Open };
        let shown = |value: Option<usize>| value.map_or(Cell::Open, |value| Cell::Number(value as u128));
        wave.take(&[
            ("byte_valid", Cell::Bit(valid)),
            ("byte_ready", Cell::Bit(block.is("byte_ready"))),
            ("byte_data", shown(valid.then_some(50 + clock))),
            ("byte_is_last", Cell::Bit(is_last)),
            ("holds", Cell::Bit(block.is("holds"))),
            ("length", number(block.is("holds"), "length")),
            ("read_index", shown(index)),
            ("read_data", number((7..10).contains(&clock), "read_data")),
            ("lets_go", Cell::Bit(lets_go)),
        ]);
        rise(&mut block, [("write_clock", true), ("read_clock", true)]);
    }
    wave.assert_drawn_in("datagram_queue");
}
