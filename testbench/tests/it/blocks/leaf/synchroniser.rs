//! Runs `Synchroniser` in Rust and in Verilog beside plain code: all three must agree at every edge of either clock, at
//! ratios of 1:4 to 4:1 with phases that drift.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, NamedPorts, Stepper};
use incircle_hdl::leaf::Synchroniser;
use incircle_testkit::SplitMix64;
use rust_hdl_core::prelude::*;

named_ports!([] Synchroniser<Bit>, [sent], [received], clock);
named_ports!([] Synchroniser<Bits<10>>, [sent], [received], clock);

fn synchronises<T: Synth>(name: &'static str, bits: u32)
where
    Synchroniser<T>: NamedPorts,
{
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new(name, Synchroniser::<T>::default(), 1);
    let mut before = VecDeque::new();
    for _ in 0..500 {
        let sent = random.below(1 << bits);
        block.set("sent", sent);
        block.settle();
        if before.len() == Synchroniser::<T>::LATENCY {
            block.expect("received", before.pop_front().unwrap_or(sent));
        }
        block.edge();
        before.push_back(sent);
    }
}

#[test]
fn what_is_sent_is_received_two_clocks_later() {
    synchronises::<Bit>("synchroniser_1", 1);
    synchronises::<Bits<10>>("synchroniser_10", 10);
}
