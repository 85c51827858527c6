//! Runs `Fifo` in Rust and in Verilog beside an independent reference: all three must agree in every clock.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, NamedPorts, Stepper};
use incircle_hdl::leaf::Fifo;
use incircle_testkit::SplitMix64;

named_ports!([const A: usize, const D: usize] Fifo<A, D>,
    [reset, push, push_data, pop], [valid, data], clock);

const CYCLES: usize = 20_000;

/// Pushes and pops at changing rates, within the contract: never more entries than places, and
/// no pop from an empty buffer.
fn fifo_stimuli(data_bits: usize, places: u32) -> Vec<Vec<u64>> {
    let mut numbers = SplitMix64::new(7);
    let mut held = 0;
    (0..CYCLES as u64)
        .map(|cycle| {
            let reset = cycle == 0 || numbers.once_in(200);
            let pace = 1 + (cycle / 50) % 4;
            let push = held < places && numbers.once_in(pace);
            let pop = (held > 0 || push) && numbers.once_in(5 - pace);
            held = if reset { 0 } else { held + u32::from(push) - u32::from(pop) };
            vec![reset.into(), push.into(), numbers.bits(data_bits as u32), pop.into()]
        })
        .collect()
}

/// Runs a buffer beside a queue; the stimuli must fill it to its last place and empty it again.
pub fn queue<U: NamedPorts>(name: &str, rust: U, places: usize, stored_bits: usize, stimuli: Vec<Vec<u64>>) {
    let mut entries = VecDeque::new();
    let mut is_reset = false;
    let mut times_full = 0;
    let mut times_empty = 0;
    Stepper::new(name, rust, 1).run(&["reset", "push", "push_data", "pop"], &["valid", "data"], stimuli, |values| {
        if values[1] == 1 {
            entries.push_back(u128::from(values[2]) & ((1 << stored_bits) - 1));
        }
        // Registers start with random values, so the outputs before the first reset are open.
        let shown = match is_reset {
            true => vec![Some(u128::from(!entries.is_empty())), entries.front().copied()],
            false => vec![None, None],
        };
        is_reset |= values[0] == 1;
        if values[3] == 1 {
            entries.pop_front();
        }
        if values[0] == 1 {
            entries.clear();
        }
        times_full += usize::from(entries.len() == places);
        times_empty += usize::from(entries.is_empty());
        shown
    });
    assert!(times_full > 10 && times_empty > 10, "full {times_full} times, empty {times_empty} times");
}

fn fifo<const A: usize, const D: usize>(name: &str, address_bits: usize, stored_bits: usize) {
    let rust = Fifo::<A, D>::new(address_bits, stored_bits);
    queue(name, rust, 1 << address_bits, stored_bits, fifo_stimuli(D, 1 << address_bits));
}

#[test]
fn fifo_keeps_order_in_every_place() {
    fifo::<3, 8>("fifo_3x8", 3, 8);
}

#[test]
fn fifo_ignores_what_is_above_its_shape() {
    fifo::<6, 40>("fifo_2x37", 2, 37);
}
