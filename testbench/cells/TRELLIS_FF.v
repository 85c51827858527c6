// Behaviour of the ECP5's flip-flop in the modes that incircle uses, for simulation; anything else is an error.
//
// Written from: Lattice, ECP5 and ECP5-5G Family Data Sheet, and FPGA Libraries Reference Guide. The modes are: rising
// clock, data from DI, set or reset with the clock and before the enable, no global reset.
//
// The register holds the difference from the value that configuration gives. So a simulator that starts with zeros
// starts as the device does, and one that starts at random gives the cell a random value.
`default_nettype none
module TRELLIS_FF (input wire CLK, LSR, CE, DI, M, output wire Q);
    // The defaults are those of the cell, so that a mode that an instance does not state is checked, too.
    parameter GSR = "ENABLED";
    parameter CEMUX = "1";
    parameter CLKMUX = "CLK";
    parameter LSRMUX = "LSR";
    parameter SRMODE = "LSR_OVER_CE";
    parameter REGSET = "RESET";
    parameter LSRMODE = "LSR";

    localparam START = REGSET == "SET";

    generate
        if (GSR != "DISABLED") $error("TRELLIS_FF: a global reset is not modelled");
        if (CEMUX != "1" && CEMUX != "CE" && CEMUX != "INV") $error("TRELLIS_FF: this CEMUX is not modelled");
        if (CLKMUX != "CLK") $error("TRELLIS_FF: a falling clock is not modelled");
        if (LSRMUX != "LSR" && LSRMUX != "INV") $error("TRELLIS_FF: this LSRMUX is not modelled");
        if (SRMODE != "LSR_OVER_CE") $error("TRELLIS_FF: this SRMODE is not modelled");
        if (REGSET != "SET" && REGSET != "RESET") $error("TRELLIS_FF: there is no such REGSET");
        if (LSRMODE != "LSR") $error("TRELLIS_FF: this LSRMODE is not modelled");
    endgenerate

    wire enable = CEMUX == "1" || (CEMUX == "INV" ? !CE : CE);
    wire start = LSRMUX == "INV" ? !LSR : LSR;

    reg held;
    always @(posedge CLK) begin
        if (start) held <= 1'b0;
        else if (enable) held <= DI ^ START;
    end
    assign Q = held ^ START;
endmodule
`default_nettype wire
