// incircle on an ECPIX-5: the pins, the clock, and the device behind its serial link.
//
// `BOARD_PLL` is the list of dividers of the PLL; see ecp5/clock.v.
`default_nettype none
module ecpix_5 (
    input wire clk_100mhz,
    output wire uart_tx,
    input wire uart_rx,
    // A low level lights a lamp: LD5 green is alive, LD6 blue is busy, LD7 red is error.
    output wire ld5_g,
    output wire ld6_b,
    output wire ld7_r
);
    wire clock;
    wire reset;
    wire [2:0] leds;
    assign {ld7_r, ld6_b, ld5_g} = ~leds;

    clock_and_reset #(`BOARD_PLL) clock_and_reset (
        .board_clock(clk_100mhz),
        .asks_reset(1'b0),
        .clock(clock),
        .reset(reset)
    );
    incircle_serial_top device (
        .clock(clock),
        .reset(reset),
        .rx(uart_rx),
        .tx(uart_tx),
        .leds(leds)
    );
endmodule
`default_nettype wire
