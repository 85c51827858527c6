// Behaviour of the ECP5's carry cell, two bits of a chain, for simulation.
//
// Written from: Lattice, ECP5 and ECP5-5G Family Data Sheet, and FPGA Libraries Reference Guide. In each bit the table
// says whether the carry passes (output 1) or is made anew. The lower quarter of the table, of A and B alone, gives the
// new carry. INJECT1 cuts the bit off from the carry: its sum is the output of the table.
`default_nettype none
module CCU2C (
    input wire CIN, A0, B0, C0, D0, A1, B1, C1, D1,
    output wire S0, S1, COUT
);
    parameter [15:0] INIT0 = 16'h0000;
    parameter [15:0] INIT1 = 16'h0000;
    parameter INJECT1_0 = "YES";
    parameter INJECT1_1 = "YES";

    localparam CHAINED0 = INJECT1_0 == "NO";
    localparam CHAINED1 = INJECT1_1 == "NO";

    wire passes0 = INIT0[{D0, C0, B0, A0}];
    wire passes1 = INIT1[{D1, C1, B1, A1}];
    wire made0 = CHAINED0 && INIT0[{2'b00, B0, A0}];
    wire made1 = CHAINED1 && INIT1[{2'b00, B1, A1}];
    wire between = passes0 ? CIN : made0;

    assign S0 = passes0 ^ (CHAINED0 && CIN);
    assign S1 = passes1 ^ (CHAINED1 && between);
    assign COUT = passes1 ? between : made1;
endmodule
`default_nettype wire
