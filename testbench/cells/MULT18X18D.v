// Behaviour of the ECP5 multiplier in the mode that incircle uses, for simulation; anything else is an error.
//
// Written from: Lattice, ECP5 and ECP5-5G sysDSP Usage Guide. The mode is signed, 18 x 18 bits, with all three register
// ranks on clock 0, without reset, with clock enables high and factors from the general inputs.
`default_nettype none
module MULT18X18D (
    input wire A17, A16, A15, A14, A13, A12, A11, A10, A9, A8, A7, A6, A5, A4, A3, A2, A1, A0,
    input wire B17, B16, B15, B14, B13, B12, B11, B10, B9, B8, B7, B6, B5, B4, B3, B2, B1, B0,
    input wire SIGNEDA, SIGNEDB, SOURCEA, SOURCEB,
    input wire CLK3, CLK2, CLK1, CLK0, CE3, CE2, CE1, CE0, RST3, RST2, RST1, RST0,
    output wire P35, P34, P33, P32, P31, P30, P29, P28, P27, P26, P25, P24, P23, P22, P21, P20, P19, P18,
                P17, P16, P15, P14, P13, P12, P11, P10, P9, P8, P7, P6, P5, P4, P3, P2, P1, P0
);
    // The defaults are those of the primitive, so that a mode that an instance does not state is checked, too.
    parameter REG_INPUTA_CLK = "NONE";
    parameter REG_INPUTB_CLK = "NONE";
    parameter REG_INPUTC_CLK = "NONE";
    parameter REG_PIPELINE_CLK = "NONE";
    parameter REG_OUTPUT_CLK = "NONE";

    generate
        if (REG_INPUTA_CLK != "CLK0" || REG_INPUTB_CLK != "CLK0" || REG_PIPELINE_CLK != "CLK0" || REG_OUTPUT_CLK != "CLK0")
            $error("MULT18X18D: all register ranks are on clock 0 here");
        if (REG_INPUTC_CLK != "NONE") $error("MULT18X18D: input C is not modelled");
    endgenerate

    reg signed [17:0] factor_a, factor_b;
    reg signed [35:0] pipeline, product;
    always @(posedge CLK0) begin
        if (CLK1 || CLK2 || CLK3 || !CE0 || !CE1 || !CE2 || !CE3 || RST0 || RST1 || RST2 || RST3) begin
            $display("MULT18X18D: other clocks, enables and resets are not modelled");
            $stop;
        end
        if (!SIGNEDA || !SIGNEDB || SOURCEA || SOURCEB) begin
            $display("MULT18X18D: unsigned factors and shifted inputs are not modelled");
            $stop;
        end
        factor_a <= {A17, A16, A15, A14, A13, A12, A11, A10, A9, A8, A7, A6, A5, A4, A3, A2, A1, A0};
        factor_b <= {B17, B16, B15, B14, B13, B12, B11, B10, B9, B8, B7, B6, B5, B4, B3, B2, B1, B0};
        pipeline <= factor_a * factor_b;
        product <= pipeline;
    end
    assign {P35, P34, P33, P32, P31, P30, P29, P28, P27, P26, P25, P24, P23, P22, P21, P20, P19, P18,
            P17, P16, P15, P14, P13, P12, P11, P10, P9, P8, P7, P6, P5, P4, P3, P2, P1, P0} = product;
endmodule
`default_nettype wire
