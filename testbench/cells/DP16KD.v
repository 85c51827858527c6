// Behaviour of the ECP5 block RAM in the modes that incircle uses, for simulation; anything else is an error.
//
// Written from: Lattice, ECP5 and ECP5-5G Memory Usage Guide. The model has two ports of equal width, both on one
// rising clock, with output registers, without reset and chip select. Port B writes without reading (NORMAL). Port A
// does the same, or reads the old word first (READBEFOREWRITE).
//
// The model makes visible what silicon leaves undefined. A read that meets a write of the other port, and the output of
// a port that writes in mode NORMAL, give the complement of the old word.
`default_nettype none
module DP16KD (
    input wire DIA17, DIA16, DIA15, DIA14, DIA13, DIA12, DIA11, DIA10, DIA9, DIA8, DIA7, DIA6, DIA5, DIA4, DIA3, DIA2, DIA1, DIA0,
    input wire ADA13, ADA12, ADA11, ADA10, ADA9, ADA8, ADA7, ADA6, ADA5, ADA4, ADA3, ADA2, ADA1, ADA0,
    input wire CEA, OCEA, CLKA, WEA, RSTA, CSA2, CSA1, CSA0,
    output wire DOA17, DOA16, DOA15, DOA14, DOA13, DOA12, DOA11, DOA10, DOA9, DOA8, DOA7, DOA6, DOA5, DOA4, DOA3, DOA2, DOA1, DOA0,
    input wire DIB17, DIB16, DIB15, DIB14, DIB13, DIB12, DIB11, DIB10, DIB9, DIB8, DIB7, DIB6, DIB5, DIB4, DIB3, DIB2, DIB1, DIB0,
    input wire ADB13, ADB12, ADB11, ADB10, ADB9, ADB8, ADB7, ADB6, ADB5, ADB4, ADB3, ADB2, ADB1, ADB0,
    input wire CEB, OCEB, CLKB, WEB, RSTB, CSB2, CSB1, CSB0,
    output wire DOB17, DOB16, DOB15, DOB14, DOB13, DOB12, DOB11, DOB10, DOB9, DOB8, DOB7, DOB6, DOB5, DOB4, DOB3, DOB2, DOB1, DOB0
);
    // The defaults are those of the primitive, so that a mode that an instance does not state is checked, too.
    parameter DATA_WIDTH_A = 18;
    parameter DATA_WIDTH_B = 18;
    parameter REGMODE_A = "NOREG";
    parameter REGMODE_B = "NOREG";
    parameter RESETMODE = "SYNC";
    parameter CSDECODE_A = "0b000";
    parameter CSDECODE_B = "0b000";
    parameter WRITEMODE_A = "NORMAL";
    parameter WRITEMODE_B = "NORMAL";
    parameter GSR = "ENABLED";

    // Number of address pins below the word. With words of 18 bits the lowest two pins enable bytes.
    localparam LOW = DATA_WIDTH_A == 18 ? 4 : DATA_WIDTH_A == 9 ? 3 : DATA_WIDTH_A == 4 ? 2 : DATA_WIDTH_A == 2 ? 1 : 0;
    localparam WORDS = 1 << (14 - LOW);
    localparam READS_FIRST = WRITEMODE_A == "READBEFOREWRITE";

    generate
        if (DATA_WIDTH_A != DATA_WIDTH_B) $error("DP16KD: ports of unequal width are not modelled");
        if (DATA_WIDTH_A != 18 && DATA_WIDTH_A != 9 && DATA_WIDTH_A != 4 && DATA_WIDTH_A != 2 && DATA_WIDTH_A != 1)
            $error("DP16KD: there is no such width");
        if (REGMODE_A != "OUTREG" || REGMODE_B != "OUTREG") $error("DP16KD: without output registers it is not modelled");
        if (RESETMODE != "SYNC") $error("DP16KD: this RESETMODE is not modelled");
        if (CSDECODE_A != "0b000" || CSDECODE_B != "0b000") $error("DP16KD: this CSDECODE is not modelled");
        if (WRITEMODE_A != "NORMAL" && WRITEMODE_A != "READBEFOREWRITE") $error("DP16KD: this WRITEMODE_A is not modelled");
        if (WRITEMODE_B != "NORMAL") $error("DP16KD: this WRITEMODE_B is not modelled");
        // The sources ask for AUTO. Synthesis replaces it, because nothing here uses a global reset.
        if (GSR != "AUTO" && GSR != "DISABLED") $error("DP16KD: this GSR is not modelled");
    endgenerate

    wire [17:0] taken_a = {DIA17, DIA16, DIA15, DIA14, DIA13, DIA12, DIA11, DIA10, DIA9,
                           DIA8, DIA7, DIA6, DIA5, DIA4, DIA3, DIA2, DIA1, DIA0};
    wire [17:0] taken_b = {DIB17, DIB16, DIB15, DIB14, DIB13, DIB12, DIB11, DIB10, DIB9,
                           DIB8, DIB7, DIB6, DIB5, DIB4, DIB3, DIB2, DIB1, DIB0};
    wire [13:0] pins_a = {ADA13, ADA12, ADA11, ADA10, ADA9, ADA8, ADA7, ADA6, ADA5, ADA4, ADA3, ADA2, ADA1, ADA0};
    wire [13:0] pins_b = {ADB13, ADB12, ADB11, ADB10, ADB9, ADB8, ADB7, ADB6, ADB5, ADB4, ADB3, ADB2, ADB1, ADB0};
    wire [13:0] address_a = pins_a >> LOW;
    wire [13:0] address_b = pins_b >> LOW;

    reg [DATA_WIDTH_A-1:0] memory [0:WORDS-1];
    reg [DATA_WIDTH_A-1:0] array_a, array_b, output_a, output_b;
    wire writes_a = CEA && WEA;
    wire writes_b = CEB && WEB;
    wire meets = address_a == address_b;

    // A bitstream loads zeros where it states no contents.
    integer word;
    initial for (word = 0; word < WORDS; word = word + 1) memory[word] = 0;

    always @(posedge CLKA) begin
        if (RSTA || RSTB || CSA0 || CSA1 || CSA2 || CSB0 || CSB1 || CSB2) begin
            $display("DP16KD: resets and chip selects are not modelled");
            $stop;
        end
        if (OCEA != CEA || OCEB != CEB) begin
            $display("DP16KD: an output register with an enable of its own is not modelled");
            $stop;
        end
        if ((LOW == 4 && writes_a && pins_a[1:0] != 2'b11) || (LOW == 4 && writes_b && pins_b[1:0] != 2'b11)) begin
            $display("DP16KD: writing single bytes is not modelled");
            $stop;
        end
        if (writes_a && writes_b && meets) begin
            $display("DP16KD: both ports write word %0d", address_a);
            $stop;
        end
        if (CEA) begin
            output_a <= array_a;
            array_a <= (writes_b && meets) || (writes_a && !READS_FIRST) ? ~memory[address_a] : memory[address_a];
        end
        if (CEB) begin
            output_b <= array_b;
            array_b <= (writes_a && meets) || writes_b ? ~memory[address_b] : memory[address_b];
        end
        if (writes_a) memory[address_a] <= taken_a[DATA_WIDTH_A-1:0];
        if (writes_b) memory[address_b] <= taken_b[DATA_WIDTH_A-1:0];
    end

    // Both ports stand in one process, so both must have the same clock.
    always @(CLKA or CLKB) if (CLKA != CLKB) begin
        $display("DP16KD: ports on different clocks are not modelled");
        $stop;
    end

    wire [17:0] given_a = 18'b0 | output_a;
    wire [17:0] given_b = 18'b0 | output_b;
    assign {DOA17, DOA16, DOA15, DOA14, DOA13, DOA12, DOA11, DOA10, DOA9,
            DOA8, DOA7, DOA6, DOA5, DOA4, DOA3, DOA2, DOA1, DOA0} = given_a;
    assign {DOB17, DOB16, DOB15, DOB14, DOB13, DOB12, DOB11, DOB10, DOB9,
            DOB8, DOB7, DOB6, DOB5, DOB4, DOB3, DOB2, DOB1, DOB0} = given_b;
endmodule
`default_nettype wire
