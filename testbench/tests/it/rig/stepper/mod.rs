//! Steps a block in two forms together, its Rust `update()` and its Verilated Verilog, and compares both with what the
//! test expects. A test either closes the loop itself (it reads the outputs of a clock, states what they must be, and
//! answers with inputs), or hands all inputs and a reference to [`Stepper::run`].
//!
//! In a clock, inputs are set, [`Stepper::settle`] is called, outputs are compared, and [`Stepper::edge`] follows.
//! Packed structures are numbers here, put together by `bundles`, which states their layout a second time.

pub mod bundles;
mod delay;
mod wave;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Debug;

use incircle_testbench::blocks;
use verilated::{Model, PortId};

pub(crate) use crate::rig::block_ports::{named_ports, NamedPorts};
use crate::rig::block_ports::{number, plain, set_number, settle, Place, Places, Whole};
pub use delay::Delay;
pub use wave::{Cell, Wave};

/// Value that a reference gives for an output, or `None` where the contract leaves it open.
pub type Expected = Option<u128>;

/// Both forms of a block, and the number of clocks that have passed.
pub struct Stepper<U> {
    name: String,
    rust: U,
    model: Model,
    ports: BTreeMap<String, PortId>,
    places: Places,
    /// Values of the inputs as they were set last.
    inputs: BTreeMap<String, Whole>,
    /// Inputs that were set since the block settled last.
    changed: BTreeSet<String>,
    clocks: usize,
}

impl<U: NamedPorts> Stepper<U> {
    /// Makes the block of this name in `incircle_blocks::blocks`. Its Verilog starts with random registers and
    /// memories, which shows where an output depends on a value that nobody wrote.
    pub fn new(name: impl Into<String>, mut rust: U, seed: u32) -> Self {
        let name = name.into();
        rust.connect_all();
        let model = blocks::randomized(&name, seed);
        let ports = model.description().ports();
        let ports = ports.map(|port| (plain(port.name), model.port(port.name).expect("a port it lists"))).collect();
        let places = Places::new(&model, |port| rust.layout(port));
        Self { name, rust, model, ports, places, inputs: BTreeMap::new(), changed: BTreeSet::new(), clocks: 0 }
    }

    /// Number of clocks that have passed.
    pub fn clocks(&self) -> usize {
        self.clocks
    }

    /// Sets an input, or a field of an input that carries a structure.
    pub fn set(&mut self, port: &str, number: impl Into<u128>) {
        self.set_place(&self.places.find(port), number.into());
    }

    fn set_place(&mut self, place: &Place, number: u128) {
        let whole = self.inputs.entry(place.port.clone()).or_default();
        *whole = place.put_into(*whole, number);
        self.changed.insert(place.port.clone());
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
        settle(&mut self.rust, &self.name);
        self.model.eval();
    }

    /// Reads an output, which must be the same in both forms.
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

    /// Compares an output of both forms with the expected value.
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

    /// Compares some bits of an output, as [`Stepper::expect`] does.
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

    /// Reads some bits of an output, as [`Stepper::get`] does.
    pub fn get_masked(&self, port: &str, mask: u128) -> u128 {
        let seen = self.both(port);
        self.expect_masked(port, mask, seen.0 & mask);
        seen.0 & mask
    }

    /// Passes a rising edge.
    pub fn edge(&mut self) {
        self.drive();
        self.rust.set_clock(true);
        settle(&mut self.rust, &self.name);
        self.model.clock();
        self.clocks += 1;
    }

    /// Runs the block over `stimuli`, which hold a value for each of `inputs` in each clock, and compares every one of
    /// `outputs` that `reference` fixes. `reference` is called with the inputs of each clock in order. It returns the
    /// outputs of that clock, which follow from those inputs and from the edges before.
    ///
    /// Inputs and outputs are named as in [`Places::find`].
    pub fn run<V: Copy + Into<u128> + Debug>(
        mut self,
        inputs: &[&str],
        outputs: &[&str],
        stimuli: impl IntoIterator<Item = Vec<V>>,
        mut reference: impl FnMut(&[V]) -> Vec<Expected>,
    ) {
        let places = |names: &[&str]| names.iter().map(|name| self.places.find(name)).collect();
        let (input_places, output_places): (Vec<Place>, Vec<Place>) = (places(inputs), places(outputs));
        let is_clocked = self.ports.contains_key("clock");
        for (clock, values) in stimuli.into_iter().enumerate() {
            assert_eq!(values.len(), inputs.len(), "a value for each input");
            for (place, value) in input_places.iter().zip(&values) {
                self.set_place(place, (*value).into());
            }
            self.settle();
            let expected = reference(&values);
            assert_eq!(expected.len(), outputs.len(), "a value for each output");
            for ((output, place), expected) in outputs.iter().zip(&output_places).zip(expected) {
                let Some(expected) = expected else { continue };
                assert_eq!(
                    self.both_at(place),
                    (expected, expected),
                    "{} in clock {clock}: {output} in Rust and in Verilog, against the reference; inputs {values:x?}",
                    self.name
                );
            }
            if is_clocked {
                self.edge();
            }
        }
    }

    fn both(&self, port: &str) -> (u128, u128) {
        self.both_at(&self.places.find(port))
    }

    fn both_at(&self, place: &Place) -> (u128, u128) {
        let whole = (self.rust.get(&place.port), number(&self.model, self.ports[&place.port]));
        (place.part_of(whole.0), place.part_of(whole.1))
    }
}
