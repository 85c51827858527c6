// Behaviour of the ECP5's distributed memory of 16 words of 4 bits, for simulation; modes that incircle does not use
// are errors.
//
// Written from: Lattice, ECP5 and ECP5-5G Memory Usage Guide. Writes take the rising clock, reads take none.
`default_nettype none
module TRELLIS_DPR16X4 (
    input wire [3:0] DI, WAD, RAD,
    input wire WRE, WCK,
    output wire [3:0] DO
);
    parameter WCKMUX = "WCK";
    parameter WREMUX = "WRE";
    // Synthesis states no contents: a design writes each word before it relies on it.
    parameter [63:0] INITVAL = 64'h0;

    generate
        if (WCKMUX != "WCK") $error("TRELLIS_DPR16X4: a falling clock is not modelled");
        if (WREMUX != "WRE") $error("TRELLIS_DPR16X4: this WREMUX is not modelled");
    endgenerate

    reg [3:0] memory [0:15];
    always @(posedge WCK) if (WRE) memory[WAD] <= DI;
    assign DO = memory[RAD];
endmodule
`default_nettype wire
