// Behaviour of the ECP5's PLL as incircle's boards use it, for simulation; anything else is an error.
//
// Written from: Lattice, ECP5 and ECP5-5G sysCLOCK PLL/DLL Design and Usage Guide. Feedback comes from CLKOP through
// the fabric, the clock is on CLKOS, and nothing is dynamic. Frequencies are not modelled: CLKOS is CLKI, and LOCK
// rises after 100 clocks of it.
`default_nettype none
module EHXPLLL (
    input wire CLKI, CLKFB, PHASESEL1, PHASESEL0, PHASEDIR, PHASESTEP, PHASELOADREG, STDBY, PLLWAKESYNC, RST,
    input wire ENCLKOP, ENCLKOS, ENCLKOS2, ENCLKOS3,
    output wire CLKOP, CLKOS, CLKOS2, CLKOS3, LOCK, INTLOCK, REFCLK, CLKINTFB
);
    parameter PLLRST_ENA = "DISABLED";
    parameter INTFB_WAKE = "DISABLED";
    parameter STDBY_ENABLE = "DISABLED";
    parameter DPHASE_SOURCE = "DISABLED";
    parameter OUTDIVIDER_MUXA = "DIVA";
    parameter OUTDIVIDER_MUXB = "DIVB";
    parameter OUTDIVIDER_MUXC = "DIVC";
    parameter OUTDIVIDER_MUXD = "DIVD";
    parameter FEEDBK_PATH = "CLKOP";
    parameter CLKI_DIV = 1;
    parameter CLKFB_DIV = 1;
    parameter CLKOP_ENABLE = "ENABLED";
    parameter CLKOP_DIV = 8;
    parameter CLKOP_CPHASE = 0;
    parameter CLKOP_FPHASE = 0;
    parameter CLKOS_ENABLE = "DISABLED";
    parameter CLKOS_DIV = 8;
    parameter CLKOS_CPHASE = 0;
    parameter CLKOS_FPHASE = 0;

    generate
        if (PLLRST_ENA != "DISABLED" || INTFB_WAKE != "DISABLED" || STDBY_ENABLE != "DISABLED" || DPHASE_SOURCE != "DISABLED")
            $error("EHXPLLL: this is not modelled");
        if (FEEDBK_PATH != "CLKOP" || CLKOP_ENABLE != "ENABLED" || CLKOS_ENABLE != "ENABLED")
            $error("EHXPLLL: feedback is from CLKOP, the clock is CLKOS");
        if (CLKI_DIV < 1 || CLKI_DIV > 128 || CLKFB_DIV < 1 || CLKFB_DIV > 80) $error("EHXPLLL: there is no such divider");
        if (CLKOP_DIV < 1 || CLKOP_DIV > 128 || CLKOS_DIV < 1 || CLKOS_DIV > 128) $error("EHXPLLL: there is no such divider");
        if (CLKOP_CPHASE != CLKOP_DIV - 1 || CLKOS_CPHASE != CLKOS_DIV - 1) $error("EHXPLLL: phases are not modelled");
        if (CLKOP_FPHASE != 0 || CLKOS_FPHASE != 0) $error("EHXPLLL: phases are not modelled");
    endgenerate

    reg [6:0] clocks = 7'd0;
    always @(posedge CLKI) begin
        if (clocks != 7'd100) clocks <= clocks + 7'd1;
        if (RST || STDBY || PHASESEL0 || PHASESEL1 || PHASEDIR || PHASESTEP || PHASELOADREG || PLLWAKESYNC || CLKFB != CLKOP) begin
            $display("EHXPLLL: reset, standby, dynamic phases and other feedback are not modelled");
            $stop;
        end
    end
    assign CLKOP = 1'b0;
    assign CLKOS = CLKI;
    assign CLKOS2 = 1'b0;
    assign CLKOS3 = 1'b0;
    assign LOCK = clocks == 7'd100;
    assign INTLOCK = 1'b0;
    assign REFCLK = 1'b0;
    assign CLKINTFB = 1'b0;
endmodule
`default_nettype wire
