//! The leaves of the core: Rust behaviour, Verilog and an independent reference agree clock by clock.

use std::collections::VecDeque;

use crate::rig::cosimulation::{named_ports, Cosimulation, Delay, Expected, NamedPorts, Numbers};
use incircle_hdl::leaf::{
    BankedMemory, BlockMemory, DeepFifo, DelayLine, Fifo, FlagDelay, LockMemory, LutMemory, Multiplier, PacedMemory,
};
use rust_hdl_core::prelude::*;

named_ports!([] Multiplier, [a, b], [product], clock);
named_ports!([const A: usize, const D: usize] BlockMemory<A, D>,
    [write_address, write_data, write_enable, read_address], [read_data], clock);
named_ports!([const A: usize, const D: usize] PacedMemory<A, D>,
    [write_address, write_data, write_enable, read_address, read_enable], [read_data], clock);
named_ports!([const A: usize, const D: usize] LutMemory<A, D>,
    [write_address, write_data, write_enable, read_address], [read_data], clock);
named_ports!([const M: usize, const B: usize, const A: usize, const D: usize] BankedMemory<M, B, A, D>,
    [write_bank, write_address, write_data, write_enable, read_banks, read_address], [read_data], clock);
named_ports!([const A: usize] LockMemory<A>,
    [test_address, test_set, clear_address, clear_enable], [was_set], clock);
named_ports!([const D: usize] DelayLine<D>, [data_in], [data_out], clock);
named_ports!([] FlagDelay, [flag_in], [flag_out], clock);
named_ports!([const A: usize, const D: usize] Fifo<A, D>,
    [reset, push, push_data, pop], [valid, data], clock);
named_ports!([const A: usize, const D: usize] DeepFifo<A, D>,
    [reset, push, push_data, pop], [valid, data], clock);

const CYCLES: usize = 20_000;
const MEMORY_PORTS: [&str; 4] = ["write_address", "write_data", "write_enable", "read_address"];
const LOCK_PORTS: [&str; 4] = ["test_address", "test_set", "clear_address", "clear_enable"];

/// The model of a block as neutral Verilog, and that with the primitives of the ECP5.
fn both_forms(name: &str) -> [String; 2] {
    [name.to_string(), format!("{name}_ecp5")]
}

/// Runs a block in Rust alone.
fn edge(block: &mut impl NamedPorts, inputs: &[(&str, u64)]) {
    for (port, value) in inputs {
        block.set(port, *value);
    }
    for high in [false, true] {
        block.set_clock(high);
        assert!(simulate(block, 10), "the block settles");
    }
}

fn signed(value: u64, bits: u32) -> i64 {
    ((value << (64 - bits)) as i64) >> (64 - bits)
}

#[test]
fn multiplier_multiplies_in_three_clocks() {
    let corners = [0, 1, 0x1_ffff, 0x2_0000, 0x2_0001, 0x3_ffff];
    let mut numbers = Numbers::new(1);
    let mut stimuli: Vec<_> = corners.iter().flat_map(|a| corners.iter().map(|b| vec![*a, *b])).collect();
    stimuli.extend((0..CYCLES).map(|_| vec![numbers.bits(18), numbers.bits(18)]));
    for name in both_forms("multiplier") {
        let mut delay = Delay::new(Multiplier::LATENCY);
        Cosimulation { name: &name, rust: Multiplier::default(), inputs: &["a", "b"], outputs: &["product"] }.run(
            stimuli.clone(),
            |values| {
                let product = signed(values[0], 18) * signed(values[1], 18);
                vec![delay.pass(u128::from(product as u64 & 0xf_ffff_ffff))]
            },
        );
    }
}

