//! Runs `SharedMemory` in Rust and in Verilog beside plain arrays: all three must agree in every clock.

use crate::rig::cells::cells;
use crate::rig::stepper::{named_ports, Delay, Expected, NamedPorts, Stepper};
use incircle_hdl::leaf::SharedMemory;
use incircle_testkit::SplitMix64;
use rust_hdl_core::prelude::*;

named_ports!([const A: usize, const D: usize] SharedMemory<A, D>,
    [read_address, shared_address, write_data, write_enable], [read_data, shared_data], clock);

const CYCLES: usize = 6_000;

fn shared_memory<const A: usize, const D: usize>(name: &str, address_bits: usize, stored_bits: usize) {
    let mut numbers = SplitMix64::new(25);
    let stimuli: Vec<Vec<u64>> = (0..CYCLES)
        .map(|_| {
            let [read, shared] = [(); 2].map(|()| numbers.bits(A as u32));
            vec![read, shared, numbers.bits(D as u32), numbers.bits(1)]
        })
        .collect();
    let last = (1 << address_bits) - 1;
    // Both forms run: neutral Verilog, and Verilog with the primitives of the ECP5.
    for name in [name.to_string(), format!("{name}_ecp5")] {
        let mut words: Vec<Expected> = vec![None; last + 1];
        let mut delay = Delay::new(SharedMemory::<A, D>::LATENCY);
        Stepper::new(&name, SharedMemory::<A, D>::new(address_bits, stored_bits), 1).run(
            &["read_address", "shared_address", "write_data", "write_enable"],
            &["read_data", "shared_data"],
            stimuli.clone(),
            |values| {
                let [read, shared] = [values[0], values[1]].map(|address| address as usize & last);
                let mut seen = vec![words[read], words[shared]];
                if values[3] == 1 {
                    seen[1] = None;
                    if read == shared {
                        seen[0] = None;
                    }
                    words[shared] = Some(u128::from(values[2]) & ((1 << stored_bits) - 1));
                }
                delay.pass(seen).unwrap_or(vec![None; 2])
            },
        );
    }
}

#[test]
fn shared_memory_reads_twice_or_reads_and_writes() {
    shared_memory::<8, 12>("shared_memory_8x12", 8, 12);
}

#[test]
fn shared_memory_ignores_what_is_above_its_shape() {
    shared_memory::<10, 36>("shared_memory_6x33", 6, 33);
}

#[test]
fn shared_memory_poisons_what_silicon_leaves_open() {
    let mut memory = SharedMemory::<8, 12>::new(8, 12);
    memory.connect_all();
    for (enable, expected) in [(1, None), (0, None), (0, Some(0x555)), (0, Some(0xfff))] {
        if let Some(word) = expected {
            assert_eq!((memory.get("read_data").low, memory.get("shared_data").low), (word, word));
        }
        for (port, value) in
            [("read_address", 7), ("shared_address", 7), ("write_data", 0xfff), ("write_enable", enable)]
        {
            memory.set(port, (value as u128).into());
        }
        for high in [false, true] {
            memory.set_clock(high);
            assert!(simulate(&mut memory, 10), "the memory settles");
        }
    }
}

#[test]
fn shared_memory_is_block_ram_without_bypass_logic() {
    let cells = cells("shared_memory_8x12");
    assert_eq!((cells.block_ram, cells.lut4, cells.flip_flops), (1, 0, 2 * 12));
}
