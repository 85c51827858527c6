//! An Ethernet port between a PHY and a reader, driven clock by clock.

use std::collections::VecDeque;

use crate::rig::ethernet_frames::{Reaction, BROADCAST, DEVICE};
use crate::rig::stepper::named_ports;
use crate::rig::stream_rig::{Clocks, Pins};
use incircle_hdl::ethernet::UdpPort;
use incircle_testkit::SplitMix64;

named_ports!(
    UdpPort,
    [
        port_clock,
        port_reset,
        station,
        rx_valid,
        rx_error,
        rx_data,
        core_clock,
        core_reset,
        entry_pop,
        byte_valid,
        byte_data,
        byte_is_last,
        byte_drops
    ],
    [tx_valid, tx_data, entry_valid, entry, on_the_way, byte_ready]
);

/// Periods of the clocks of the port and of the core: equal, slower and faster.
pub const PERIODS: [[u64; 2]; 4] = [[8000, 8000], [8000, 6600], [8000, 12_500], [8000, 8300]];

/// A port between a PHY and a reader.
pub struct Rig<P> {
    pub pins: P,
    pub clocks: Clocks,
    pub edges: [u64; 2],
    /// What the PHY gives in the coming clocks: a byte, perhaps with an error, or nothing.
    pub wire: VecDeque<Option<(u8, bool)>>,
    /// What the device is to send: bytes, and whether each is the last of its datagram.
    pub sends: VecDeque<(u8, bool)>,
    /// The bytes of the datagram that has not ended are to be forgotten.
    pub drops: bool,
    /// The reader takes an entry in one clock out of this many.
    pub pace: u64,
    pub random: SplitMix64,
    /// Bytes of the datagram that is coming, and the datagrams that counted.
    pub coming: Vec<u8>,
    pub datagrams: Vec<(Vec<u8>, bool)>,
    pub dropped: usize,
    /// Bytes of the frame that is on the line, and the frames that were, with the edge at which each ended.
    pub line: Vec<u8>,
    pub frames: Vec<(Vec<u8>, u64)>,
    pub idle_for: u64,
}

impl<P: Pins> Rig<P> {
    pub fn new(mut pins: P, periods: [u64; 2], seed: u64) -> Self {
        let wide = |bytes: &[u8]| bytes.iter().fold(0u128, |value, byte| value << 8 | u128::from(*byte));
        let station = wide(&DEVICE.mac) | wide(&DEVICE.address) << 48 | u128::from(DEVICE.port) << 80;
        for port in ["port_clock", "core_clock", "rx_valid", "rx_error", "rx_data", "entry_pop"] {
            pins.set(port, 0);
        }
        for port in ["byte_valid", "byte_data", "byte_is_last", "byte_drops"] {
            pins.set(port, 0);
        }
        pins.set("station", station | wide(&BROADCAST) << 96);
        pins.set("port_reset", 1);
        pins.set("core_reset", 1);
        let mut rig = Self {
            pins,
            clocks: Clocks::new(periods, seed),
            edges: [0; 2],
            wire: VecDeque::new(),
            sends: VecDeque::new(),
            drops: false,
            pace: 1,
            random: SplitMix64::new(seed),
            coming: Vec::new(),
            datagrams: Vec::new(),
            dropped: 0,
            line: Vec::new(),
            frames: Vec::new(),
            idle_for: 0,
        };
        while rig.edges.iter().any(|edges| *edges < 20) {
            rig.step();
        }
        rig.pins.set("port_reset", 0);
        rig.pins.set("core_reset", 0);
        rig.steps(20);
        rig.forget();
        rig
    }

    pub fn forget(&mut self) {
        (self.coming, self.datagrams, self.dropped) = (Vec::new(), Vec::new(), 0);
        (self.line, self.frames, self.idle_for) = (Vec::new(), Vec::new(), 0);
    }

    pub fn in_reset(&self) -> bool {
        self.edges.iter().any(|edges| *edges < 20)
    }

