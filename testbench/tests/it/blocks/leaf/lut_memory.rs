//! Runs `LutMemory` in Rust and in Verilog beside an independent reference: all three must agree in every clock.

use crate::rig::memories::{memory_reference, memory_stimuli, MEMORY_PORTS};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::leaf::LutMemory;

named_ports!([const A: usize, const D: usize] LutMemory<A, D>,
    [write_address, write_data, write_enable, read_address], [read_data], clock);

fn lut_memory<const A: usize, const D: usize>(name: &str, address_bits: usize, stored_bits: usize) {
    let mut reference = memory_reference(address_bits, stored_bits);
    Stepper::new(name, LutMemory::<A, D>::new(address_bits, stored_bits), 1).run(
        &MEMORY_PORTS,
        &["read_data"],
        memory_stimuli(A, D, address_bits),
        |values| vec![reference(values)],
    );
}

#[test]
fn lut_memory_reads_at_once() {
    lut_memory::<4, 8>("lut_memory_4x8", 4, 8);
}

#[test]
fn lut_memory_ignores_what_is_above_its_shape() {
    lut_memory::<6, 40>("lut_memory_5x37", 5, 37);
}
