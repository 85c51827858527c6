//! Runs `LockMemory` in Rust and in Verilog beside an independent reference: all three must agree in every clock.

use crate::rig::memories::{both_forms, edge};
use crate::rig::stepper::{named_ports, Delay, Stepper};
use incircle_hdl::leaf::LockMemory;
use incircle_testkit::SplitMix64;
use rust_hdl_core::prelude::*;

named_ports!([const A: usize] LockMemory<A>,
    [test_address, test_set, clear_address, clear_enable], [was_set], clock);

const CYCLES: usize = 20_000;

const LOCK_PORTS: [&str; 4] = ["test_address", "test_set", "clear_address", "clear_enable"];

fn lock_memory<const A: usize>(name: &str, address_bits: usize) {
    let mut numbers = SplitMix64::new(4);
    let last = (1u64 << address_bits) - 1;
    // Few locks, so that visits meet often.
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
        Stepper::new(&name, rust, 1).run(&LOCK_PORTS, &["was_set"], stimuli.clone(), |values| {
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
