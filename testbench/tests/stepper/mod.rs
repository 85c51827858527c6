//! One block in two forms, its Rust `update()` and its Verilated Verilog, stepped together in a closed loop: the test looks at
//! the outputs of a clock, says what they must be, and answers with inputs.
//!
//! A clock: inputs are set, [`Stepper::settle`], outputs are compared, [`Stepper::edge`]. Packed structures are numbers here, put
//! together by `bundles`, which is a statement of their layout of its own.

#![allow(dead_code)] // Every test that includes this uses a part of it.

pub mod bundles;
mod wave;

use std::collections::BTreeMap;

use incircle_hdl::engine::{Bundle, Entry, Token, Turned, Verdict, Write};
use incircle_hdl::leaf::Unpacked;
use incircle_testbench::blocks;
use rust_hdl_core::prelude::*;
use verilated::{Model, PortId};

#[allow(unused_imports)] // As above.
pub use wave::{Cell, Wave};

/// Passes a block may take to settle: far more than its depth.
const SETTLING_PASSES: usize = 100;

/// A port value as a number.
pub trait PortNumber {
    fn from_number(number: u128) -> Self;
    fn to_number(self) -> u128;
}

impl PortNumber for bool {
    fn from_number(number: u128) -> Self {
        number != 0
    }
    fn to_number(self) -> u128 {
        self.into()
    }
}

impl<const N: usize> PortNumber for Bits<N> {
    fn from_number(number: u128) -> Self {
        let low = Bits::from(number as u64);
        if N <= 64 {
            return low;
        }
        low | Bits::from((number >> 64) as u64) << 64u64
    }
    fn to_number(self) -> u128 {
        self.to_u128()
    }
}

macro_rules! packed_port_numbers {
    ($($name:ident),*) => {$(
        impl PortNumber for $name {
            fn from_number(number: u128) -> Self {
                Self::unpacked(Bits::<{ $name::BITS }>::from_number(number))
            }
            fn to_number(self) -> u128 {
                Bits::<{ $name::BITS }>::from(self).to_u128()
            }
        }
    )*};
}
packed_port_numbers!(Bundle, Entry, Token, Turned, Verdict, Write);

/// A block whose ports are reached by name.
pub trait Ports: Block {
    fn set(&mut self, port: &str, number: u128);
    fn get(&self, port: &str) -> u128;
    fn set_clock(&mut self, high: bool);
}

/// Gives a block [`Ports`]: its type, its inputs, its outputs, and `clock` if it has one.
macro_rules! ports {
    ($block:ty, [$($input:ident),*], [$($output:ident),*] $(, $clock:ident)?) => {
        impl $crate::stepper::Ports for $block {
            fn set(&mut self, port: &str, number: u128) {
                use $crate::stepper::PortNumber;
                match port {
                    $(stringify!($input) => self.$input.next = PortNumber::from_number(number),)*
                    _ => panic!("no input {port}"),
                }
            }
            fn get(&self, port: &str) -> u128 {
                use $crate::stepper::PortNumber;
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
pub(crate) use ports;

/// Both forms of a block, and the clocks that have passed.
pub struct Stepper<U> {
    name: &'static str,
    rust: U,
    model: Model,
    ports: BTreeMap<&'static str, PortId>,
    clocks: usize,
}

impl<U: Ports> Stepper<U> {
    /// The block of this name in `incircle_hdl::export::blocks`. Its Verilog starts with random registers and memories, which
    /// shows where an output depends on what nobody wrote.
    pub fn new(name: &'static str, mut rust: U, seed: u32) -> Self {
        rust.connect_all();
        let model = blocks::randomized(name, seed);
        let ports = model.description().ports();
        let ports = ports
            .map(|port| (port.name, model.port(port.name).expect("a port it lists")))
            .collect();
        Self {
            name,
            rust,
            model,
            ports,
            clocks: 0,
        }
    }

    /// Clocks that have passed.
    pub fn clocks(&self) -> usize {
        self.clocks
    }

    pub fn set(&mut self, port: &str, number: impl Into<u128>) {
        let number = number.into();
        self.rust.set(port, number);
        let id = self.ports[port];
        let words: Vec<u32> = (0..id.width().div_ceil(32))
            .map(|word| (number >> (32 * word)) as u32)
            .collect();
        self.model.set_wide(id, &words);
    }

    /// Brings the outputs up to date with the inputs.
    pub fn settle(&mut self) {
        self.rust.set_clock(false);
        self.settle_rust();
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
        self.rust.set_clock(true);
        self.settle_rust();
        self.model.clock();
        self.clocks += 1;
    }

    fn both(&self, port: &str) -> (u128, u128) {
        let id = self.ports[port];
        let mut words = vec![0; id.width().div_ceil(32) as usize];
        self.model.get_wide(id, &mut words);
        let join = |number: u128, word: &u32| number << 32 | u128::from(*word);
        (self.rust.get(port), words.iter().rev().fold(0, join))
    }

    fn settle_rust(&mut self) {
        assert!(
            simulate(&mut self.rust, SETTLING_PASSES),
            "{} does not settle",
            self.name
        );
    }
}
