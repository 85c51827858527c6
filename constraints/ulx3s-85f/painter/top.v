// The painter on a ULX3S: the pins, the two clocks, and the painter itself. See ../README.md.
//
// The PLL multiplies the oscillator's 25 MHz to 500 MHz and divides that by 4 for the video output, 125 MHz, and by 6
// for everything else, 83.3 MHz.
//
// Written from: Lattice, ECP5 and ECP5-5G sysCLOCK PLL/DLL Design and Usage Guide, and High-Speed I/O Interface.
`default_nettype none
module ulx3s_85f_painter (
    input wire clk_25mhz,
    // Button FIRE1, high while pressed: reset.
    input wire btn_fire1,
    // The digital video connector: blue, green, red, clock. Each is a differential pair, of which the tools place the
    // second pin.
    output wire [3:0] gpdi_dp,
    // Lamps: painting, refused.
    output wire [1:0] led,
    // Held high, or else the ESP32 on the board takes over.
    output wire wifi_gpio0
);
    assign wifi_gpio0 = 1'b1;

    wire video_clock, clock, locked;
    (* ICP_CURRENT = "12" *) (* LPF_RESISTOR = "8" *) (* MFG_ENABLE_FILTEROPAMP = "1" *) (* MFG_GMCREF_SEL = "2" *)
    EHXPLLL #(
        .PLLRST_ENA("DISABLED"), .INTFB_WAKE("DISABLED"), .STDBY_ENABLE("DISABLED"), .DPHASE_SOURCE("DISABLED"),
        .OUTDIVIDER_MUXA("DIVA"), .OUTDIVIDER_MUXB("DIVB"), .OUTDIVIDER_MUXC("DIVC"), .OUTDIVIDER_MUXD("DIVD"),
        .FEEDBK_PATH("CLKOP"), .CLKI_DIV(1), .CLKFB_DIV(5),
        .CLKOP_ENABLE("ENABLED"), .CLKOP_DIV(4), .CLKOP_CPHASE(3), .CLKOP_FPHASE(0),
        .CLKOS_ENABLE("ENABLED"), .CLKOS_DIV(6), .CLKOS_CPHASE(5), .CLKOS_FPHASE(0)
    ) pll (
        .CLKI(clk_25mhz), .CLKFB(video_clock), .CLKOP(video_clock), .CLKOS(clock), .LOCK(locked),
        .RST(1'b0), .STDBY(1'b0), .PHASESEL0(1'b0), .PHASESEL1(1'b0), .PHASEDIR(1'b0), .PHASESTEP(1'b0),
        .PHASELOADREG(1'b0), .PLLWAKESYNC(1'b0), .ENCLKOP(1'b0)
    );

    // The reset ends about 260 clocks after the PLL has locked and the button is released. Both are asynchronous, and
    // pass the two flip-flops `calm`. Configuration sets these registers to 0.
    reg [1:0] calm = 2'b00;
    reg [7:0] waited = 8'd0;
    reg released = 1'b0;
    always @(posedge clock) begin
        calm <= {calm[0], locked && !btn_fire1};
        waited <= !calm[1] ? 8'd0 : waited == 8'hff ? waited : waited + 8'd1;
        released <= calm[1] && waited == 8'hff;
    end

    wire [7:0] lanes;
    painter painter (
        .clock(clock), .reset(!released), .video_clock(video_clock),
        .lanes(lanes), .is_painting(led[0]), .has_failed(led[1])
    );

    // Each lane sends two bits in a clock, the lower one while the clock is high.
    genvar lane;
    generate
        for (lane = 0; lane < 4; lane = lane + 1) begin : outputs
            ODDRX1F pair (
                .SCLK(video_clock), .RST(1'b0), .D0(lanes[2 * lane]), .D1(lanes[2 * lane + 1]), .Q(gpdi_dp[lane])
            );
        end
    endgenerate
endmodule
`default_nettype wire
