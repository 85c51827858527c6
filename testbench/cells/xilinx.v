// The modules that AMD's tool brings to the Acorn's top, with ports and without behaviour: enough for lint. The bridge
// has the ports that its configuration in constraints/acorn-cle-215/build.tcl gives it.
`default_nettype none
/* verilator lint_off UNUSED */
/* verilator lint_off UNDRIVEN */
module IBUFDS (input wire I, input wire IB, output wire O);
endmodule

module IBUFDS_GTE2 (input wire I, input wire IB, input wire CEB, output wire O, output wire ODIV2);
endmodule

module BUFGCE (input wire I, input wire CE, output wire O);
endmodule

module MMCME2_BASE #(
    parameter real CLKIN1_PERIOD = 0.0,
    parameter real CLKFBOUT_MULT_F = 5.0,
    parameter real CLKOUT0_DIVIDE_F = 1.0
) (
    input wire CLKIN1, input wire CLKFBIN, output wire CLKFBOUT, output wire CLKFBOUTB, output wire CLKOUT0, output wire CLKOUT0B,
    output wire CLKOUT1, output wire CLKOUT1B, output wire CLKOUT2, output wire CLKOUT2B, output wire CLKOUT3, output wire CLKOUT3B,
    output wire CLKOUT4, output wire CLKOUT5, output wire CLKOUT6, output wire LOCKED, input wire PWRDWN, input wire RST
);
endmodule

module xdma_bridge (
    input wire sys_clk, input wire sys_rst_n, output wire user_lnk_up,
    input wire [3:0] pci_exp_rxp, input wire [3:0] pci_exp_rxn, output wire [3:0] pci_exp_txp, output wire [3:0] pci_exp_txn,
    output wire axi_aclk, output wire axi_aresetn,
    input wire [0:0] usr_irq_req, output wire [0:0] usr_irq_ack, output wire msi_enable, output wire [2:0] msi_vector_width,
    output wire [127:0] m_axis_h2c_tdata_0, output wire [15:0] m_axis_h2c_tkeep_0, output wire m_axis_h2c_tlast_0,
    output wire m_axis_h2c_tvalid_0, input wire m_axis_h2c_tready_0,
    input wire [127:0] s_axis_c2h_tdata_0, input wire [15:0] s_axis_c2h_tkeep_0, input wire s_axis_c2h_tlast_0,
    input wire s_axis_c2h_tvalid_0, output wire s_axis_c2h_tready_0,
    output wire [31:0] m_axil_awaddr, output wire [2:0] m_axil_awprot, output wire m_axil_awvalid, input wire m_axil_awready,
    output wire [31:0] m_axil_wdata, output wire [3:0] m_axil_wstrb, output wire m_axil_wvalid, input wire m_axil_wready,
    input wire [1:0] m_axil_bresp, input wire m_axil_bvalid, output wire m_axil_bready,
    output wire [31:0] m_axil_araddr, output wire [2:0] m_axil_arprot, output wire m_axil_arvalid, input wire m_axil_arready,
    input wire [31:0] m_axil_rdata, input wire [1:0] m_axil_rresp, input wire m_axil_rvalid, output wire m_axil_rready
);
endmodule
// Outputs that the top leaves open, in so many words.
/* verilator lint_off PINCONNECTEMPTY */
/* verilator lint_on UNUSED */
/* verilator lint_on UNDRIVEN */
`default_nettype wire
