// Shows a picture of 256 by 240 values on a screen of 640 by 480 pixels, 60 times a second, by DVI: a value becomes a
// colour, and fills four pixels. The rest of the screen is black.
//
// | port | direction | bits | meaning |
// |---|---|---|---|
// | `clock` | in | 1 | 125 MHz, five times the rate of the pixels |
// | `changes` | out | 1 | high for a clock after the last line of a screen: the next picture may take over |
// | `show_at` | out | 16 | the place of a value that is needed, `y << 8 \| x` |
// | `show_value` | in | 8 | the value, at most four clocks after its place |
// | `lanes` | out | 8 | two bits of each lane for a clock: bits 1 and 0 blue, 3 and 2 green, 5 and 4 red, 7 and 6 the clock of the pixels. The lower bit goes first |
//
// 1. A pixel lasts five clocks. All registers that belong to pixels change in the last of the five, when `ends_pixel` is
//    high, so each stage here is late by a whole pixel.
// 2. The order of a line is 640 pixels, 16 of porch, 96 of synchronisation, 48 of porch; of a screen, 480 lines, 10, 2
//    and 33. Both synchronisation signals are low when active.
//
// Written from: Digital Visual Interface 1.0, and VESA's timing of 640 by 480 at 60 Hz.
// SPDX-License-Identifier: MIT OR Apache-2.0
`default_nettype none
module video_output (
    input wire clock,
    output reg changes,
    output reg [15:0] show_at,
    input wire [7:0] show_value,
    output wire [7:0] lanes
);
    // Configuration sets the registers that count.
    reg [4:0] part = 5'b00001;
    wire ends_pixel = part[4];
    reg [9:0] x = 10'd0;
    reg [9:0] y = 10'd0;
    always @(posedge clock) begin
        part <= {part[3:0], part[4]};
        changes <= ends_pixel && x == 10'd799 && y == 10'd479;
        if (ends_pixel) begin
            x <= x == 10'd799 ? 10'd0 : x + 10'd1;
            if (x == 10'd799) y <= y == 10'd524 ? 10'd0 : y + 10'd1;
        end
    end

    // Stage 1: the place of the value, and the parts of the screen, as {in the picture, visible, syncs}. The picture
    // begins in column 64.
    wire [9:0] column = x - 10'd64;
    reg [3:0] kind_1 = 4'd0, kind_2 = 4'd0, kind_3 = 4'd0;
    always @(posedge clock) if (ends_pixel) begin
        show_at <= {y[8:1], column[8:1]};
        kind_1 <= {x >= 10'd64 && x < 10'd576, x < 10'd640 && y < 10'd480,
            !(y >= 10'd490 && y < 10'd492), !(x >= 10'd656 && x < 10'd752)};
    end

    // Stage 2: the colour, from blue through cyan, green and yellow to red.
    reg [23:0] colour;
    wire [7:0] up = {show_value[5:0], show_value[5:4]};
    always @(posedge clock) if (ends_pixel) begin
        kind_2 <= kind_1;
        case (show_value[7:6])
            2'd0: colour <= {8'd0, up, 8'd255};
            2'd1: colour <= {8'd0, 8'd255, ~up};
            2'd2: colour <= {up, 8'd255, 8'd0};
            default: colour <= {8'd255, ~up, 8'd0};
        endcase
    end

    // Stage 3: black beside the picture.
    reg [23:0] pixel;
    always @(posedge clock) if (ends_pixel) begin
        kind_3 <= kind_2;
        pixel <= kind_2[3] ? colour : 24'd0;
    end

    wire [9:0] blue, green, red;
    tmds_encoder encoder_of_blue (.clock(clock), .enable(ends_pixel), .is_visible(kind_3[2]), .control(kind_3[1:0]),
        .data(pixel[7:0]), .symbol(blue));
    tmds_encoder encoder_of_green (.clock(clock), .enable(ends_pixel), .is_visible(kind_3[2]), .control(2'b00),
        .data(pixel[15:8]), .symbol(green));
    tmds_encoder encoder_of_red (.clock(clock), .enable(ends_pixel), .is_visible(kind_3[2]), .control(2'b00),
        .data(pixel[23:16]), .symbol(red));

    // The ten bits of a symbol leave in five pairs. The clock of the pixels is a symbol that never changes.
    reg [9:0] left_blue, left_green, left_red, left_clock;
    always @(posedge clock) begin
        left_blue <= ends_pixel ? blue : left_blue >> 2;
        left_green <= ends_pixel ? green : left_green >> 2;
        left_red <= ends_pixel ? red : left_red >> 2;
        left_clock <= ends_pixel ? 10'b0000011111 : left_clock >> 2;
    end
    assign lanes = {left_clock[1:0], left_red[1:0], left_green[1:0], left_blue[1:0]};
endmodule

// Encodes a byte as a symbol of ten bits with few changes and, over time, as many ones as zeros; while nothing is
// visible, two bits of control as one of four symbols. A symbol leaves four enabled clocks after its byte.
//
// Written from: Digital Visual Interface 1.0, section 3.2.
module tmds_encoder (
    input wire clock,
    input wire enable,
    input wire is_visible,
    input wire [1:0] control,
    input wire [7:0] data,
    output reg [9:0] symbol
);
    function [3:0] ones(input [7:0] bits);
        ones = bits[0] + bits[1] + bits[2] + bits[3] + bits[4] + bits[5] + bits[6] + bits[7];
    endfunction

    // Stage 1 counts ones. Stage 2 replaces each bit by its difference from the bit before, or by the opposite if the
    // byte has more ones than zeros. Bit 8 is 1 if the difference was taken.
    reg [2:0] visible = 3'd0;
    reg [1:0] control_1, control_2, control_3;
    reg [7:0] byte_1;
    reg takes_opposite;
    reg [8:0] word_2, word_3;
    wire [3:0] ones_of_data = ones(data);
    wire [7:0] differences = {^byte_1[7:0], ^byte_1[6:0], ^byte_1[5:0], ^byte_1[4:0], ^byte_1[3:0], ^byte_1[2:0],
        ^byte_1[1:0], byte_1[0]};
    // Stage 3 counts how far the ones of the word exceed its zeros, in halves of that number.
    reg signed [3:0] excess;
    always @(posedge clock) if (enable) begin
        visible <= {visible[1:0], is_visible};
        {control_3, control_2, control_1} <= {control_2, control_1, control};
        byte_1 <= data;
        takes_opposite <= ones_of_data > 4'd4 || ones_of_data == 4'd4 && !data[0];
        word_2 <= {!takes_opposite, differences ^ {8{takes_opposite}} & 8'b10101010};
        word_3 <= word_2;
        excess <= $signed(ones(word_2[7:0]) - 4'd4);
    end

    // Stage 4 inverts the word if that brings the sum of all symbols nearer to 0. `tilt` is half of that sum.
    reg signed [4:0] tilt = 5'sd0;
    wire is_even = tilt == 0 || excess == 0;
    wire inverts = is_even ? !word_3[8] : (tilt > 0) == (excess > 0);
    always @(posedge clock) if (enable) begin
        if (visible[2]) begin
            symbol <= {inverts, word_3[8], word_3[7:0] ^ {8{inverts}}};
            // Bits 9 and 8 count as well, unless they differ.
            if (inverts) tilt <= tilt - excess + (word_3[8] ? 5'sd1 : 5'sd0);
            else tilt <= tilt + excess - (word_3[8] ? 5'sd0 : 5'sd1);
        end else begin
            tilt <= 5'sd0;
            case (control_3)
                2'b00: symbol <= 10'b1101010100;
                2'b01: symbol <= 10'b0010101011;
                2'b10: symbol <= 10'b0101010100;
                default: symbol <= 10'b1010101011;
            endcase
        end
    end
endmodule
`default_nettype wire
