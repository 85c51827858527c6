// Asks the core for the mesh of POINTS points, and gives its triangles one after another. This block is what a design
// needs that speaks to `incircle_core` without a host.
//
// | port | direction | bits | meaning |
// |---|---|---|---|
// | `clock`, `reset` | in | 1 | those of the core; `reset` is synchronous and active high |
// | `begins` | in | 1 | high for a clock: the points are about to come, triangulate them |
// | `point_valid`, `point_ready`, `point_data` | in, out, in | 1, 1, 32 | the points, `y << 16 \| x` |
// | `command_*`, `response_*` | | | the ports of `incircle_core` |
// | `triangle_valid`, `triangle_ready`, `triangle_ids` | out, in, out | 1, 1, 3 ID_BITS | three ids, counter-clockwise, the first in the lowest bits |
// | `ends` | out | 1 | high for a clock: the last triangle was taken |
// | `has_failed` | out | 1 | from the first answer on that has a status other than `Ok`, until `reset` |
//
// POINTS is at least 3 and at most the number of points that the core holds, and ID_BITS the number of bits of the
// largest id, POINTS - 1.
//
// 1. A mesh is three commands: `Clear`, `Insert` with the points, `Triangles`. The core answers each before it takes
//    the next, so nothing has to be stored here.
// 2. The answer to `Insert` says how many records the mesh has. Points at the same place count once, so this number is
//    not known before.
// 3. Each record has three ids of 16 bits. A record with an id that no point has lies outside the hull: it is a
//    ghost triangle, and is left out.
// 4. A refused command has no records, so its mesh has no triangles, and the next mesh begins with a `Clear`.
// SPDX-License-Identifier: MIT OR Apache-2.0
`default_nettype none
module mesh_reader #(
    parameter [15:0] POINTS = 16'd128,
    parameter ID_BITS = 7
) (
    input wire clock,
    input wire reset,
    input wire begins,
    input wire point_valid,
    output wire point_ready,
    input wire [31:0] point_data,
    output wire command_valid,
    input wire command_ready,
    output reg [31:0] command_data,
    input wire response_valid,
    output wire response_ready,
    input wire [63:0] response_data,
    input wire response_both,
    input wire response_last,
    output reg triangle_valid,
    input wire triangle_ready,
    output reg [3 * ID_BITS - 1:0] triangle_ids,
    output wire ends,
    output reg has_failed
);
    // What is sent: the states in the order of the words.
    localparam REST = 3'd0, CLEAR = 3'd1, INSERT = 3'd2, COUNT = 3'd3, SEND_POINTS = 3'd4, TRIANGLES = 3'd5,
        FIRST = 3'd6, RECORDS = 3'd7;
    reg [2:0] sends;
    localparam [15:0] LAST = POINTS - 16'd1;
    localparam [ID_BITS - 1:0] ONE = 1, NONE = 0;
    reg [ID_BITS - 1:0] points;
    reg [15:0] records;
    // The answers that have come to an end: none, that to Clear, those to Clear and Insert.
    reg [1:0] answers;

    wire knows_records = answers == 2'd2;
    assign command_valid = sends == SEND_POINTS ? point_valid : sends == TRIANGLES ? knows_records : sends != REST;
    assign point_ready = sends == SEND_POINTS && command_ready;
    always @* case (sends)
        CLEAR: command_data = 32'h02000000;
        INSERT: command_data = 32'h03000000;
        COUNT: command_data = {16'd0, POINTS};
        SEND_POINTS: command_data = point_data;
        TRIANGLES: command_data = 32'h07000000;
        FIRST: command_data = 32'd0;
        default: command_data = {16'd0, records};
    endcase
    wire is_sent = command_valid && command_ready;
    always @(posedge clock) begin
        if (begins) sends <= CLEAR;
        // Behind RECORDS, which is 7, comes REST, which is 0.
        if (is_sent && (sends != SEND_POINTS || points == LAST[ID_BITS - 1:0])) sends <= sends + 3'd1;
        if (is_sent && sends == SEND_POINTS) points <= points == LAST[ID_BITS - 1:0] ? NONE : points + ONE;
        if (reset) begin
            sends <= REST;
            points <= NONE;
        end
    end

    // Answers come in beats of one or two words. Here they are taken word by word, and the triangles in halves of a word.
    reg is_upper_word;
    reg is_upper_half;
    reg [15:0] place;
    wire [31:0] word = is_upper_word ? response_data[63:32] : response_data[31:0];
    wire [15:0] half = is_upper_half ? word[31:16] : word[15:0];
    wire is_last_word = response_last && (is_upper_word || !response_both);
    // Behind the two words of the head, the third answer has ids.
    wire is_id = knows_records && place >= 16'd2;
    wire takes_half = response_valid && is_id && !triangle_valid;
    wire takes_word = is_id ? takes_half && is_upper_half : response_valid;
    assign response_ready = takes_word && (is_upper_word || !response_both);

    reg [1:0] corner;
    reg is_outside;
    reg is_last_triangle;
    wire no_such_point = half >= POINTS;
    assign ends = is_last_triangle && !triangle_valid;
    always @(posedge clock) begin
        is_last_triangle <= takes_word && is_last_word && knows_records || is_last_triangle && triangle_valid;
        if (takes_half) begin
            is_upper_half <= !is_upper_half;
            triangle_ids <= {half[ID_BITS - 1:0], triangle_ids[3 * ID_BITS - 1:ID_BITS]};
            corner <= corner == 2'd2 ? 2'd0 : corner + 2'd1;
            is_outside <= corner != 2'd2 && (is_outside || no_such_point);
            triangle_valid <= corner == 2'd2 && !is_outside && !no_such_point;
        end
        if (triangle_valid && triangle_ready) triangle_valid <= 1'b0;
        if (takes_word) begin
            is_upper_word <= response_both && !is_upper_word;
            place <= is_last_word ? 16'd0 : place + 16'd1;
            if (place == 16'd0 && word[23:16] != 8'd0) has_failed <= 1'b1;
            if (place == 16'd6 && answers == 2'd1) records <= word[15:0];
            if (is_last_word) answers <= knows_records ? 2'd0 : answers + 2'd1;
        end
        if (reset) begin
            {is_upper_word, is_upper_half, is_outside, is_last_triangle, triangle_valid, has_failed} <= 6'd0;
            answers <= 2'd0;
            corner <= 2'd0;
            place <= 16'd0;
            records <= 16'd0;
        end
    end
endmodule
`default_nettype wire
