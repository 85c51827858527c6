// What the AXI4-Lite port promises: put into its module, `stream_register_port`, by tests/blocks_stream_proof.rs.
reg has_started = 0;
always @(posedge clock) has_started <= 1;
always @(*) assume (reset || has_started);

// What came before.
reg was_reset, b_was_offered, r_was_offered, could_write, could_read;
reg [1:0] bresp_before, rresp_before;
reg [31:0] rdata_before;
always @(posedge clock) begin
    was_reset <= reset || !has_started;
    b_was_offered <= s_axi_bvalid && !s_axi_bready;
    r_was_offered <= s_axi_rvalid && !s_axi_rready;
    bresp_before <= s_axi_bresp;
    rresp_before <= s_axi_rresp;
    rdata_before <= s_axi_rdata;
    could_write <= has_address$q && has_data$q && !s_axi_bvalid;
    could_read <= has_read$q && !s_axi_rvalid;
end
// What was asked for, and what must be answered.
reg [2:0] addresses, words, writes_done, write_answers, asked, reads_done, read_answers;
reg [11:0] last_address, last_read;
reg [31:0] last_word, last_value;
reg [3:0] word_bytes;
reg write_was_known, read_was_known;
always @(posedge clock) begin
    if (s_axi_awvalid && s_axi_awready) begin addresses <= addresses + 1; last_address <= s_axi_awaddr; end
    if (s_axi_wvalid && s_axi_wready) begin words <= words + 1; last_word <= s_axi_wdata; word_bytes <= s_axi_wstrb; end
    if (write_enable) begin writes_done <= writes_done + 1; write_was_known <= write_is_known; end
    if (s_axi_bvalid && s_axi_bready) write_answers <= write_answers + 1;
    if (s_axi_arvalid && s_axi_arready) begin asked <= asked + 1; last_read <= s_axi_araddr; end
    if (read_enable) begin reads_done <= reads_done + 1; read_was_known <= read_is_known; last_value <= read_data; end
    if (s_axi_rvalid && s_axi_rready) read_answers <= read_answers + 1;
    if (reset) begin
        addresses <= 0; words <= 0; writes_done <= 0; write_answers <= 0;
        asked <= 0; reads_done <= 0; read_answers <= 0;
    end
end
always @(*) if (has_started) begin
    // What the master relies on.
    if (was_reset) assert (!s_axi_bvalid && !s_axi_rvalid);
    else begin
        if (b_was_offered) assert (s_axi_bvalid && s_axi_bresp == bresp_before);
        if (r_was_offered) assert (s_axi_rvalid && s_axi_rresp == rresp_before && s_axi_rdata == rdata_before);
        // No answer is owed for longer than a clock while its channel is free.
        if (could_write) assert (s_axi_bvalid);
        if (could_read) assert (s_axi_rvalid);
    end
    // One write and one answer for each pair, one read and one answer for each last_address.
    assert (addresses == writes_done + {2'b0, !s_axi_awready} && words == writes_done + {2'b0, !s_axi_wready});
    assert (writes_done == write_answers + {2'b0, s_axi_bvalid});
    assert (asked == reads_done + {2'b0, !s_axi_arready} && reads_done == read_answers + {2'b0, s_axi_rvalid});
    // Of what was asked, and what was found.
    if (write_enable) assert (write_address == last_address && write_data == last_word && write_bytes == word_bytes);
    if (!s_axi_awready) assert (write_address == last_address);
    if (!s_axi_wready) assert (write_data == last_word && write_bytes == word_bytes);
    if (s_axi_bvalid) assert (s_axi_bresp == (write_was_known ? 2'd0 : 2'd2));
    if (!s_axi_arready) assert (read_address == last_read);
    if (s_axi_rvalid) assert (s_axi_rresp == (read_was_known ? 2'd0 : 2'd2) && s_axi_rdata == last_value);
end