/// Random reads and writes; a read never meets a write of the same word.
fn memory_stimuli(port_bits: usize, data_bits: usize, word_bits: usize) -> Vec<Vec<u64>> {
    let mut numbers = Numbers::new(2);
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

/// A memory as an array: the word that the inputs of a cycle read, and then its write.
fn memory_reference(address_bits: usize, stored_bits: usize) -> impl FnMut(&[u64]) -> Expected {
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

fn block_memory<const A: usize, const D: usize>(name: &str, address_bits: usize, stored_bits: usize) {
    for name in both_forms(name) {
        let mut reference = memory_reference(address_bits, stored_bits);
        let mut delay = Delay::new(BlockMemory::<A, D>::LATENCY);
        Cosimulation {
            name: &name,
            rust: BlockMemory::<A, D>::new(address_bits, stored_bits),
            inputs: &MEMORY_PORTS,
            outputs: &["read_data"],
        }
        .run(memory_stimuli(A, D, address_bits), |values| vec![delay.pass(reference(values)).flatten()]);
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
    // Words of 18 bits are in the tests above; a word of these takes more than one block RAM, the last in part.
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
    assert_eq!(memory.get("read_data"), 0x555);
    edge(&mut memory, &[]);
    assert_eq!(memory.get("read_data"), 0xfff);
}

fn paced_memory<const A: usize, const D: usize>(name: &str, address_bits: usize, stored_bits: usize) {
    let mut numbers = Numbers::new(8);
    let mut stimuli = memory_stimuli(A, D, address_bits);
    for (cycle, values) in stimuli.iter_mut().enumerate() {
        // Reads at every edge, at most edges, at few.
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
        Cosimulation {
            name: &name,
            rust: PacedMemory::<A, D>::new(address_bits, stored_bits),
            inputs: &["write_address", "write_data", "write_enable", "read_address", "read_enable"],
            outputs: &["read_data"],
        }
        .run(stimuli.clone(), |values| {
            let before = shown;
            let read = reference(values);
            if values[4] == 1 {
                shown = delay.pass(read).flatten();
            }
            vec![before]
        });
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
    assert_eq!(memory.get("read_data"), 0x555);
    edge(&mut memory, &[]);
    assert_eq!(memory.get("read_data"), 0xfff);
}

fn lut_memory<const A: usize, const D: usize>(name: &str, address_bits: usize, stored_bits: usize) {
    let mut reference = memory_reference(address_bits, stored_bits);
    Cosimulation {
        name,
        rust: LutMemory::<A, D>::new(address_bits, stored_bits),
        inputs: &MEMORY_PORTS,
        outputs: &["read_data"],
    }
    .run(memory_stimuli(A, D, address_bits), |values| vec![reference(values)]);
}

#[test]
fn lut_memory_reads_at_once() {
    lut_memory::<4, 8>("lut_memory_4x8", 4, 8);
}

#[test]
fn lut_memory_ignores_what_is_above_its_shape() {
    lut_memory::<6, 40>("lut_memory_5x37", 5, 37);
}

fn banked_memory<const M: usize, const B: usize, const A: usize, const D: usize>(
    name: &str,
    (banks, address_bits, stored_bits): (usize, usize, usize),
) {
    let mut numbers = Numbers::new(9);
    let stimuli: Vec<_> = (0..CYCLES)
        .map(|_| {
            // Banks that are there, and now and then one that is not; one bank is read, or none.
            let bank = numbers.bits(B as u32) % (banks as u64 + 1);
            let read = 1u64 << (numbers.bits(B as u32) % (M as u64 + 1));
            let [write_address, read_address] = [(); 2].map(|()| numbers.bits(A as u32));
            let read_banks = read & ((1 << M) - 1);
            vec![bank, write_address, numbers.bits(D as u32), numbers.bits(1), read_banks, read_address]
        })
        .collect();
    let last = (1u64 << address_bits) - 1;
    let mut words = vec![vec![None; 1 << address_bits]; banks];
    Cosimulation {
        name,
        rust: BankedMemory::<M, B, A, D>::new(banks, address_bits, stored_bits),
        inputs: &["write_bank", "write_address", "write_data", "write_enable", "read_banks", "read_address"],
        outputs: &["read_data"],
    }
    .run(stimuli, |values| {
        let bank = (0..banks).find(|bank| values[4] >> bank & 1 == 1);
        let read = bank.map_or(Some(0), |bank| words[bank][(values[5] & last) as usize]);
        if let Some(bank) = words.get_mut(values[0] as usize).filter(|_| values[3] == 1) {
            bank[(values[1] & last) as usize] = Some(u128::from(values[2] & ((1 << stored_bits) - 1)));
        }
        vec![read]
    });
}

#[test]
fn banked_memory_reads_the_bank_that_is_named() {
    banked_memory::<6, 3, 4, 8>("banked_memory_6x4x8", (6, 4, 8));
}

#[test]
fn banked_memory_ignores_what_is_above_its_shape() {
    banked_memory::<24, 5, 6, 7>("banked_memory_3x2x5", (3, 2, 5));
}

fn lock_memory<const A: usize>(name: &str, address_bits: usize) {
    let mut numbers = Numbers::new(4);
    let last = (1u64 << address_bits) - 1;
    // Few locks, so that they meet often.
    let stimuli: Vec<_> = (0..CYCLES)
        .map(|_| {
            let test = numbers.bits(3) | numbers.bits(A as u32) & !last;
            let mut clear = numbers.bits(3) | numbers.bits(A as u32) & !last;
            if (test ^ clear) & last == 0 {
                clear ^= 1;
            }
            vec![test, numbers.bits(1), clear, numbers.bits(1)]
        })
        .collect();
    for name in both_forms(name) {
        let mut locks = vec![false; 1 << address_bits];
        let mut delay = Delay::new(LockMemory::<A>::LATENCY);
        let rust = LockMemory::<A>::new(address_bits);
        Cosimulation { name: &name, rust, inputs: &LOCK_PORTS, outputs: &["was_set"] }.run(stimuli.clone(), |values| {
            let tested = (values[0] & last) as usize;
            let was_set = delay.pass(locks[tested].into());
            locks[tested] |= values[1] == 1;
            if values[3] == 1 {
                locks[(values[2] & last) as usize] = false;
            }
            vec![was_set]
        });
    }
}

#[test]
fn lock_memory_tests_and_sets() {
    lock_memory::<14>("lock_memory_14", 14);
}

#[test]
fn lock_memory_ignores_high_address_bits() {
    lock_memory::<8>("lock_memory_4", 4);
}

#[test]
#[should_panic(expected = "lock 5 is set and cleared at one clock edge")]
fn lock_memory_refuses_to_set_and_clear_one_lock_at_once() {
    let mut locks = LockMemory::<8>::new(4);
    locks.connect_all();
    let both = [("test_address", 5), ("test_set", 1), ("clear_address", 5), ("clear_enable", 1)];
    edge(&mut locks, &both);
}

fn delay_line<const D: usize>(name: &str, stages: usize) {
    let mut numbers = Numbers::new(5);
    let stimuli: Vec<_> = (0..CYCLES).map(|_| vec![numbers.bits(D as u32)]).collect();
    let mut delay = Delay::new(stages);
    Cosimulation { name, rust: DelayLine::<D>::new(stages), inputs: &["data_in"], outputs: &["data_out"] }
        .run(stimuli, |values| vec![delay.pass(values[0].into())]);
}

#[test]
fn delay_line_of_the_fewest_stages() {
    delay_line::<8>("delay_line_3", DelayLine::<8>::MIN_STAGES);
}

#[test]
fn delay_line_of_nineteen_stages() {
    delay_line::<40>("delay_line_19", 19);
}

#[test]
fn flag_delay_of_one_two_and_nine_stages() {
    for (name, stages) in [("flag_delay_1", 1), ("flag_delay_2", 2), ("flag_delay_9", 9)] {
        let mut numbers = Numbers::new(6);
        let stimuli: Vec<_> = (0..CYCLES).map(|_| vec![numbers.bits(1)]).collect();
        let mut delay = Delay::new(stages);
        Cosimulation { name, rust: FlagDelay::new(stages), inputs: &["flag_in"], outputs: &["flag_out"] }
            .run(stimuli, |values| vec![delay.pass(values[0].into())]);
    }
}

/// Pushes and pops at changing rates, within the contract: never more entries than places, no pop of nothing.
fn fifo_stimuli(data_bits: usize, places: u32) -> Vec<Vec<u64>> {
    let mut numbers = Numbers::new(7);
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

/// Pushes and pops as [`fifo_stimuli`], at any pair of rates, for so long that a deep buffer fills and empties.
fn deep_fifo_stimuli(data_bits: usize, places: u32) -> Vec<Vec<u64>> {
    let mut numbers = Numbers::new(9);
    let (mut held, mut push_pace, mut pop_pace, mut left) = (0, 1, 1, 0);
    (0..4 * CYCLES)
        .map(|cycle| {
            if left == 0 {
                // Short spells end in the middle of a fetch, long ones at either end of the buffer.
                left = 1 + numbers.next() % if numbers.once_in(4) { 10 } else { u64::from(4 * places) };
                // A rate of 0 is silence.
                (push_pace, pop_pace) = (numbers.next() % 5, numbers.next() % 5);
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

/// Runs a buffer against a queue; the stimuli must fill it to its last place and empty it again.
fn queue<U: NamedPorts>(name: &str, rust: U, places: usize, stored_bits: usize, stimuli: Vec<Vec<u64>>) {
    let mut entries = VecDeque::new();
    let mut times_full = 0;
    let mut times_empty = 0;
    Cosimulation { name, rust, inputs: &["reset", "push", "push_data", "pop"], outputs: &["valid", "data"] }.run(
        stimuli,
        |values| {
            if values[1] == 1 {
                entries.push_back(u128::from(values[2]) & ((1 << stored_bits) - 1));
            }
            let shown = vec![Some(u128::from(!entries.is_empty())), entries.front().copied()];
            if values[3] == 1 {
                entries.pop_front();
            }
            if values[0] == 1 {
                entries.clear();
            }
            times_full += usize::from(entries.len() == places);
            times_empty += usize::from(entries.is_empty());
            shown
        },
    );
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
