// incircle on a Colorlight i5 in its extension board: the pins, the clock, and the device behind its serial link.
//
// `BOARD_PLL` is the list of dividers of the PLL; see ecp5/clock.v.
`default_nettype none
module colorlight_i5 (
    input wire clk_25mhz,
    output wire uart_tx,
    input wire uart_rx,
    // The only lamp of the module, which a low level lights: alive.
    output wire led_n,
    // Two pins of the PMOD connector P3: busy and error.
    output wire [1:0] pmod
);
    wire clock;
    wire reset;
    wire [2:0] leds;
    assign led_n = !leds[0];
    assign pmod = leds[2:1];

    clock_and_reset #(`BOARD_PLL) clock_and_reset (
        .board_clock(clk_25mhz),
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
