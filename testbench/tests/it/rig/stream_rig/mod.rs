//! Two clocks that drift, and the blocks and devices that run on them, between a bus and a core.

mod bus;
mod stand_in;

use std::collections::BTreeMap;

use incircle_protocol::{StreamRegister, STREAM_STATUS_RESETTING, STREAM_STATUS_RUNS};
use incircle_testbench::blocks;
use incircle_testkit::SplitMix64;
use verilated::{Model, PortId};

use crate::rig::block_ports::{number, plain, set_number};
use crate::rig::stepper::{NamedPorts, Stepper};
pub use bus::Bus;
pub use stand_in::{answer, command, StandIn};

/// Ratios of two clocks, as periods in picoseconds: up to 1 to 4 either way, nearly equal, and equal.
pub const PERIODS: [[u64; 2]; 7] =
    [[8000, 8000], [8000, 8001], [8000, 32_000], [32_000, 8000], [8000, 7300], [4000, 9100], [10_000, 3300]];

/// Times at which two clocks rise.
pub struct Clocks {
    periods: [u64; 2],
    at: [u64; 2],
    random: SplitMix64,
}

impl Clocks {
    /// Makes clocks of these periods; either is now and then late by up to a thirty-second of its period.
    pub fn new(periods: [u64; 2], seed: u64) -> Self {
        let mut random = SplitMix64::new(seed);
        let at = periods.map(|period| random.below(period));
        Self { periods, at, random }
    }

    /// Returns which of the clocks rise next.
    pub fn next(&mut self) -> [bool; 2] {
        let now = self.at[0].min(self.at[1]);
        let rises = self.at.map(|at| at == now);
        for ((at, rises), period) in self.at.iter_mut().zip(rises).zip(self.periods) {
            let late = if self.random.below(4) == 0 { self.random.below(period / 32 + 1) } else { 0 };
            *at += if rises { period + late } else { 0 };
        }
        // Now and then both rise at once, since most can go wrong then.
        if self.random.below(20) == 0 && self.at[0].abs_diff(self.at[1]) < self.periods[0].min(self.periods[1]) / 4 {
            self.at = [self.at[0].max(self.at[1]); 2];
        }
        rises
    }
}

