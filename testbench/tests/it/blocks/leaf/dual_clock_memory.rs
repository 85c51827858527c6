//! Runs `DualClockMemory` in Rust and in Verilog beside plain code: all three must agree at every edge of either clock,
//! at ratios of 1:4 to 4:1 with phases that drift.

use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::stream_rig::{rise, Clocks, PERIODS};
use incircle_hdl::leaf::DualClockMemory;
use incircle_testkit::SplitMix64;

named_ports!([const A: usize, const D: usize] DualClockMemory<A, D>,
    [write_clock, write_address, write_data, write_enable, read_clock, read_address, read_enable], [read_data]);

const WRITE_AND_READ: [&str; 2] = ["write_clock", "read_clock"];

fn remembers<const A: usize, const D: usize>(name: &'static str, address_bits: u32, stored_bits: u32) {
    for (seed, periods) in PERIODS.into_iter().enumerate() {
        let mut random = SplitMix64::new(seed as u64);
        let mut clocks = Clocks::new(periods, 3 + seed as u64);
        let memory = DualClockMemory::<A, D>::new(address_bits as usize, stored_bits as usize);
        let mut block = Stepper::new(name, memory, 1);
        let (last, stored) = ((1u64 << address_bits) - 1, (1u64 << stored_bits) - 1);
        let mut words = vec![None; 1 << address_bits];
        let (mut in_array, mut shown) = (None, None);
        for _ in 0..6000 {
            let rises = clocks.next();
            let (to, word) = (random.below(1 << A), random.below(1 << D));
            let (writes, reads) = (random.below(2) == 0, random.below(3) != 0);
            let mut from = random.below(1 << A);
            if (from ^ to) & last == 0 {
                from ^= 1;
            }
            for (port, value) in
                [("write_address", to), ("write_data", word), ("write_enable", writes.into()), ("read_address", from)]
            {
                block.set(port, value);
            }
            block.set("read_enable", reads);
            block.settle();
            if let Some(word) = shown {
                block.expect("read_data", word);
            }
            rise(&mut block, [(WRITE_AND_READ[0], rises[0]), (WRITE_AND_READ[1], rises[1])]);
            if rises[1] && reads {
                shown = in_array;
                in_array = words[(from & last) as usize];
            }
            if rises[0] && writes {
                words[(to & last) as usize] = Some(word & stored);
            }
        }
    }
}

#[test]
fn the_memory_gives_what_another_clock_wrote() {
    remembers::<8, 12>("dual_clock_memory_8x12", 8, 12);
    remembers::<10, 36>("dual_clock_memory_6x33", 6, 33);
}
