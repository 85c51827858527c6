//! Runs `DeepFifo` in Rust and in Verilog beside an independent reference: all three must agree in every clock.

use super::fifo::queue;
use crate::rig::stepper::named_ports;
use incircle_hdl::leaf::DeepFifo;
use incircle_testkit::SplitMix64;

named_ports!([const A: usize, const D: usize] DeepFifo<A, D>,
    [reset, push, push_data, pop], [valid, data], clock);

const CYCLES: usize = 20_000;

/// Pushes and pops as [`fifo_stimuli`] does, at any pair of rates, for so long that a deep buffer fills and empties.
fn deep_fifo_stimuli(data_bits: usize, places: u32) -> Vec<Vec<u64>> {
    let mut numbers = SplitMix64::new(9);
    let (mut held, mut push_pace, mut pop_pace, mut left) = (0, 1, 1, 0);
    (0..4 * CYCLES)
        .map(|cycle| {
            if left == 0 {
                // Short spells end in the middle of a fetch, long ones at either end of the buffer.
                let most = if numbers.once_in(4) { 10 } else { u64::from(4 * places) };
                left = 1 + numbers.below(most);
                // A rate of 0 is silence.
                (push_pace, pop_pace) = (numbers.below(5), numbers.below(5));
            }
            left -= 1;
            let reset = cycle == 0 || numbers.once_in(5000);
            let push = held < places && push_pace > 0 && numbers.once_in(push_pace);
            let pop = (held > 0 || push) && pop_pace > 0 && numbers.once_in(pop_pace);
            held = if reset { 0 } else { held + u32::from(push) - u32::from(pop) };
            vec![reset.into(), push.into(), numbers.bits(data_bits as u32), pop.into()]
        })
        .collect()
}

fn deep_fifo<const A: usize, const D: usize>(name: &str, address_bits: usize, stored_bits: usize) {
    let rust = DeepFifo::<A, D>::new(address_bits, stored_bits);
    queue(name, rust, 1 << address_bits, stored_bits, deep_fifo_stimuli(D, 1 << address_bits));
}

#[test]
fn deep_fifo_is_an_ideal_buffer() {
    deep_fifo::<8, 8>("deep_fifo_8x8", 8, 8);
}

#[test]
fn deep_fifo_of_the_least_depth() {
    deep_fifo::<9, 40>("deep_fifo_5x37", 5, 37);
}

#[test]
#[should_panic(expected = "a deep buffer has more than 4 address bits, not 4")]
fn deep_fifo_refuses_what_a_fifo_holds() {
    DeepFifo::<6, 8>::new(4, 8);
}
