//! Runs `OwnBytes` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::head_bytes::Addresses;
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::ethernet::OwnBytes;
use incircle_testkit::SplitMix64;

named_ports!(OwnBytes, [station, index], [byte_data]);

#[test]
fn bytes_are_those_of_the_addresses_in_their_order_on_the_wire() {
    let mut random = SplitMix64::new(3);
    let mut block = Stepper::new("ethernet_own_bytes", OwnBytes::default(), 1);
    for _ in 0..200 {
        let addresses = Addresses::random(&mut random);
        block.set("station_mac", addresses.packed() & ((1 << 48) - 1));
        block.set("station_address", u32::from_be_bytes(addresses.device.address));
        block.set("station_port", addresses.device.port);
        block.set("station_broadcast", u32::from_be_bytes(addresses.broadcast));
        for (index, byte) in addresses.bytes().into_iter().enumerate() {
            block.set("index", index as u32);
            block.settle();
            block.expect("byte_data", byte);
        }
    }
}

#[test]
fn wave_of_the_last_bytes_of_each_address() {
    let bytes: Vec<u64> = (20..36).collect();
    let packed = |range: std::ops::Range<usize>| bytes[range].iter().fold(0u64, |value, byte| value << 8 | byte);
    let mut block = Stepper::new("ethernet_own_bytes", OwnBytes::default(), 1);
    block.set("station_mac", packed(0..6));
    block.set("station_address", packed(6..10));
    block.set("station_port", packed(10..12));
    block.set("station_broadcast", packed(12..16));
    let mut wave = Wave::default();
    for index in [0u64, 1, 5, 6, 9, 10, 11, 12, 15] {
        block.set("index", index);
        block.settle();
        let byte = Cell::Number(block.get("byte_data"));
        wave.take(&[("index", Cell::Number(index.into())), ("byte_data", byte)]);
    }
    wave.assert_drawn_in("own_bytes");
}
