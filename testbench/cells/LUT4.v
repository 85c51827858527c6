// Behaviour of the ECP5's look-up table of four inputs, for simulation.
//
// Written from: Lattice, FPGA Libraries Reference Guide. The output is bit {D, C, B, A} of the table.
`default_nettype none
module LUT4 (input wire A, B, C, D, output wire Z);
    parameter [15:0] INIT = 16'h0000;

    assign Z = INIT[{D, C, B, A}];
endmodule
`default_nettype wire
