// A complete design without a host: points that move, the core, and a picture of the mesh on a screen. The value of a
// pixel is interpolated linearly between the corners of its triangle. docs/core-in-your-design.md explains the design.
//
// | port | direction | bits | meaning |
// |---|---|---|---|
// | `clock`, `reset` | in | 1 | of the points, the core and painting: any clock; `reset` is synchronous, active high, and lasts four clocks or more |
// | `video_clock` | in | 1 | 125 MHz |
// | `lanes` | out | 8 | two bits for each lane of DVI, as in `video_output` |
// | `is_painting` | out | 1 | a picture is under way |
// | `has_failed` | out | 1 | the core has refused a command, which only a fault can cause |
//
//     moving_points -> mesh_reader <-> incircle_core
//           ^              | triangles
//           '---------- triangle_fill -> picture_memory -> video_output
//
// SPDX-License-Identifier: MIT OR Apache-2.0
`default_nettype none
module painter (
    input wire clock,
    input wire reset,
    input wire video_clock,
    output wire [7:0] lanes,
    output reg is_painting,
    output wire has_failed
);
    // A picture begins when there is room for it, and is complete once its last triangle is.
    wire may_paint, ends, is_idle;
    reg has_all_triangles;
    wire begins = may_paint && !is_painting;
    wire is_painted = is_painting && has_all_triangles && is_idle;
    always @(posedge clock) begin
        if (begins) is_painting <= 1'b1;
        if (ends) has_all_triangles <= 1'b1;
        if (is_painted) {is_painting, has_all_triangles} <= 2'b00;
        if (reset) {is_painting, has_all_triangles} <= 2'b00;
    end

    wire point_valid, point_ready;
    wire [31:0] point_data;
    wire [6:0] read_id;
    wire [24:0] read_point;
    moving_points moving_points (
        .clock(clock), .reset(reset), .begins(begins),
        .point_valid(point_valid), .point_ready(point_ready), .point_data(point_data),
        .read_id(read_id), .read_point(read_point)
    );

    wire command_valid, command_ready, response_valid, response_ready, response_both, response_last;
    wire [31:0] command_data;
    wire [63:0] response_data;
    incircle_core core (
        .clock(clock), .reset(reset),
        .command_valid(command_valid), .command_ready(command_ready), .command_data(command_data),
        .response_valid(response_valid), .response_ready(response_ready), .response_data(response_data),
        .response_both(response_both), .response_last(response_last)
    );

    wire triangle_valid, triangle_ready;
    wire [20:0] triangle_ids;
    mesh_reader mesh_reader (
        .clock(clock), .reset(reset), .begins(begins),
        .point_valid(point_valid), .point_ready(point_ready), .point_data(point_data),
        .command_valid(command_valid), .command_ready(command_ready), .command_data(command_data),
        .response_valid(response_valid), .response_ready(response_ready), .response_data(response_data),
        .response_both(response_both), .response_last(response_last),
        .triangle_valid(triangle_valid), .triangle_ready(triangle_ready), .triangle_ids(triangle_ids),
        .ends(ends), .has_failed(has_failed)
    );

    wire pixel_valid;
    wire [15:0] pixel_at;
    wire [7:0] pixel_value;
    triangle_fill triangle_fill (
        .clock(clock), .reset(reset),
        .triangle_valid(triangle_valid), .triangle_ready(triangle_ready), .triangle_ids(triangle_ids),
        .read_id(read_id), .read_point(read_point),
        .pixel_valid(pixel_valid), .pixel_at(pixel_at), .pixel_value(pixel_value), .is_idle(is_idle)
    );

    wire changes;
    wire [15:0] show_at;
    wire [7:0] show_value;
    picture_memory picture_memory (
        .paint_clock(clock), .paint_reset(reset), .may_paint(may_paint), .is_painted(is_painted),
        .pixel_valid(pixel_valid), .pixel_at(pixel_at), .pixel_value(pixel_value),
        .show_clock(video_clock), .changes(changes), .show_at(show_at), .show_value(show_value)
    );
    video_output video_output (
        .clock(video_clock), .changes(changes), .show_at(show_at), .show_value(show_value), .lanes(lanes)
    );
endmodule
`default_nettype wire
