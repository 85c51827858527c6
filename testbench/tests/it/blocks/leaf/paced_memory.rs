//! Runs `PacedMemory` in Rust and in Verilog beside an independent reference: all three must agree in every clock.

use crate::rig::memories::{both_forms, edge, memory_reference, memory_stimuli};
use crate::rig::stepper::{named_ports, Delay, NamedPorts, Stepper};
use incircle_hdl::leaf::PacedMemory;
use incircle_testkit::SplitMix64;
use rust_hdl_core::prelude::*;

named_ports!([const A: usize, const D: usize] PacedMemory<A, D>,
    [write_address, write_data, write_enable, read_address, read_enable], [read_data], clock);

fn paced_memory<const A: usize, const D: usize>(name: &str, address_bits: usize, stored_bits: usize) {
    let mut numbers = SplitMix64::new(8);
    let mut stimuli = memory_stimuli(A, D, address_bits);
    for (cycle, values) in stimuli.iter_mut().enumerate() {
        // Reads at every edge, then at most edges, then at few.
        let is_enabled = match (cycle / 100) % 3 {
            0 => true,
            1 => !numbers.once_in(3),
            _ => numbers.once_in(4),
        };
        values.push(is_enabled.into());
        if !is_enabled && numbers.once_in(2) {
            // A port that stands still may meet a write.
            values[3] = values[0];
        }
    }
    for name in both_forms(name) {
        let mut reference = memory_reference(address_bits, stored_bits);
        let mut delay = Delay::new(PacedMemory::<A, D>::LATENCY - 1);
        let mut shown = None;
        Stepper::new(&name, PacedMemory::<A, D>::new(address_bits, stored_bits), 1).run(
            &["write_address", "write_data", "write_enable", "read_address", "read_enable"],
            &["read_data"],
            stimuli.clone(),
            |values| {
                let before = shown;
                let read = reference(values);
                if values[4] == 1 {
                    shown = delay.pass(read).flatten();
                }
                vec![before]
            },
        );
    }
}

#[test]
fn paced_memory_moves_only_when_enabled() {
    paced_memory::<8, 12>("paced_memory_8x12", 8, 12);
}

#[test]
fn paced_memory_ignores_what_is_above_its_shape() {
    paced_memory::<10, 36>("paced_memory_6x33", 6, 33);
}

#[test]
fn paced_memory_poisons_only_a_read_that_is_enabled() {
    let mut memory = PacedMemory::<8, 12>::new(8, 12);
    memory.connect_all();
    let both = [("write_address", 7), ("write_data", 0xfff), ("write_enable", 1), ("read_address", 7)];
    edge(&mut memory, &[&both[..], &[("read_enable", 1)]].concat());
    edge(&mut memory, &[("write_enable", 1), ("read_enable", 0)]);
    edge(&mut memory, &[("write_enable", 0), ("read_enable", 1)]);
    assert_eq!(memory.get("read_data").low, 0x555);
    edge(&mut memory, &[]);
    assert_eq!(memory.get("read_data").low, 0xfff);
}
