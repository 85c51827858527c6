//! Helpers for the tests of memories: both forms of a block, stimuli, and a memory as an array.

use crate::rig::stepper::{Expected, NamedPorts};
use incircle_testkit::SplitMix64;
use rust_hdl_core::prelude::*;

const CYCLES: usize = 20_000;

pub const MEMORY_PORTS: [&str; 4] = ["write_address", "write_data", "write_enable", "read_address"];

/// Names of the models of a block: neutral Verilog, and Verilog with the primitives of the ECP5.
pub fn both_forms(name: &str) -> [String; 2] {
    [name.to_string(), format!("{name}_ecp5")]
}

/// Runs one clock of a block in Rust alone.
pub fn edge(block: &mut impl NamedPorts, inputs: &[(&str, u64)]) {
    for (port, value) in inputs {
        block.set(port, u128::from(*value).into());
    }
    for high in [false, true] {
        block.set_clock(high);
        assert!(simulate(block, 10), "the block settles");
    }
}

/// Random reads and writes in which a read never meets a write of the same word.
pub fn memory_stimuli(port_bits: usize, data_bits: usize, word_bits: usize) -> Vec<Vec<u64>> {
    let mut numbers = SplitMix64::new(2);
    let word = (1 << word_bits) - 1;
    (0..CYCLES)
        .map(|_| {
            let write = numbers.bits(port_bits as u32);
            let mut read = numbers.bits(port_bits as u32);
            if (read ^ write) & word == 0 {
                read ^= 1;
            }
            vec![write, numbers.bits(data_bits as u32), numbers.bits(1), read]
        })
        .collect()
}

/// A memory as an array: returns the word that the inputs of a cycle read, then does their write.
pub fn memory_reference(address_bits: usize, stored_bits: usize) -> impl FnMut(&[u64]) -> Expected {
    let mut words: Vec<Expected> = vec![None; 1 << address_bits];
    let last = words.len() - 1;
    move |values| {
        let read = words[values[3] as usize & last];
        if values[2] == 1 {
            let written = values[1] & ((1 << stored_bits) - 1);
            words[values[0] as usize & last] = Some(written.into());
        }
        read
    }
}
