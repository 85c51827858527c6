//! One block in two forms, its Rust `update()` and its Verilated Verilog, stepped together in a closed loop: the test looks at
//! the outputs of a clock, says what they must be, and answers with inputs.
//!
//! A clock: inputs are set, [`Stepper::settle`], outputs are compared, [`Stepper::edge`]. Packed structures are numbers here, put
//! together by `bundles`, which is a statement of their layout of its own.

pub mod bundles;
mod wave;

use std::collections::{BTreeMap, BTreeSet};

use incircle_testbench::blocks;
use verilated::{Model, PortId};

pub(crate) use crate::rig::block_ports::{named_ports, NamedPorts};
use crate::rig::block_ports::{number, plain, set_number, settle, Places, Whole};
pub use wave::{Cell, Wave};

/// Both forms of a block, and the clocks that have passed.
pub struct Stepper<U> {
    name: &'static str,
    rust: U,
    model: Model,
    ports: BTreeMap<String, PortId>,
    places: Places,
    /// The inputs as they were set last.
    inputs: BTreeMap<String, Whole>,
    /// Inputs that have been set since the block settled last.
    changed: BTreeSet<String>,
    clocks: usize,
}

impl<U: NamedPorts> Stepper<U> {
    /// The block of this name in `incircle_blocks::blocks`. Its Verilog starts with random registers and memories, which
    /// shows where an output depends on what nobody wrote.
    pub fn new(name: &'static str, mut rust: U, seed: u32) -> Self {
        rust.connect_all();
        let model = blocks::randomized(name, seed);
        let ports = model.description().ports();
        let ports = ports.map(|port| (plain(port.name), model.port(port.name).expect("a port it lists"))).collect();
        let places = Places::new(&model, |port| rust.layout(port));
        Self { name, rust, model, ports, places, inputs: BTreeMap::new(), changed: BTreeSet::new(), clocks: 0 }
    }

    /// Clocks that have passed.
    pub fn clocks(&self) -> usize {
        self.clocks
    }

    /// Sets an input, or a field of one that carries a structure.
    pub fn set(&mut self, port: &str, number: impl Into<u128>) {
        let place = self.places.find(port);
        let whole = self.inputs.entry(place.port.clone()).or_default();
        *whole = place.put_into(*whole, number.into());
        self.changed.insert(place.port);
    }

    fn drive(&mut self) {
        for port in std::mem::take(&mut self.changed) {
            let whole = self.inputs[&port];
            self.rust.set(&port, whole);
            set_number(&mut self.model, self.ports[&port], whole);
        }
    }

    /// Brings the outputs up to date with the inputs.
    pub fn settle(&mut self) {
        self.drive();
        self.rust.set_clock(false);
        settle(&mut self.rust, self.name);
        self.model.eval();
    }

    /// An output, which must be the same in both forms.
    pub fn get(&self, port: &str) -> u128 {
        let (rust, verilog) = self.both(port);
        assert_eq!(
            rust, verilog,
            "{} in clock {}: {port} in Rust and in Verilog ({rust:#x} and {verilog:#x})",
            self.name, self.clocks
        );
        rust
    }

    pub fn is(&self, port: &str) -> bool {
        self.get(port) == 1
    }

    /// Compares an output of both forms with what it must be.
    pub fn expect(&self, port: &str, expected: impl Into<u128>) {
        let (expected, seen) = (expected.into(), self.both(port));
        assert_eq!(
            seen,
            (expected, expected),
            "{} in clock {}: {port} in Rust and in Verilog ({:#x} and {:#x}), against what it must be ({expected:#x})",
            self.name,
            self.clocks,
            seen.0,
            seen.1
        );
    }

    /// As [`Stepper::expect`], for some bits of the output.
    pub fn expect_masked(&self, port: &str, mask: u128, expected: impl Into<u128>) {
        let (expected, seen) = (expected.into(), self.both(port));
        assert_eq!(
            (seen.0 & mask, seen.1 & mask),
            (expected, expected),
            "{} in clock {}: {port} in Rust and in Verilog, its bits {mask:#x}",
            self.name,
            self.clocks
        );
    }

    /// As [`Stepper::get`], for some bits of the output.
    pub fn get_masked(&self, port: &str, mask: u128) -> u128 {
        let seen = self.both(port);
        self.expect_masked(port, mask, seen.0 & mask);
        seen.0 & mask
    }

    /// A rising edge.
    pub fn edge(&mut self) {
        self.drive();
        self.rust.set_clock(true);
        settle(&mut self.rust, self.name);
        self.model.clock();
        self.clocks += 1;
    }

    fn both(&self, port: &str) -> (u128, u128) {
        let place = self.places.find(port);
        let whole = (self.rust.get(&place.port), number(&self.model, self.ports[&place.port]));
        (place.part_of(whole.0), place.part_of(whole.1))
    }
}
