// Paints triangles: each pixel of a triangle gets the value that is interpolated linearly between its three corners,
// exact and rounded down.
//
// | port | direction | bits | meaning |
// |---|---|---|---|
// | `clock`, `reset` | in | 1 | `reset` is synchronous and active high |
// | `triangle_valid`, `triangle_ready`, `triangle_ids` | in, out, in | 1, 1, 21 | three ids of points, counter-clockwise, the first in bits 6 to 0 |
// | `read_id`, `read_point` | out, in | 7, 25 | an id, and two clocks later its point: value, y, x in bits 24 to 17, 16 to 9, 8 to 0 |
// | `pixel_valid`, `pixel_at`, `pixel_value` | out | 1, 16, 8 | a pixel to write, at `y << 8 \| x` |
// | `is_idle` | out | 1 | no triangle is at work, and no pixel is under way |
//
// 1. The sign of orient2d of an edge and a pixel says on which side of the edge the pixel lies. A pixel belongs to the
//    triangle if it lies on the inner side of all three edges.
// 2. A pixel on an edge must belong to one of the two triangles there, never to both or to none. So it counts as if it
//    were moved to the right by a distance that is smaller than every other one, and upwards by one that is smaller
//    still: it then lies beside the edge.
// 3. orient2d of an edge is the weight of the corner opposite. The value is the sum of weights times values divided by
//    the sum of the weights, which is orient2d of the triangle.
// 4. The pixels of the box around the triangle pass in turn, one in a clock. A pixel leaves 13 clocks after it entered.
//    The next triangle is taken when the last pixel has left, so all numbers of a triangle stand still meanwhile.
// SPDX-License-Identifier: MIT OR Apache-2.0
`default_nettype none
module triangle_fill (
    input wire clock,
    input wire reset,
    input wire triangle_valid,
    output wire triangle_ready,
    input wire [20:0] triangle_ids,
    output reg [6:0] read_id,
    input wire [24:0] read_point,
    output wire pixel_valid,
    output wire [15:0] pixel_at,
    output wire [7:0] pixel_value,
    output wire is_idle
);
    // Steps before the first pixel: the three ids are asked for in steps 1 to 3, and their points come in 3 to 5.
    localparam IDLE = 3'd0, FIRST_POINT = 3'd3, LAST_POINT = 3'd5, EDGES = 3'd6, SCAN = 3'd7;
    reg [2:0] step;
    reg [20:0] ids;
    reg [8:0] x0, x1, x2, left, right;
    reg [7:0] y0, y1, y2, low, high;
    reg [7:0] value0, value1, value2;

    wire [8:0] new_x = read_point[8:0];
    wire [7:0] new_y = read_point[16:9];
    always @* case (step)
        3'd1: read_id = ids[6:0];
        3'd2: read_id = ids[13:7];
        default: read_id = ids[20:14];
    endcase

    // The pixel that enters, and whether one does.
    reg [8:0] pixel_x;
    reg [7:0] pixel_y;
    wire enters = step == SCAN;
    wire is_row_end = pixel_x == right - 9'd1;
    wire is_last_pixel = is_row_end && pixel_y == high - 8'd1;

    reg [12:0] under_way;
    assign is_idle = step == IDLE && under_way == 13'd0;
    assign triangle_ready = is_idle;

    always @(posedge clock) begin
        case (step)
            IDLE: if (triangle_valid && triangle_ready) begin
                ids <= triangle_ids;
                step <= 3'd1;
            end
            3'd1, 3'd2: step <= step + 3'd1;
            FIRST_POINT, 3'd4, LAST_POINT: begin
                step <= step + 3'd1;
                {x0, x1, x2} <= {x1, x2, new_x};
                {y0, y1, y2} <= {y1, y2, new_y};
                {value0, value1, value2} <= {value1, value2, read_point[24:17]};
                if (step == FIRST_POINT || new_x < left) left <= new_x;
                if (step == FIRST_POINT || new_x > right) right <= new_x;
                if (step == FIRST_POINT || new_y < low) low <= new_y;
                if (step == FIRST_POINT || new_y > high) high <= new_y;
            end
            EDGES: begin
                step <= SCAN;
                pixel_x <= left;
                pixel_y <= low;
            end
            default: begin
                pixel_x <= is_row_end ? left : pixel_x + 9'd1;
                if (is_row_end) pixel_y <= pixel_y + 8'd1;
                if (is_last_pixel) step <= IDLE;
            end
        endcase
        if (reset) step <= IDLE;
    end

    // Edge k runs from corner k to the next one. Its orient2d with the pixel is the weight of the third corner.
    wire signed [17:0] weight_of_2, weight_of_0, weight_of_1;
    wire [2:0] is_inside;
    edge_side edge_0 (.clock(clock), .from_x(x0), .from_y(y0), .to_x(x1), .to_y(y1), .pixel_x(pixel_x), .pixel_y(pixel_y),
        .weight(weight_of_2), .is_inside(is_inside[0]));
    edge_side edge_1 (.clock(clock), .from_x(x1), .from_y(y1), .to_x(x2), .to_y(y2), .pixel_x(pixel_x), .pixel_y(pixel_y),
        .weight(weight_of_0), .is_inside(is_inside[1]));
    edge_side edge_2 (.clock(clock), .from_x(x2), .from_y(y2), .to_x(x0), .to_y(y0), .pixel_x(pixel_x), .pixel_y(pixel_y),
        .weight(weight_of_1), .is_inside(is_inside[2]));

    // Stages 4 and 5: the products and their sum. Weights of pixels inside are not negative, and all others are dropped.
    reg [23:0] product0, product1, product2;
    reg [23:0] sum;
    reg [15:0] area;
    always @(posedge clock) begin
        product0 <= weight_of_0[15:0] * value0;
        product1 <= weight_of_1[15:0] * value1;
        product2 <= weight_of_2[15:0] * value2;
        sum <= product0 + product1 + product2;
        // All pixels of a triangle give the same sum of weights.
        area <= weight_of_0[15:0] + weight_of_1[15:0] + weight_of_2[15:0];
    end

    // Stages 6 to 13: division, a bit of the quotient in each stage, the highest first. The quotient is at most 255.
    // `rests` has the rest before each stage in 24 bits, and `quotients` the bits so far in 8.
    wire [9 * 24 - 1:0] rests;
    wire [9 * 8 - 1:0] quotients;
    assign rests[23:0] = sum;
    assign quotients[7:0] = 8'd0;
    genvar number;
    generate
        for (number = 0; number < 8; number = number + 1) begin : division
            wire [23:0] shifted_area = {8'd0, area} << (7 - number);
            wire fits = rests[24 * number +: 24] >= shifted_area;
            reg [23:0] rest;
            reg [7:0] quotient;
            always @(posedge clock) begin
                rest <= fits ? rests[24 * number +: 24] - shifted_area : rests[24 * number +: 24];
                quotient <= {quotients[8 * number +: 7], fits};
            end
            assign rests[24 * (number + 1) +: 24] = rest;
            assign quotients[8 * (number + 1) +: 8] = quotient;
        end
    endgenerate

    // The place of each pixel travels beside it, and from stage 4 on so does whether it lies inside.
    reg [13 * 16 - 1:0] at;
    reg [9:0] belongs;
    always @(posedge clock) begin
        at <= {at[12 * 16 - 1:0], pixel_y, pixel_x[7:0]};
        under_way <= {under_way[11:0], enters};
        belongs <= {belongs[8:0], &is_inside};
        if (reset) under_way <= 13'd0;
    end
    assign pixel_valid = under_way[12] && belongs[9];
    assign pixel_at = at[12 * 16 +: 16];
    assign pixel_value = quotients[8 * 8 +: 8];
endmodule

// orient2d of an edge and a pixel, three clocks later, and whether the pixel counts as lying on the inner side. The edge
// must stand still while pixels are under way. All points lie in a box of 256 by 240, so the result is at most 61,440
// in size.
module edge_side (
    input wire clock,
    input wire [8:0] from_x,
    input wire [7:0] from_y,
    input wire [8:0] to_x,
    input wire [7:0] to_y,
    input wire [8:0] pixel_x,
    input wire [7:0] pixel_y,
    output reg signed [17:0] weight,
    output wire is_inside
);
    reg signed [9:0] along_x, offset_x;
    reg signed [8:0] along_y, offset_y;
    reg signed [18:0] product_x, product_y;
    always @(posedge clock) begin
        along_x <= {1'b0, to_x} - {1'b0, from_x};
        along_y <= {1'b0, to_y} - {1'b0, from_y};
        offset_x <= {1'b0, pixel_x} - {1'b0, from_x};
        offset_y <= {1'b0, pixel_y} - {1'b0, from_y};
        product_x <= along_x * offset_y;
        product_y <= along_y * offset_x;
        weight <= product_x - product_y;
    end
    // A pixel on the edge counts as moved to the right, which is inside if the edge goes down. If the edge is level, the
    // pixel counts as moved upwards, which is inside if the edge goes to the right.
    wire on_edge_is_inside = along_y < 0 || along_y == 0 && along_x > 0;
    assign is_inside = weight > 0 || weight == 0 && on_edge_is_inside;
endmodule
`default_nettype wire
