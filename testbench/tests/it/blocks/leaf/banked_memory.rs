//! Runs `BankedMemory` in Rust and in Verilog beside an independent reference: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::leaf::BankedMemory;
use incircle_testkit::SplitMix64;

named_ports!([const M: usize, const B: usize, const A: usize, const D: usize] BankedMemory<M, B, A, D>,
    [write_bank, write_address, write_data, write_enable, read_banks, read_address], [read_data], clock);

const CYCLES: usize = 20_000;

fn banked_memory<const M: usize, const B: usize, const A: usize, const D: usize>(
    name: &str,
    (banks, address_bits, stored_bits): (usize, usize, usize),
) {
    let mut numbers = SplitMix64::new(9);
    let stimuli: Vec<_> = (0..CYCLES)
        .map(|_| {
            // Banks that exist, and now and then one that does not; one bank is read, or none.
            let bank = numbers.bits(B as u32) % (banks as u64 + 1);
            let read = 1u64 << (numbers.bits(B as u32) % (M as u64 + 1));
            let [write_address, read_address] = [(); 2].map(|()| numbers.bits(A as u32));
            let read_banks = read & ((1 << M) - 1);
            vec![bank, write_address, numbers.bits(D as u32), numbers.bits(1), read_banks, read_address]
        })
        .collect();
    let last = (1u64 << address_bits) - 1;
    let mut words = vec![vec![None; 1 << address_bits]; banks];
    Stepper::new(name, BankedMemory::<M, B, A, D>::new(banks, address_bits, stored_bits), 1).run(
        &["write_bank", "write_address", "write_data", "write_enable", "read_banks", "read_address"],
        &["read_data"],
        stimuli,
        |values| {
            let bank = (0..banks).find(|bank| values[4] >> bank & 1 == 1);
            let read = bank.map_or(Some(0), |bank| words[bank][(values[5] & last) as usize]);
            if let Some(bank) = words.get_mut(values[0] as usize).filter(|_| values[3] == 1) {
                bank[(values[1] & last) as usize] = Some(u128::from(values[2] & ((1 << stored_bits) - 1)));
            }
            vec![read]
        },
    );
}

#[test]
fn banked_memory_reads_the_bank_that_is_named() {
    banked_memory::<6, 3, 4, 8>("banked_memory_6x4x8", (6, 4, 8));
}

#[test]
fn banked_memory_ignores_what_is_above_its_shape() {
    banked_memory::<24, 5, 6, 7>("banked_memory_3x2x5", (3, 2, 5));
}
