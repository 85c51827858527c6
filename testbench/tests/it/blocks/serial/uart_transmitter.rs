//! Runs `UartTransmitter` in Rust and in Verilog beside plain code: all three must agree.

use super::uart_receiver::clocks_per_bit;
use crate::rig::serial_host::Listener;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::UartTransmitter;
use incircle_protocol::MAX_STEP;
use incircle_testkit::SplitMix64;

named_ports!(UartTransmitter, [reset, step, byte_valid, byte_data], [byte_ready, tx, is_idle], clock);

const TURN: u64 = 1 << 24;

#[test]
fn transmitter_sends_bytes_without_a_gap_or_when_they_come() {
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("serial_uart_transmitter", UartTransmitter::new(), 2);
    block.set("byte_valid", false);
    block.set("byte_data", 0u8);
    block.set("step", MAX_STEP);
    block.set("reset", true);
    block.settle();
    block.edge();
    block.set("reset", false);
    for run in 0..36 {
        let nominal = clocks_per_bit(run, &mut random);
        let step = (TURN as f64 / nominal).round();
        block.set("step", step as u32);
        let mut listener = Listener::new(nominal * [0.98, 1.0, 1.02][run % 3]);
        let said: Vec<u8> = (0..24).map(|_| random.below(256) as u8).collect();
        let is_lazy = run % 2 == 1;
        let (mut next, mut offers) = (0, false);
        let (mut first, mut last) = (None, 0);
        while next < said.len() || !block.is("is_idle") {
            offers = next < said.len() && (offers || !is_lazy || random.below(300) == 0);
            block.set("byte_valid", offers);
            block.set("byte_data", if offers { said[next] } else { 0xff });
            block.settle();
            listener.clock(block.is("tx"));
            if offers && block.is("byte_ready") {
                (next, offers) = (next + 1, false);
                first.get_or_insert(block.clocks());
            }
            if !block.is("is_idle") {
                last = block.clocks();
            }
            block.edge();
            block.settle();
        }
        assert_eq!((listener.bytes, listener.faults), (said, 0), "{nominal} clocks a bit");
        if !is_lazy {
            let taken = (last - first.expect("a byte")) as f64;
            let bits = 10.0 * 24.0 * TURN as f64 / step;
            assert!((taken - bits).abs() <= 1.0, "{taken} clocks for {bits}");
        }
    }
}
