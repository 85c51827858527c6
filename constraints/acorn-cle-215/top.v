// incircle on an Acorn CLE-215: the pins, the clock of the core, and the device behind the vendor's PCI Express bridge.
//
// The bridge makes the bus clock, 125 MHz. The core has a clock of its own, so that neither limits the other.
`default_nettype none
module acorn_cle_215 (
    input wire clk200_p,
    input wire clk200_n,
    input wire pcie_clk_p,
    input wire pcie_clk_n,
    input wire pcie_rst_n,
    // Held low, because the card always asks for its reference clock.
    output wire pcie_clkreq_n,
    input wire [3:0] pcie_rx_p,
    input wire [3:0] pcie_rx_n,
    output wire [3:0] pcie_tx_p,
    output wire [3:0] pcie_tx_n,
    // Lamps from bit 0 up: the link is up, the bus clock runs, the core clock runs, always on.
    output wire [3:0] led
);
    assign pcie_clkreq_n = 1'b0;

    // The core's clock: 200 MHz * 5 / 8 = 125 MHz.
    wire clk200;
    wire feedback;
    wire core_clock_raw;
    wire core_clock;
    wire locked;
    IBUFDS oscillator (.I(clk200_p), .IB(clk200_n), .O(clk200));
    MMCME2_BASE #(
        .CLKIN1_PERIOD(5.000),
        .CLKFBOUT_MULT_F(5.000),
        .CLKOUT0_DIVIDE_F(8.000)
    ) clocks (
        .CLKIN1(clk200),
        .CLKFBIN(feedback),
        .CLKFBOUT(feedback),
        .CLKFBOUTB(),
        .CLKOUT0(core_clock_raw),
        .CLKOUT0B(),
        .CLKOUT1(),
        .CLKOUT1B(),
        .CLKOUT2(),
        .CLKOUT2B(),
        .CLKOUT3(),
        .CLKOUT3B(),
        .CLKOUT4(),
        .CLKOUT5(),
        .CLKOUT6(),
        .LOCKED(locked),
        .PWRDWN(1'b0),
        .RST(1'b0)
    );
    // Until the PLL is locked the core has no clock, and a reset waits for one: protocol/STREAM.md, rule 8.
    BUFGCE core_clock_buffer (.I(core_clock_raw), .CE(locked), .O(core_clock));

    // The bridge.
    wire pcie_clk;
    wire link_is_up;
    wire bus_clock;
    wire bus_reset_n;
    wire [127:0] command_data;
    wire [15:0] command_keep;
    wire command_last;
    wire command_valid;
    wire command_ready;
    wire [127:0] answer_data;
    wire [15:0] answer_keep;
    wire answer_last;
    wire answer_valid;
    wire answer_ready;
    wire [31:0] write_address;
    wire [2:0] write_protection;
    wire write_address_valid;
    wire write_address_ready;
    wire [31:0] write_data;
    wire [3:0] write_strobe;
    wire write_valid;
    wire write_ready;
    wire [1:0] write_response;
    wire write_response_valid;
    wire write_response_ready;
    wire [31:0] read_address;
    wire [2:0] read_protection;
    wire read_address_valid;
    wire read_address_ready;
    wire [31:0] read_data;
    wire [1:0] read_response;
    wire read_valid;
    wire read_ready;
    IBUFDS_GTE2 reference (.I(pcie_clk_p), .IB(pcie_clk_n), .CEB(1'b0), .O(pcie_clk), .ODIV2());
    xdma_bridge bridge (
        .sys_clk(pcie_clk),
        .sys_rst_n(pcie_rst_n),
        .user_lnk_up(link_is_up),
        .pci_exp_rxp(pcie_rx_p),
        .pci_exp_rxn(pcie_rx_n),
        .pci_exp_txp(pcie_tx_p),
        .pci_exp_txn(pcie_tx_n),
        .axi_aclk(bus_clock),
        .axi_aresetn(bus_reset_n),
        .usr_irq_req(1'b0),
        .usr_irq_ack(),
        .msi_enable(),
        .msi_vector_width(),
        .m_axis_h2c_tdata_0(command_data),
        .m_axis_h2c_tkeep_0(command_keep),
        .m_axis_h2c_tlast_0(command_last),
        .m_axis_h2c_tvalid_0(command_valid),
        .m_axis_h2c_tready_0(command_ready),
        .s_axis_c2h_tdata_0(answer_data),
        .s_axis_c2h_tkeep_0(answer_keep),
        .s_axis_c2h_tlast_0(answer_last),
        .s_axis_c2h_tvalid_0(answer_valid),
        .s_axis_c2h_tready_0(answer_ready),
        .m_axil_awaddr(write_address),
        .m_axil_awprot(write_protection),
        .m_axil_awvalid(write_address_valid),
        .m_axil_awready(write_address_ready),
        .m_axil_wdata(write_data),
        .m_axil_wstrb(write_strobe),
        .m_axil_wvalid(write_valid),
        .m_axil_wready(write_ready),
        .m_axil_bresp(write_response),
        .m_axil_bvalid(write_response_valid),
        .m_axil_bready(write_response_ready),
        .m_axil_araddr(read_address),
        .m_axil_arprot(read_protection),
        .m_axil_arvalid(read_address_valid),
        .m_axil_arready(read_address_ready),
        .m_axil_rdata(read_data),
        .m_axil_rresp(read_response),
        .m_axil_rvalid(read_valid),
        .m_axil_rready(read_ready)
    );

    incircle_stream_top device (
        .bus_clock(bus_clock),
        .bus_reset_n(bus_reset_n),
        .core_clock(core_clock),
        .s_axis_tdata(command_data),
        .s_axis_tkeep(command_keep),
        .s_axis_tvalid(command_valid),
        .s_axis_tready(command_ready),
        .s_axis_tlast(command_last),
        .m_axis_tdata(answer_data),
        .m_axis_tkeep(answer_keep),
        .m_axis_tvalid(answer_valid),
        .m_axis_tready(answer_ready),
        .m_axis_tlast(answer_last),
        .s_axi_awaddr(write_address[11:0]),
        .s_axi_awprot(write_protection),
        .s_axi_awvalid(write_address_valid),
        .s_axi_awready(write_address_ready),
        .s_axi_wdata(write_data),
        .s_axi_wstrb(write_strobe),
        .s_axi_wvalid(write_valid),
        .s_axi_wready(write_ready),
        .s_axi_bresp(write_response),
        .s_axi_bvalid(write_response_valid),
        .s_axi_bready(write_response_ready),
        .s_axi_araddr(read_address[11:0]),
        .s_axi_arprot(read_protection),
        .s_axi_arvalid(read_address_valid),
        .s_axi_arready(read_address_ready),
        .s_axi_rdata(read_data),
        .s_axi_rresp(read_response),
        .s_axi_rvalid(read_valid),
        .s_axi_rready(read_ready)
    );

    // One lamp blinks for each clock. Configuration sets the counters to 0.
    reg [25:0] bus_beat = 26'd0;
    reg [25:0] core_beat = 26'd0;
    always @(posedge bus_clock) bus_beat <= bus_beat + 26'd1;
    always @(posedge core_clock) core_beat <= core_beat + 26'd1;
    assign led = {1'b1, core_beat[25], bus_beat[25], link_is_up};
endmodule
`default_nettype wire
