//! Runs `BlockMemory` in Rust and in Verilog beside an independent reference: all three must agree in every clock.

use crate::rig::memories::{both_forms, edge, memory_reference, memory_stimuli, MEMORY_PORTS};
use crate::rig::stepper::{named_ports, Delay, NamedPorts, Stepper};
use incircle_hdl::leaf::BlockMemory;
use rust_hdl_core::prelude::*;

named_ports!([const A: usize, const D: usize] BlockMemory<A, D>,
    [write_address, write_data, write_enable, read_address], [read_data], clock);

fn block_memory<const A: usize, const D: usize>(name: &str, address_bits: usize, stored_bits: usize) {
    for name in both_forms(name) {
        let mut reference = memory_reference(address_bits, stored_bits);
        let mut delay = Delay::new(BlockMemory::<A, D>::LATENCY);
        Stepper::new(&name, BlockMemory::<A, D>::new(address_bits, stored_bits), 1).run(
            &MEMORY_PORTS,
            &["read_data"],
            memory_stimuli(A, D, address_bits),
            |values| vec![delay.pass(reference(values)).flatten()],
        );
    }
}

#[test]
fn block_memory_gives_back_what_was_written() {
    block_memory::<8, 12>("block_memory_8x12", 8, 12);
}

#[test]
fn block_memory_ignores_what_is_above_its_shape() {
    block_memory::<10, 36>("block_memory_6x33", 6, 33);
}

#[test]
fn block_memory_of_every_width_of_a_block_ram() {
    // The tests above cover words of 18 bits. A word of 20 bits takes more than one block RAM, the last only in part.
    block_memory::<11, 20>("block_memory_11x20", 11, 20);
    block_memory::<12, 10>("block_memory_12x10", 12, 10);
    block_memory::<13, 3>("block_memory_13x3", 13, 3);
    block_memory::<14, 2>("block_memory_14x2", 14, 2);
}

#[test]
fn block_memory_poisons_a_read_that_meets_a_write() {
    let mut memory = BlockMemory::<8, 12>::new(8, 12);
    memory.connect_all();
    let both = [("write_address", 7), ("write_data", 0xfff), ("write_enable", 1), ("read_address", 7)];
    edge(&mut memory, &both);
    edge(&mut memory, &[("write_enable", 0)]);
    assert_eq!(memory.get("read_data").low, 0x555);
    edge(&mut memory, &[]);
    assert_eq!(memory.get("read_data").low, 0xfff);
}
