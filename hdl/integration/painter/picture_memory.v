// Two pictures of 256 by 256 values: one is painted while the other is shown.
//
// | port | direction | bits | meaning |
// |---|---|---|---|
// | `paint_clock`, `paint_reset` | in | 1 | the clock of painting; `paint_reset` is synchronous and active high |
// | `may_paint` | out | 1 | the hidden picture may be painted |
// | `is_painted` | in | 1 | high for a clock, only with `may_paint`: the hidden picture is complete |
// | `pixel_valid`, `pixel_at`, `pixel_value` | in | 1, 16, 8 | writes a value of the hidden picture, at `y << 8 \| x` |
// | `show_clock` | in | 1 | the clock of showing |
// | `changes` | in | 1 | high for a clock of `show_clock` in which no value is needed: a complete picture may take over |
// | `show_at` | in | 16 | a place of the shown picture |
// | `show_value` | out | 8 | the value at the place that `show_at` named three clocks before |
//
// 1. The two sides exchange one bit each: the picture that was painted last, and the one that is shown. Each passes two
//    flip-flops of the other clock. All else that crosses lies in the memory, in the half that the writer leaves alone.
// 2. Painting waits until the last picture is shown, so no picture is left out.
// 3. Each of the eight memories has 16,384 values of 8 bits: eight block RAMs of an ECP5 that differ in the bit of the
//    value, so that none needs a multiplexer behind it.
// SPDX-License-Identifier: MIT OR Apache-2.0
`default_nettype none
module picture_memory (
    input wire paint_clock,
    input wire paint_reset,
    output wire may_paint,
    input wire is_painted,
    input wire pixel_valid,
    input wire [15:0] pixel_at,
    input wire [7:0] pixel_value,
    input wire show_clock,
    input wire changes,
    input wire [15:0] show_at,
    output reg [7:0] show_value
);
    // Configuration sets these to 0: both pictures have value 0 everywhere, and picture 0 is shown.
    reg painted = 1'b0;
    reg shown = 1'b0;
    (* ASYNC_REG = "TRUE" *) reg [1:0] painted_there = 2'b00;
    (* ASYNC_REG = "TRUE" *) reg [1:0] shown_there = 2'b00;

    assign may_paint = shown_there[1] == painted;
    always @(posedge paint_clock) begin
        shown_there <= {shown_there[0], shown};
        if (is_painted) painted <= !painted;
        if (paint_reset) painted <= 1'b0;
    end
    always @(posedge show_clock) begin
        painted_there <= {painted_there[0], painted};
        if (changes) shown <= painted_there[1];
    end

    wire [16:0] write_at = {!painted, pixel_at};
    wire [16:0] read_at = {shown, show_at};
    reg [2:0] bank, bank_before;
    wire [7:0] values [0:7];
    genvar number;
    generate
        for (number = 0; number < 8; number = number + 1) begin : banks
            (* ram_style = "block", no_rw_check *) reg [7:0] memory [0:16383];
            reg [7:0] read, value;
            always @(posedge paint_clock)
                if (pixel_valid && write_at[16:14] == number) memory[write_at[13:0]] <= pixel_value;
            always @(posedge show_clock) begin
                read <= memory[read_at[13:0]];
                value <= read;
            end
            assign values[number] = value;
        end
    endgenerate
    always @(posedge show_clock) begin
        bank_before <= read_at[16:14];
        bank <= bank_before;
        show_value <= values[bank];
    end
endmodule
`default_nettype wire
