// Start of a PHY of gigabit Ethernet, and the reset of the device behind it.
//
// | port | direction | bits | meaning |
// |---|---|---|---|
// | `clock`, `reset` | in | 1 | those of `clock_and_reset` |
// | `phy_clock` | in | 1 | the receive clock of the PHY, which may stand still while the PHY is in reset |
// | `phy_reset_n` | out | 1 | the reset pin of the PHY; low: reset |
// | `device_reset` | out | 1 | the reset of the device; active high |
//
// 1. `phy_reset_n` stays low for 2^WAIT_BITS clocks after `reset`. The boards wait 2^21 clocks, 11.6 ms at 180 MHz and
//    longer at slower clocks, because PHYs ask for 10 ms.
// 2. `device_reset` falls once the PHY has its own reset behind it and at least 8 periods of `phy_clock` have passed
//    since, so that the lamps stay dark while the PHY gives no clock. The device itself would wait for that clock, too.
`default_nettype none
module phy_start #(
    parameter WAIT_BITS = 21
) (
    input wire clock,
    input wire reset,
    input wire phy_clock,
    output wire phy_reset_n,
    output wire device_reset
);
    // Bit WAIT_BITS says that the wait is over.
    reg [WAIT_BITS:0] waited = 0;
    assign phy_reset_n = waited[WAIT_BITS];

    // Bit 3 changes every 8 periods of the clock of the PHY; nothing else depends on where the count begins.
    reg [3:0] periods = 4'd0;
    always @(posedge phy_clock) periods <= periods + 4'd1;

    // The first two bits synchronise bit 3; two changes that they show lie 8 periods apart.
    reg [2:0] seen = 3'b000;
    reg [1:0] changes = 2'd0;
    always @(posedge clock) begin
        seen <= {seen[1:0], periods[3]};
        if (reset) begin
            waited <= 0;
            changes <= 2'd0;
        end else if (!phy_reset_n) begin
            waited <= waited + 1'b1;
        end else if (seen[2] != seen[1] && !changes[1]) begin
            changes <= changes + 2'd1;
        end
    end
    assign device_reset = !changes[1];
endmodule
`default_nettype wire
