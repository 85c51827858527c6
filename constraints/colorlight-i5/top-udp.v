// incircle on a Colorlight i5: the pins, the clocks, and the device behind the first of the two Ethernet ports.
//
// `BOARD_PLL` is the list of dividers of the PLL, see ecp5/clock.v; `BOARD_PHY_WAIT` is the wait of ecp5/phy_start.v.
`default_nettype none
module colorlight_i5_udp (
    input wire clk_25mhz,
    output wire phy_reset_n,
    // Held low: the PHY keeps the settings that it wakes up with.
    output wire phy_mdc,
    input wire rgmii_rx_clock,
    input wire rgmii_rx_ctl,
    input wire [3:0] rgmii_rxd,
    output wire rgmii_tx_clock,
    output wire rgmii_tx_ctl,
    output wire [3:0] rgmii_txd,
    // The only lamp of the module, which a low level lights: alive.
    output wire led_n,
    // Two pins of the PMOD connector P3: busy and error.
    output wire [1:0] pmod
);
    wire clock;
    wire reset;
    wire device_reset;
    wire [2:0] leds;
    assign led_n = !leds[0];
    assign pmod = leds[2:1];
    assign phy_mdc = 1'b0;

    clock_and_reset #(`BOARD_PLL) clock_and_reset (
        .board_clock(clk_25mhz),
        .asks_reset(1'b0),
        .clock(clock),
        .reset(reset)
    );
    phy_start #(`BOARD_PHY_WAIT) phy_start (
        .clock(clock),
        .reset(reset),
        .phy_clock(rgmii_rx_clock),
        .phy_reset_n(phy_reset_n),
        .device_reset(device_reset)
    );
    incircle_udp_top device (
        .core_clock(clock),
        .reset(device_reset),
        .rx_clock(rgmii_rx_clock),
        .rx_ctl(rgmii_rx_ctl),
        .rxd(rgmii_rxd),
        .tx_clock(rgmii_tx_clock),
        .tx_ctl(rgmii_tx_ctl),
        .txd(rgmii_txd),
        .leds(leds)
    );
endmodule
`default_nettype wire
