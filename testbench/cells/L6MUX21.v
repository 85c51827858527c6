// Behaviour of the ECP5's multiplexer behind two slices, for simulation.
//
// Written from: Lattice, FPGA Libraries Reference Guide.
`default_nettype none
module L6MUX21 (input wire D0, D1, SD, output wire Z);
    assign Z = SD ? D1 : D0;
endmodule
`default_nettype wire
