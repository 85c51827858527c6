// Clock and reset of a board with an ECP5: the PLL, and a reset that waits for its lock.
//
// | port | direction | bits | meaning |
// |---|---|---|---|
// | `board_clock` | in | 1 | the oscillator |
// | `asks_reset` | in | 1 | a button, high while pressed, at any time; 0 if there is none |
// | `clock` | out | 1 | the clock of everything else |
// | `reset` | out | 1 | in that clock; active high |
//
// 1. After configuration `reset` is high. It falls once the PLL has been locked, with the button up, for 255 clocks.
// 2. `reset` rises again two clocks after the lock is lost or the button is pressed.
//
// The phase detector compares CLKOP with the oscillator's frequency divided by INPUT_DIVIDER. The VCO runs at
// LOOP_DIVIDER times that, and `clock` at the VCO's frequency by OUTPUT_DIVIDER. `incircle-hdl board` computes them.
//
// Written from: Lattice, ECP5 and ECP5-5G sysCLOCK PLL/DLL Design and Usage Guide. The four attributes set the loop
// filter as the calculator of Project Trellis does for every frequency.
`default_nettype none
module clock_and_reset #(
    parameter INPUT_DIVIDER = 1,
    parameter LOOP_DIVIDER = 1,
    parameter OUTPUT_DIVIDER = 1
) (
    input wire board_clock,
    input wire asks_reset,
    output wire clock,
    output wire reset
);
    wire feedback;
    wire locked;

    (* ICP_CURRENT = "12" *) (* LPF_RESISTOR = "8" *) (* MFG_ENABLE_FILTEROPAMP = "1" *) (* MFG_GMCREF_SEL = "2" *)
    EHXPLLL #(
        .PLLRST_ENA("DISABLED"),
        .INTFB_WAKE("DISABLED"),
        .STDBY_ENABLE("DISABLED"),
        .DPHASE_SOURCE("DISABLED"),
        .OUTDIVIDER_MUXA("DIVA"),
        .OUTDIVIDER_MUXB("DIVB"),
        .OUTDIVIDER_MUXC("DIVC"),
        .OUTDIVIDER_MUXD("DIVD"),
        .FEEDBK_PATH("CLKOP"),
        .CLKI_DIV(INPUT_DIVIDER),
        .CLKFB_DIV(1),
        .CLKOP_ENABLE("ENABLED"),
        .CLKOP_DIV(LOOP_DIVIDER),
        .CLKOP_CPHASE(LOOP_DIVIDER - 1),
        .CLKOP_FPHASE(0),
        .CLKOS_ENABLE("ENABLED"),
        .CLKOS_DIV(OUTPUT_DIVIDER),
        .CLKOS_CPHASE(OUTPUT_DIVIDER - 1),
        .CLKOS_FPHASE(0)
    ) pll (
        .CLKI(board_clock),
        .CLKFB(feedback),
        .CLKOP(feedback),
        .CLKOS(clock),
        .LOCK(locked),
        .RST(1'b0),
        .STDBY(1'b0),
        .PHASESEL0(1'b0),
        .PHASESEL1(1'b0),
        .PHASEDIR(1'b0),
        .PHASESTEP(1'b0),
        .PHASELOADREG(1'b0),
        .PLLWAKESYNC(1'b0),
        .ENCLKOP(1'b0)
    );

    // Configuration sets these to 0. The bits of `calm` synchronise the lock and the button, which are asynchronous.
    reg [1:0] calm = 2'b00;
    reg [7:0] waited = 8'd0;
    reg released = 1'b0;
    always @(posedge clock) begin
        calm <= {calm[0], locked && !asks_reset};
        if (!calm[1]) begin
            waited <= 8'd0;
            released <= 1'b0;
        end else if (waited != 8'hff) begin
            waited <= waited + 8'd1;
        end else begin
            released <= 1'b1;
        end
    end
    assign reset = !released;
endmodule
`default_nettype wire