    /// Passes the next edge of either clock, or of both.
    pub fn step(&mut self) {
        let rises = self.clocks.next();
        if rises[0] {
            let byte = self.wire.pop_front().flatten();
            self.pins.set("rx_valid", byte.is_some().into());
            self.pins.set("rx_data", byte.map_or(0xd5, |byte| byte.0).into());
            self.pins.set("rx_error", byte.is_some_and(|byte| byte.1).into());
        }
        let offered = self.sends.front().copied().filter(|_| rises[1] && !self.in_reset());
        self.pins.set("byte_valid", offered.is_some().into());
        self.pins.set("byte_data", offered.map_or(0, |byte| byte.0).into());
        self.pins.set("byte_is_last", offered.is_some_and(|byte| byte.1).into());
        let drops = rises[1] && self.drops && self.sends.is_empty();
        self.pins.set("byte_drops", drops.into());
        self.drops &= !drops;
        self.pins.set("entry_pop", 0);
        self.pins.settle();
        if !self.in_reset() {
            if rises[0] {
                self.watch_line();
            }
            if rises[1] {
                self.take_entry();
                if offered.is_some() && self.pins.get("byte_ready") == 1 {
                    self.sends.pop_front();
                }
            }
        }
        for level in [1, 0] {
            for (clock, rises) in [("port_clock", rises[0]), ("core_clock", rises[1])] {
                if rises {
                    self.pins.set(clock, level);
                }
            }
            self.pins.settle();
        }
        self.edges[0] += u64::from(rises[0]);
        self.edges[1] += u64::from(rises[1]);
    }

    pub fn watch_line(&mut self) {
        if self.pins.get("tx_valid") == 1 {
            assert!(!self.line.is_empty() || self.frames.is_empty() || self.idle_for >= 12, "{}", self.idle_for);
            self.line.push(self.pins.get("tx_data") as u8);
            self.idle_for = 0;
            return;
        }
        self.idle_for += 1;
        if !self.line.is_empty() {
            let line = std::mem::take(&mut self.line);
            assert_eq!(line[..8], [0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0xd5]);
            self.frames.push((line[8..].to_vec(), self.edges[0]));
        }
    }

    pub fn take_entry(&mut self) {
        if self.pins.get("entry_valid") == 0 || self.random.below(self.pace) > 0 {
            return;
        }
        let entry = self.pins.get("entry");
        self.pins.set("entry_pop", 1);
        self.pins.settle();
        if entry >> 8 == 0 {
            self.coming.push(entry as u8);
            return;
        }
        let coming = std::mem::take(&mut self.coming);
        assert!(!coming.is_empty(), "an end without a byte");
        if entry & 1 == 1 {
            self.datagrams.push((coming, entry >> 1 & 1 == 1));
        } else {
            self.dropped += 1;
        }
    }

    pub fn steps(&mut self, steps: usize) {
        (0..steps).for_each(|_| self.step());
    }

    /// Puts a frame on the wire behind what is there, with a gap before it.
    pub fn put(&mut self, frame: &[u8], gap: usize) {
        self.wire.extend(std::iter::repeat_n(None, gap));
        self.wire.extend([0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0xd5].map(|byte| Some((byte, false))));
        self.wire.extend(frame.iter().map(|byte| Some((*byte, false))));
    }

    /// Runs until nothing moves any more.
    pub fn rest(&mut self) {
        while !self.wire.is_empty() || !self.sends.is_empty() {
            self.step();
        }
        let mut still = 0;
        while still < 400 {
            let before = (self.coming.len(), self.datagrams.len(), self.dropped, self.line.len());
            self.step();
            let moves = before != (self.coming.len(), self.datagrams.len(), self.dropped, self.line.len());
            still = if moves { 0 } else { still + 1 };
        }
    }

    /// Gives the port one frame and compares all that follows with what must follow.
    pub fn expect(&mut self, frame: &[u8], expected: &Reaction, about: &str) {
        self.forget();
        self.put(frame, 12);
        self.rest();
        let sent: Vec<Vec<u8>> = self.frames.iter().map(|frame| frame.0.clone()).collect();
        assert_eq!(self.datagrams, Vec::from_iter(expected.datagram.clone()), "datagrams of {about}: {frame:x?}");
        assert_eq!(sent, Vec::from_iter(expected.answer.clone()), "answers to {about}: {frame:x?}");
        assert!(self.coming.is_empty(), "bytes without an end after {about}");
    }
}
