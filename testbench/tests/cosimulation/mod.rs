//! Three-way co-simulation of one block: its Rust `update()`, its Verilated Verilog, and an independent statement of what it does.
//!
//! A cycle: inputs are set, everything settles, outputs are compared, the clock rises. What an output shows in a cycle therefore
//! follows from the inputs of that cycle and the edges before it.

use std::collections::VecDeque;

use incircle_testbench::blocks;
use rust_hdl_core::prelude::*;
use verilated::{Model, PortId};

/// Passes a block may take to settle: far more than its depth.
const SETTLING_PASSES: usize = 100;

/// A port value as a number.
pub trait PortValue {
    fn from_number(number: u64) -> Self;
    fn to_number(self) -> u128;
}

impl PortValue for bool {
    fn from_number(number: u64) -> Self {
        number != 0
    }
    fn to_number(self) -> u128 {
        self.into()
    }
}

impl<const N: usize> PortValue for Bits<N> {
    fn from_number(number: u64) -> Self {
        Bits::from(number)
    }
    fn to_number(self) -> u128 {
        self.to_u128()
    }
}

/// A block whose ports are reached by name.
pub trait NamedPorts: Block {
    fn set(&mut self, port: &str, number: u64);
    fn get(&self, port: &str) -> u128;
    fn set_clock(&mut self, high: bool);
}

/// Gives a block [`NamedPorts`]: its type, its inputs, its outputs, and `clock` if it has one.
macro_rules! named_ports {
    ([$($generics:tt)*] $block:ty, [$($input:ident),*], [$($output:ident),*] $(, $clock:ident)?) => {
        impl<$($generics)*> $crate::cosimulation::NamedPorts for $block {
            fn set(&mut self, port: &str, number: u64) {
                use $crate::cosimulation::PortValue;
                match port {
                    $(stringify!($input) => self.$input.next = PortValue::from_number(number),)*
                    _ => panic!("no input {port}"),
                }
            }
            fn get(&self, port: &str) -> u128 {
                use $crate::cosimulation::PortValue;
                match port {
                    $(stringify!($output) => self.$output.val().to_number(),)*
                    _ => panic!("no output {port}"),
                }
            }
            fn set_clock(&mut self, high: bool) {
                $(self.$clock.next = high.into();)?
                let _ = high;
            }
        }
    };
}
pub(crate) use named_ports;

/// What a reference says of an output: a value, or nothing where the contract leaves it open.
pub type Expected = Option<u128>;

/// A block to compare, and the names of its inputs (without the clock) and outputs.
pub struct Cosimulation<'a, U> {
    /// Its name in `incircle_hdl::export::blocks`.
    pub name: &'a str,
    pub rust: U,
    pub inputs: &'a [&'a str],
    pub outputs: &'a [&'a str],
}

impl<U: NamedPorts> Cosimulation<'_, U> {
    /// Runs all three over `stimuli` (a value per input, for each cycle) and compares every output that `reference` fixes.
    /// `reference` is told the inputs of each cycle in order and answers with the outputs of that cycle.
    pub fn run(
        mut self,
        stimuli: impl IntoIterator<Item = Vec<u64>>,
        mut reference: impl FnMut(&[u64]) -> Vec<Expected>,
    ) {
        self.rust.connect_all();
        // Random registers show where an output depends on what nobody wrote.
        let mut model = blocks::randomized(self.name, 1);
        let find = |port: &&str| model.port(port).unwrap_or_else(|error| panic!("{error}"));
        let inputs: Vec<PortId> = self.inputs.iter().map(find).collect();
        let outputs: Vec<PortId> = self.outputs.iter().map(find).collect();
        let is_clocked = model.port("clock").is_ok();
        for (cycle, values) in stimuli.into_iter().enumerate() {
            for ((name, port), value) in self.inputs.iter().zip(&inputs).zip(&values) {
                self.rust.set(name, *value);
                model.set(*port, *value);
            }
            self.rust.set_clock(false);
            self.settle();
            model.eval();
            for ((name, port), expected) in
                self.outputs.iter().zip(&outputs).zip(reference(&values))
            {
                if let Some(expected) = expected {
                    let seen = (self.rust.get(name), number(&model, *port));
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
                self.settle();
                model.clock();
            }
        }
    }

    fn settle(&mut self) {
        assert!(
            simulate(&mut self.rust, SETTLING_PASSES),
            "{} does not settle",
            self.name
        );
    }
}

/// An output of the model as a number.
fn number(model: &Model, port: PortId) -> u128 {
    let mut words = vec![0; port.width().div_ceil(32) as usize];
    model.get_wide(port, &mut words);
    words
        .iter()
        .rev()
        .fold(0, |number, word| number << 32 | u128::from(*word))
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
