//! Three-way co-simulation of one block: its Rust `update()`, its Verilated Verilog, and an independent statement of what it does.
//!
//! A cycle: inputs are set, everything settles, outputs are compared, the clock rises. What an output shows in a cycle therefore
//! follows from the inputs of that cycle and the edges before it.

use std::collections::{BTreeMap, VecDeque};
use std::fmt::Debug;

use incircle_testbench::blocks;
use verilated::PortId;

pub(crate) use crate::rig::block_ports::{named_ports, NamedPorts};
use crate::rig::block_ports::{number, plain, set_number, settle, Place, Places, Whole};

/// What a reference says of an output: a value, or nothing where the contract leaves it open.
pub type Expected = Option<u128>;

/// A block to compare, and the names of its inputs (without the clock) and outputs.
pub struct Cosimulation<'a, U> {
    /// Its name in `incircle_blocks::blocks`.
    pub name: &'a str,
    pub rust: U,
    pub inputs: &'a [&'a str],
    /// `name`, or `name[low+:width]` for some bits of an output whose others are open.
    pub outputs: &'a [&'a str],
}

impl<U: NamedPorts> Cosimulation<'_, U> {
    /// Runs all three over `stimuli` (a value per input, for each cycle) and compares every output that `reference` fixes.
    /// `reference` is told the inputs of each cycle in order and answers with the outputs of that cycle.
    pub fn run<V: Copy + Into<u128> + Debug>(
        mut self,
        stimuli: impl IntoIterator<Item = Vec<V>>,
        mut reference: impl FnMut(&[V]) -> Vec<Expected>,
    ) {
        self.rust.connect_all();
        // Random registers show where an output depends on what nobody wrote.
        let mut model = blocks::randomized(self.name, 1);
        let places = Places::new(&model, |port| self.rust.layout(port));
        let ids: BTreeMap<String, PortId> = model
            .description()
            .ports()
            .map(|port| (plain(port.name), model.port(port.name).expect("a port")))
            .collect();
        let inputs: Vec<Place> = self.inputs.iter().map(|port| places.find(port)).collect();
        let mut driven: BTreeMap<String, Whole> = BTreeMap::new();
        let parts: Vec<_> = self.outputs.iter().map(|output| part(output)).collect();
        let outputs: Vec<Place> = parts.iter().map(|(port, ..)| places.find(port)).collect();
        let is_clocked = model.port("clock").is_ok();
        for (cycle, values) in stimuli.into_iter().enumerate() {
            assert_eq!(values.len(), inputs.len(), "a value for each input");
            for (place, value) in inputs.iter().zip(&values) {
                let whole = driven.entry(place.port.clone()).or_default();
                *whole = place.put_into(*whole, (*value).into());
                self.rust.set(&place.port, *whole);
                set_number(&mut model, ids[&place.port], *whole);
            }
            self.rust.set_clock(false);
            settle(&mut self.rust, self.name);
            model.eval();
            let expected = reference(&values);
            assert_eq!(expected.len(), outputs.len(), "a value for each output");
            for (((name, low, mask), place), expected) in parts.iter().zip(&outputs).zip(expected) {
                if let Some(expected) = expected {
                    let seen = (self.rust.get(&place.port), number(&model, ids[&place.port]));
                    let seen = (place.part_of(seen.0), place.part_of(seen.1));
                    let seen = (seen.0 >> low & mask, seen.1 >> low & mask);
                    assert_eq!(
                        seen,
                        (expected, expected),
                        "{} in cycle {cycle}: {name} in Rust and in Verilog, against the reference; inputs {values:x?}",
                        self.name
                    );
                }
            }
            if is_clocked {
                self.rust.set_clock(true);
                settle(&mut self.rust, self.name);
                model.clock();
            }
        }
    }
}

/// The port of `name` or `name[low+:width]`, the lowest bit, and a mask.
fn part(output: &str) -> (&str, u32, u128) {
    let Some((name, range)) = output.strip_suffix(']').and_then(|part| part.split_once('[')) else {
        return (output, 0, u128::MAX);
    };
    let (low, width) = range.split_once("+:").expect("a range as [low+:width]");
    let number = |digits: &str| digits.parse::<u32>().expect("a number");
    (name, number(low), (1 << number(width)) - 1)
}

/// Values that come out a number of clocks after they went in.
pub struct Delay<T>(VecDeque<Option<T>>);

impl<T> Delay<T> {
    pub fn new(edges: usize) -> Self {
        Self((0..edges).map(|_| None).collect())
    }

    /// The value of that many calls ago; nothing at first.
    pub fn pass(&mut self, value: T) -> Option<T> {
        self.0.push_back(Some(value));
        self.0.pop_front().flatten()
    }
}

/// A small generator of numbers (xorshift64*), so that a failure repeats.
pub struct Numbers(u64);

impl Numbers {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(2) | 1)
    }

    pub fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// A number of `bits` bits.
    pub fn bits(&mut self, bits: u32) -> u64 {
        self.next() >> (64 - bits)
    }

    /// True once in `times`.
    pub fn once_in(&mut self, times: u64) -> bool {
        (self.next() >> 32).is_multiple_of(times)
    }
}
