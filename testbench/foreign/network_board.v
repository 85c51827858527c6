// A device behind a UDP link with the wires of a board: the clock to the PHY arrives 2 ns late, as RGMII asks.
`timescale 1ns / 1ps
`default_nettype none
module network_board (
    input wire core_clock,
    input wire reset,
    input wire rx_clock,
    input wire rx_ctl,
    input wire [3:0] rxd,
    output wire tx_clock,
    output wire tx_ctl,
    output wire [3:0] txd
);
    wire clock_pin;
    wire [2:0] leds;
    assign #2 tx_clock = clock_pin;
    incircle_udp_top device (
        .core_clock(core_clock),
        .reset(reset),
        .rx_clock(rx_clock),
        .rx_ctl(rx_ctl),
        .rxd(rxd),
        .tx_clock(clock_pin),
        .tx_ctl(tx_ctl),
        .txd(txd),
        .leds(leds)
    );
endmodule
`default_nettype wire
