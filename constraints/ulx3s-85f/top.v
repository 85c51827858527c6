// incircle on a ULX3S: the pins, the clock, and the device behind its serial link.
//
// `BOARD_PLL` is the list of dividers of the PLL; see ecp5/clock.v.
`default_nettype none
module ulx3s_85f (
    input wire clk_25mhz,
    // The makers name the pins as the USB bridge sees them: the bridge receives on rxd and sends on txd.
    output wire ftdi_rxd,
    input wire ftdi_txd,
    // Button FIRE1, high while pressed: reset.
    input wire btn_fire1,
    // Lamps: alive, busy, error.
    output wire [2:0] led,
    // Held high, or else the ESP32 on the board takes over.
    output wire wifi_gpio0
);
    wire clock;
    wire reset;
    assign wifi_gpio0 = 1'b1;

    clock_and_reset #(`BOARD_PLL) clock_and_reset (
        .board_clock(clk_25mhz),
        .asks_reset(btn_fire1),
        .clock(clock),
        .reset(reset)
    );
    incircle_serial_top device (
        .clock(clock),
        .reset(reset),
        .rx(ftdi_txd),
        .tx(ftdi_rxd),
        .leds(led)
    );
endmodule
`default_nettype wire
