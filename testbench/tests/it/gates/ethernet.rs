//! Keeps the size of the Ethernet port on an ECP5 in bounds.

use incircle_testbench::gate::{self, Cells};

/// The port with the addresses of a device as constants, as a board has them.
const BOARD: &str = "
module ethernet_board (
    input port_clock, input port_reset, input rx_valid, input rx_error, input [7:0] rx_data,
    output tx_valid, output [7:0] tx_data, input core_clock, input core_reset,
    output entry_valid, output [8:0] entry, input entry_pop, output [1:0] on_the_way,
    input byte_valid, output byte_ready, input [7:0] byte_data, input byte_is_last, input byte_drops
);
ethernet_udp_port port (
    .port_clock(port_clock), .port_reset(port_reset),
    .station({32'h0a0007ff, 16'd26947, 32'h0a000702, 48'h02696e437501}),
    .rx_valid(rx_valid), .rx_error(rx_error), .rx_data(rx_data), .tx_valid(tx_valid), .tx_data(tx_data),
    .core_clock(core_clock), .core_reset(core_reset), .entry_valid(entry_valid), .entry(entry), .entry_pop(entry_pop),
    .on_the_way(on_the_way),
    .byte_valid(byte_valid), .byte_ready(byte_ready), .byte_data(byte_data), .byte_is_last(byte_is_last),
    .byte_drops(byte_drops)
);
endmodule
";

/// Cells of the port by Yosys 0.23.
const MEASURED: Cells =
    Cells { lut4: 1100, carry: 163, distributed_ram: 0, flip_flops: 701, multipliers: 0, block_ram: 4 };

#[test]
fn the_port_of_a_board_is_small() {
    let (_, port) = incircle_blocks::blocks().into_iter().find(|(name, _)| name == "ethernet_udp_port").unwrap();
    let cells = gate::cell_count(&format!("{port}{BOARD}"), "ethernet_board").unwrap();
    println!("Ethernet port on ECP5: {cells:?}");
    cells.check_near(&MEASURED).unwrap();
}
