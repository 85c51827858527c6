// Behaviour of the ECP5's multiplexer behind the two look-up tables of a slice, for simulation.
//
// Written from: Lattice, FPGA Libraries Reference Guide.
`default_nettype none
module PFUMX (input wire ALUT, BLUT, C0, output wire Z);
    assign Z = C0 ? ALUT : BLUT;
endmodule
`default_nettype wire
