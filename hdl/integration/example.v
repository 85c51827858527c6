// Triangulates seven points through the AXI4-Stream ports of incircle_stream_top, and prints the triangles. The page
// docs/core-in-your-design.md explains this file and has the two commands that run it.
// SPDX-License-Identifier: MIT OR Apache-2.0
`timescale 1ns / 1ps
module incircle_example;
    localparam POINTS = 7;

    reg bus_clock = 0, core_clock = 0, bus_reset_n = 0;
    always #4 bus_clock = !bus_clock;
    always #5 core_clock = !core_clock;

    reg [63:0] command = 0;
    reg command_valid = 0;
    wire command_ready, answer_valid, answer_last;
    wire [63:0] answer;
    incircle_stream_top device (
        .bus_clock(bus_clock), .bus_reset_n(bus_reset_n), .core_clock(core_clock),
        .s_axis_tdata(command), .s_axis_tkeep(8'hff), .s_axis_tlast(1'b0),
        .s_axis_tvalid(command_valid), .s_axis_tready(command_ready),
        .m_axis_tdata(answer), .m_axis_tkeep(), .m_axis_tlast(answer_last),
        .m_axis_tvalid(answer_valid), .m_axis_tready(1'b1),
        // The registers are not needed, so their port stands still.
        .s_axi_awaddr(12'd0), .s_axi_awprot(3'd0), .s_axi_awvalid(1'b0), .s_axi_awready(),
        .s_axi_wdata(32'd0), .s_axi_wstrb(4'd0), .s_axi_wvalid(1'b0), .s_axi_wready(),
        .s_axi_bresp(), .s_axi_bvalid(), .s_axi_bready(1'b1),
        .s_axi_araddr(12'd0), .s_axi_arprot(3'd0), .s_axi_arvalid(1'b0), .s_axi_arready(),
        .s_axi_rdata(), .s_axi_rresp(), .s_axi_rvalid(), .s_axi_rready(1'b1)
    );

    // Offers a beat of two words until the device takes it. The device works at rising edges, and this bench at falling
    // ones, where all signals are at rest.
    task send(input [31:0] first, input [31:0] second); begin
        command = {second, first};
        command_valid = 1;
        while (!command_ready) @(negedge bus_clock);
        @(negedge bus_clock) command_valid = 0;
    end endtask

    initial begin
        repeat (4) @(negedge bus_clock);
        bus_reset_n = 1;
        @(negedge bus_clock);
        send(32'h02000000, 32'h03000000);                   // Clear, Insert
        send(POINTS, {16'd0, 16'd0});                       // their number; points are {y, x}: (0, 0)
        send({16'd0, 16'd900}, {16'd800, 16'd900});         // (900, 0), (900, 800)
        send({16'd800, 16'd0}, {16'd300, 16'd400});         // (0, 800), (400, 300)
        send({16'd500, 16'd700}, {16'd600, 16'd200});       // (700, 500), (200, 600)
        send(32'h07000000, 0);                              // Triangles, from record 0 on
        send(2 * POINTS - 2, 0);                            // all records, then a word of padding
        // A core of 16,384 records clears them after its reset, a clock each.
        #300000 $display("no answer");
`ifdef VERILATOR
        $stop;
`else
        $finish_and_return(1);
`endif
    end

    // The third answer has the triangles: a beat of header and length, then three ids of 16 bits for each record.
    integer answers = 0, halves = -4, half, record;
    reg [15:0] ids [0:255];
    always @(negedge bus_clock) if (bus_reset_n && answer_valid) begin
        if (answers == 2) for (half = 0; half < 4; half = half + 1) begin
            if (halves + half >= 0) ids[halves + half] = answer[16 * half +: 16];
        end
        if (answers == 2) halves = halves + 4;
        if (answer_last) answers = answers + 1;
        if (answers == 3) begin
            for (record = 0; record < 2 * POINTS - 2; record = record + 1)
                // Records with an id that no point has lie outside the hull: they are ghost triangles.
                if (ids[3 * record] < POINTS && ids[3 * record + 1] < POINTS && ids[3 * record + 2] < POINTS)
                    $display("triangle %0d %0d %0d", ids[3 * record], ids[3 * record + 1], ids[3 * record + 2]);
            $finish;
        end
    end
endmodule
