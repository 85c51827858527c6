//! Ports of a block by name and as numbers: those of its Rust form, and those of its Verilated Verilog. Packed structures travel as
//! one number.

#![allow(dead_code)] // Every test that includes this uses a part of it.

use incircle_hdl::engine::{
    Attempt, Bundle, CommitJob, Deal, Entry, Plan, ReleaseJob, Token, Turned, Verdict, Write, WriteEnables,
};
use incircle_hdl::leaf::Unpacked;
use incircle_hdl::link::AnswerBeat;
use incircle_hdl::serial::Asked;
use rust_hdl_core::prelude::*;
use verilated::{Model, PortId};

/// Passes a block may take to settle: far more than its depth.
const SETTLING_PASSES: usize = 100;

/// A port value as a number.
pub trait PortValue {
    fn from_number(number: u128) -> Self;
    fn to_number(self) -> u128;
}

impl PortValue for bool {
    fn from_number(number: u128) -> Self {
        number != 0
    }
    fn to_number(self) -> u128 {
        self.into()
    }
}

/// For blocks with several clocks: they are inputs like others there.
impl PortValue for Clock {
    fn from_number(number: u128) -> Self {
        (number != 0).into()
    }
    fn to_number(self) -> u128 {
        self.clk.into()
    }
}

impl<const N: usize> PortValue for Bits<N> {
    fn from_number(number: u128) -> Self {
        let low = Bits::from(number as u64);
        if N > 64 {
            let high: Bits<N> = Bits::from((number >> 64) as u64);
            low | high << 64
        } else {
            low
        }
    }
    fn to_number(self) -> u128 {
        self.to_u128()
    }
}

/// Structures travel packed, the first field in the lowest bits.
macro_rules! packed_values {
    ($($structure:ty),*) => {$(
        impl PortValue for $structure {
            fn from_number(number: u128) -> Self {
                Self::unpacked(Bits::<{ <$structure as Synth>::BITS }>::from_number(number))
            }
            fn to_number(self) -> u128 {
                Bits::<{ <$structure as Synth>::BITS }>::from(self).to_u128()
            }
        }
    )*};
}
packed_values!(
    Token,
    Bundle,
    Turned,
    Attempt,
    CommitJob,
    ReleaseJob,
    Verdict,
    Entry,
    Write,
    WriteEnables,
    Asked,
    AnswerBeat,
    Deal,
    Plan
);

/// A block whose ports are reached by name.
pub trait NamedPorts: Block {
    fn set(&mut self, port: &str, number: impl Into<u128>);
    fn get(&self, port: &str) -> u128;
    fn set_clock(&mut self, high: bool);
}

/// Gives a block [`NamedPorts`]: its type, its inputs, its outputs, and `clock` if it has one. Before the type may stand generic
/// parameters in brackets, or none: `[]`.
#[allow(unused_macros)] // As above.
macro_rules! named_ports {
    ([$($generics:tt)*] $block:ty, [$($input:ident),*], [$($output:ident),*] $(, $clock:ident)?) => {
        impl<$($generics)*> $crate::rig::block_ports::NamedPorts for $block {
            fn set(&mut self, port: &str, number: impl Into<u128>) {
                use $crate::rig::block_ports::PortValue;
                let number = number.into();
                match port {
                    $(stringify!($input) => self.$input.next = PortValue::from_number(number),)*
                    _ => panic!("no input {port}"),
                }
            }
            fn get(&self, port: &str) -> u128 {
                use $crate::rig::block_ports::PortValue;
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
    ($block:ty, $($ports:tt)*) => {
        $crate::rig::block_ports::named_ports!([] $block, $($ports)*);
    };
}
pub(crate) use named_ports;

/// Settles the Rust form of a block.
pub fn settle(block: &mut impl Block, name: &str) {
    assert!(simulate(block, SETTLING_PASSES), "{name} does not settle");
}

/// Drives an input of the model of any width.
pub fn set_number(model: &mut Model, port: PortId, number: u128) {
    let words: Vec<u32> = (0..port.width().div_ceil(32)).map(|word| (number >> (32 * word)) as u32).collect();
    model.set_wide(port, &words);
}

/// An output of the model as a number.
pub fn number(model: &Model, port: PortId) -> u128 {
    let mut words = vec![0; port.width().div_ceil(32) as usize];
    model.get_wide(port, &mut words);
    words.iter().rev().fold(0, |number, word| number << 32 | u128::from(*word))
}