/// Lets these clocks rise together, and fall again.
pub fn rise<U: NamedPorts>(block: &mut Stepper<U>, clocks: [(&'static str, bool); 2]) {
    for level in [true, false] {
        for (name, _) in clocks.iter().filter(|(_, rises)| *rises) {
            block.set(name, level);
        }
        block.settle();
    }
}

/// The pins of a device with `bus_clock` and `core_clock`, in one form or both.
pub trait Pins {
    fn set(&mut self, port: &'static str, value: u128);
    fn get(&self, port: &'static str) -> u128;
    fn settle(&mut self);
}

impl<U: NamedPorts> Pins for Stepper<U> {
    fn set(&mut self, port: &'static str, value: u128) {
        Stepper::set(self, port, value);
    }
    fn get(&self, port: &'static str) -> u128 {
        Stepper::get(self, port)
    }
    fn settle(&mut self) {
        Stepper::settle(self);
    }
}

/// The device as Verilog alone, which runs fast.
pub struct Verilog {
    model: Model,
    ports: BTreeMap<String, PortId>,
}

impl Verilog {
    /// Makes the model of this name, with random registers and memories.
    pub fn new(name: &str, seed: u32) -> Self {
        let model = blocks::randomized(name, seed);
        let ports = model.description().ports();
        let ports = ports.map(|port| (plain(port.name), model.port(port.name).expect("a port it lists"))).collect();
        Self { model, ports }
    }
}

impl Pins for Verilog {
    fn set(&mut self, port: &'static str, value: u128) {
        let port = self.ports[port];
        set_number(&mut self.model, port, (value & (u128::MAX >> (128 - port.width()))).into());
    }
    fn get(&self, port: &'static str) -> u128 {
        number(&self.model, self.ports[port]).low
    }
    fn settle(&mut self) {
        self.model.eval();
    }
}

/// A device between a bus and, if it has no core of its own, a stand-in for a core.
pub struct Rig<P> {
    pub pins: P,
    pub bus: Bus,
    pub core: Option<StandIn>,
    pub clocks: Clocks,
    /// True while the core's clock does not run.
    pub core_stands: bool,
    pub edges: [u64; 2],
}

impl<P: Pins> Rig<P> {
    /// Makes a device after a reset that is long enough for both sides to come to rest.
    pub fn new(pins: P, beat_bits: usize, core: Option<StandIn>, periods: [u64; 2], seed: u64) -> Self {
        Self::after_reset(pins, beat_bits, core, (periods, seed), 60)
    }

    /// Makes a device after a reset of this many edges of the bus.
    pub fn after_reset(
        pins: P,
        beat_bits: usize,
        core: Option<StandIn>,
        (periods, seed): ([u64; 2], u64),
        edges: u64,
    ) -> Self {
        let (bus, clocks) = (Bus::new(beat_bits, seed), Clocks::new(periods, seed));
        let mut rig = Self { pins, bus, core, clocks, core_stands: false, edges: [0; 2] };
        rig.bus_reset(edges);
        rig
    }

    /// Holds `bus_reset_n` low for this many edges of the bus.
    pub fn bus_reset(&mut self, edges: u64) {
        self.bus.reset = true;
        let end = self.edges[0] + 1 + edges;
        while self.edges[0] < end {
            self.step();
        }
        self.bus.reset = false;
        self.bus.came.clear();
        // The device reads `bus_reset_n` at the next edge.
        while self.edges[0] < end + 1 {
            self.step();
        }
    }

    /// Passes the next edge of either clock, or of both.
    pub fn step(&mut self) {
        let [bus, core] = self.clocks.next();
        let core = core && !self.core_stands;
        if bus {
            self.bus.before_edge(&mut self.pins);
        }
        if let (true, Some(stand_in)) = (core, &mut self.core) {
            if self.bus.reset {
                stand_in.lose_track();
            } else {
                stand_in.before_edge(&mut self.pins);
            }
        }
        for level in [1, 0] {
            for (name, rises) in [("bus_clock", bus), ("core_clock", core)] {
                if rises {
                    self.pins.set(name, level);
                }
            }
            self.pins.settle();
        }
        if bus {
            self.bus.after_edge(&mut self.pins);
        }
        if let (true, Some(stand_in)) = (core, &mut self.core) {
            stand_in.after_edge(&mut self.pins);
        }
        self.pins.settle();
        self.edges[0] += u64::from(bus);
        self.edges[1] += u64::from(core);
    }

    pub fn steps(&mut self, steps: usize) {
        (0..steps).for_each(|_| self.step());
    }

    fn access(&mut self, offset: u32, write: Option<(u32, u32)>) -> (u32, u32) {
        self.bus.begin(offset, write);
        loop {
            self.step();
            if let Some(result) = self.bus.result {
                return result;
            }
        }
    }

    /// Reads a register, which must exist.
    pub fn read(&mut self, register: StreamRegister) -> u32 {
        let (value, response) = self.access(register.offset(), None);
        assert_eq!(response, 0, "{register:?}");
        value
    }

    pub fn write(&mut self, register: StreamRegister, value: u32) {
        assert_eq!(self.access(register.offset(), Some((value, 15))).1, 0, "{register:?}");
    }

    /// Waits until a reset has ended.
    pub fn await_core(&mut self) {
        for _ in 0..200 {
            if self.read(StreamRegister::Status) & (STREAM_STATUS_RUNS | STREAM_STATUS_RESETTING) == STREAM_STATUS_RUNS
            {
                return;
            }
        }
        panic!("the reset does not end");
    }

    /// Returns the words of the next answer, as many as its length says, and checks
    /// its beats against the protocol's page.
    pub fn answer(&mut self, patience: usize) -> Vec<u32> {
        let is_end = |(_, is_last): &(u128, bool)| *is_last;
        for _ in 0..patience {
            if self.bus.came.iter().any(is_end) {
                break;
            }
            self.step();
        }
        let end = self.bus.came.iter().position(is_end).expect("an answer in time");
        let beats: Vec<(u128, bool)> = self.bus.came.drain(..=end).collect();
        let words_of_beat = self.bus.beat_bytes / 4;
        let mut words: Vec<u32> = beats
            .iter()
            .flat_map(|(beat, _)| (0..words_of_beat).map(move |word| (beat >> (32 * word)) as u32))
            .collect();
        let length = 2 + words[1] as usize;
        assert_eq!(beats.len(), length.div_ceil(words_of_beat), "beats of {length} words");
        assert!(words.drain(length..).all(|word| word == 0), "words behind an answer");
        words
    }
}
