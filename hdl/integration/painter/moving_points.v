// The points of the painter: a table of 128 points that move a step for each picture, and the stream that takes them to
// the core. Your design has points of its own here, from a sensor or a camera.
//
// | port | direction | bits | meaning |
// |---|---|---|---|
// | `clock`, `reset` | in | 1 | `reset` is synchronous and active high; after it the points are at their first places |
// | `begins` | in | 1 | high for a clock: move all points, and send them |
// | `point_valid`, `point_ready`, `point_data` | out, in, out | 1, 1, 32 | the points in the order of their ids, `y << 16 \| x` |
// | `read_id` | in | 7 | a point whose place and value are asked for |
// | `read_point` | out | 25 | of the point that `read_id` named two clocks before: value, y, x in bits 24 to 17, 16 to 9, 8 to 0 |
//
// 1. Points 0 to 3 are the corners (0, 0), (256, 0), (256, 240) and (0, 240). They never move, so the mesh always covers
//    the picture, and the first three points span a triangle, as the core asks.
// 2. All others start at random places of the picture, below 256 and below 240, and move by up to two places in x and
//    in y. A point that would leave the picture stays, and turns round.
// 3. Nothing may be read between `begins` and the last point taken.
//
// A point takes four clocks: read, keep, move, send. What a block RAM of an ECP5 gives comes so late in the clock that
// it must be kept in registers before anything is computed from it.
// SPDX-License-Identifier: MIT OR Apache-2.0
`default_nettype none
module moving_points (
    input wire clock,
    input wire reset,
    input wire begins,
    output wire point_valid,
    input wire point_ready,
    output wire [31:0] point_data,
    input wire [6:0] read_id,
    output wire [24:0] read_point
);
    localparam REST = 3'd0, READ = 3'd1, KEEP = 3'd2, MOVE = 3'd3, SEND = 3'd4;

    // Of each point: step in y, step in x, value, y, x.
    reg [30:0] table_of_points [0:127];
    reg [30:0] table_output;
    reg [30:0] was;
    reg [30:0] now;
    reg [2:0] state;
    reg [6:0] id;
    reg is_first_picture;

    always @(posedge clock) table_output <= table_of_points[state == REST ? read_id : id];
    always @(posedge clock) was <= table_output;
    always @(posedge clock) if (state == SEND) table_of_points[id] <= now;
    assign read_point = was[24:0];

    // Marsaglia's xorshift generator of 32 bits, a number for each point.
    reg [31:0] random;
    wire [31:0] random_a = random ^ (random << 13);
    wire [31:0] random_b = random_a ^ (random_a >> 17);
    wire [31:0] random_c = random_b ^ (random_b << 5);

    // The first place of a point. The rows from 240 on are no part of the picture.
    wire is_corner = id[6:2] == 5'd0;
    wire [8:0] first_x = is_corner ? {id[0] ^ id[1], 8'd0} : {1'b0, random[7:0]};
    wire [7:0] first_y = is_corner ? (id[1] ? 8'd240 : 8'd0) : random[15:8] < 8'd240 ? random[15:8] : random[15:8] - 8'd128;
    // Steps of -2, -1, 1 or 2, as the sign and the size less one.
    wire signed [2:0] first_step_x = is_corner ? 3'sd0 : step(random[17:16]);
    wire signed [2:0] first_step_y = is_corner ? 3'sd0 : step(random[19:18]);
    function signed [2:0] step(input [1:0] choice);
        case (choice)
            2'd0: step = 3'sd1;
            2'd1: step = 3'sd2;
            2'd2: step = -3'sd1;
            default: step = -3'sd2;
        endcase
    endfunction

    // The next place of a point that was read. The corners have a step of 0, so they stay.
    wire signed [2:0] step_x = was[27:25];
    wire signed [2:0] step_y = was[30:28];
    wire signed [10:0] next_x = $signed({2'b00, was[8:0]}) + step_x;
    wire signed [10:0] next_y = $signed({3'b000, was[16:9]}) + step_y;
    wire leaves_x = next_x < 0 || next_x > 255;
    wire leaves_y = next_y < 0 || next_y > 239;

    assign point_valid = state == SEND;
    assign point_data = {8'd0, now[16:9], 7'd0, now[8:0]};

    always @(posedge clock) begin
        case (state)
            REST: if (begins) state <= READ;
            READ: state <= KEEP;
            KEEP: state <= MOVE;
            MOVE: begin
                state <= SEND;
                random <= random_c;
                if (is_first_picture)
                    now <= {first_step_y, first_step_x, random[31:24], first_y, first_x};
                else begin
                    now[8:0] <= leaves_x ? was[8:0] : next_x[8:0];
                    now[16:9] <= leaves_y ? was[16:9] : next_y[7:0];
                    now[24:17] <= was[24:17];
                    now[27:25] <= leaves_x ? -step_x : step_x;
                    now[30:28] <= leaves_y ? -step_y : step_y;
                end
            end
            default: if (point_ready) begin
                id <= id + 7'd1;
                state <= id == 7'd127 ? REST : READ;
                if (id == 7'd127) is_first_picture <= 1'b0;
            end
        endcase
        if (reset) begin
            state <= REST;
            id <= 7'd0;
            is_first_picture <= 1'b1;
            random <= 32'h12345678;
        end
    end
endmodule
`default_nettype wire
