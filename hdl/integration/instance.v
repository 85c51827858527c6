// A template: copy the instance into your design, and connect the signals that are ports here. The page
// docs/core-in-your-design.md explains the ports and says how to drive them.
// SPDX-License-Identifier: MIT OR Apache-2.0
`default_nettype none
module incircle_instance #(
    parameter W = 64 // bits of a beat: 64 in the Verilog of the repository; `export --width 128` makes the other
) (
    // Clock and reset of all ports below. The reset is synchronous, and needed once.
    input wire bus_clock,
    input wire bus_reset_n,
    // Clock of the core: 1/4 to 4 times the other, at any phase. It may be the same wire.
    input wire core_clock,
    // Commands, AXI4-Stream. Keep all bits of tkeep at 1; tlast means nothing.
    input wire [W-1:0] s_axis_tdata,
    input wire [W/8-1:0] s_axis_tkeep,
    input wire s_axis_tvalid,
    output wire s_axis_tready,
    input wire s_axis_tlast,
    // Answers, AXI4-Stream. The last beat of each answer has tlast.
    output wire [W-1:0] m_axis_tdata,
    output wire [W/8-1:0] m_axis_tkeep,
    output wire m_axis_tvalid,
    input wire m_axis_tready,
    output wire m_axis_tlast,
    // Registers, AXI4-Lite. If you do without them, set their inputs to 0, and bready and rready to 1.
    input wire [11:0] s_axi_awaddr,
    input wire [2:0] s_axi_awprot,
    input wire s_axi_awvalid,
    output wire s_axi_awready,
    input wire [31:0] s_axi_wdata,
    input wire [3:0] s_axi_wstrb,
    input wire s_axi_wvalid,
    output wire s_axi_wready,
    output wire [1:0] s_axi_bresp,
    output wire s_axi_bvalid,
    input wire s_axi_bready,
    input wire [11:0] s_axi_araddr,
    input wire [2:0] s_axi_arprot,
    input wire s_axi_arvalid,
    output wire s_axi_arready,
    output wire [31:0] s_axi_rdata,
    output wire [1:0] s_axi_rresp,
    output wire s_axi_rvalid,
    input wire s_axi_rready
);
    incircle_stream_top incircle (
        .bus_clock(bus_clock),
        .bus_reset_n(bus_reset_n),
        .core_clock(core_clock),
        .s_axis_tdata(s_axis_tdata),
        .s_axis_tkeep(s_axis_tkeep),
        .s_axis_tvalid(s_axis_tvalid),
        .s_axis_tready(s_axis_tready),
        .s_axis_tlast(s_axis_tlast),
        .m_axis_tdata(m_axis_tdata),
        .m_axis_tkeep(m_axis_tkeep),
        .m_axis_tvalid(m_axis_tvalid),
        .m_axis_tready(m_axis_tready),
        .m_axis_tlast(m_axis_tlast),
        .s_axi_awaddr(s_axi_awaddr),
        .s_axi_awprot(s_axi_awprot),
        .s_axi_awvalid(s_axi_awvalid),
        .s_axi_awready(s_axi_awready),
        .s_axi_wdata(s_axi_wdata),
        .s_axi_wstrb(s_axi_wstrb),
        .s_axi_wvalid(s_axi_wvalid),
        .s_axi_wready(s_axi_wready),
        .s_axi_bresp(s_axi_bresp),
        .s_axi_bvalid(s_axi_bvalid),
        .s_axi_bready(s_axi_bready),
        .s_axi_araddr(s_axi_araddr),
        .s_axi_arprot(s_axi_arprot),
        .s_axi_arvalid(s_axi_arvalid),
        .s_axi_arready(s_axi_arready),
        .s_axi_rdata(s_axi_rdata),
        .s_axi_rresp(s_axi_rresp),
        .s_axi_rvalid(s_axi_rvalid),
        .s_axi_rready(s_axi_rready)
    );
endmodule
`default_nettype wire
