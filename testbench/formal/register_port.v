// The promises of the AXI4-Lite port. tests/it/gates/proofs.rs puts this text into its module, `stream_register_port`.
reg has_started = 0;
always @(posedge clock) has_started <= 1;
always @(*) assume (reset || has_started);

// The state one clock earlier.
reg was_reset, b_was_offered, r_was_offered, could_write, could_read;
reg [1:0] bresp_before, rresp_before;
reg [31:0] rdata_before;
always @(posedge clock) begin
    was_reset <= reset || !has_started;
    b_was_offered <= s_axi$bvalid && !s_axi$bready;
    r_was_offered <= s_axi$rvalid && !s_axi$rready;
    bresp_before <= s_axi$bresp;
    rresp_before <= s_axi$rresp;
    rdata_before <= s_axi$rdata;
    could_write <= has_address$q && has_data$q && !s_axi$bvalid;
    could_read <= has_read$q && !s_axi$rvalid;
end
// A count of requests and answers, and the last request of each kind.
reg [2:0] addresses, words, writes_done, write_answers, asked, reads_done, read_answers;
reg [11:0] last_address, last_read;
reg [31:0] last_word, last_value;
reg [3:0] word_bytes;
reg write_was_known, read_was_known;
always @(posedge clock) begin
    if (s_axi$awvalid && s_axi$awready) begin addresses <= addresses + 1; last_address <= s_axi$awaddr; end
    if (s_axi$wvalid && s_axi$wready) begin words <= words + 1; last_word <= s_axi$wdata; word_bytes <= s_axi$wstrb; end
    if (write_enable) begin writes_done <= writes_done + 1; write_was_known <= write_is_known; end
    if (s_axi$bvalid && s_axi$bready) write_answers <= write_answers + 1;
    if (s_axi$arvalid && s_axi$arready) begin asked <= asked + 1; last_read <= s_axi$araddr; end
    if (read_enable) begin reads_done <= reads_done + 1; read_was_known <= read_is_known; last_value <= read_data; end
    if (s_axi$rvalid && s_axi$rready) read_answers <= read_answers + 1;
    if (reset) begin
        addresses <= 0; words <= 0; writes_done <= 0; write_answers <= 0;
        asked <= 0; reads_done <= 0; read_answers <= 0;
    end
end
always @(*) if (has_started) begin
    // The promises to the master: an answer stays as it is until it is taken.
    if (was_reset) assert (!s_axi$bvalid && !s_axi$rvalid);
    else begin
        if (b_was_offered) assert (s_axi$bvalid && s_axi$bresp == bresp_before);
        if (r_was_offered) assert (s_axi$rvalid && s_axi$rresp == rresp_before && s_axi$rdata == rdata_before);
        // No answer is owed for longer than a clock while its channel is free.
        if (could_write) assert (s_axi$bvalid);
        if (could_read) assert (s_axi$rvalid);
    end
    // One write and one answer for each pair, one read and one answer for each address.
    assert (addresses == writes_done + {2'b0, !s_axi$awready} && words == writes_done + {2'b0, !s_axi$wready});
    assert (writes_done == write_answers + {2'b0, s_axi$bvalid});
    assert (asked == reads_done + {2'b0, !s_axi$arready} && reads_done == read_answers + {2'b0, s_axi$rvalid});
    // Each access is that of the last request, and each answer tells what the access found.
    if (write_enable) assert (write_address == last_address && write_data == last_word && write_bytes == word_bytes);
    if (!s_axi$awready) assert (write_address == last_address);
    if (!s_axi$wready) assert (write_data == last_word && write_bytes == word_bytes);
    if (s_axi$bvalid) assert (s_axi$bresp == (write_was_known ? 2'd0 : 2'd2));
    if (!s_axi$arready) assert (read_address == last_read);
    if (s_axi$rvalid) assert (s_axi$rresp == (read_was_known ? 2'd0 : 2'd2) && s_axi$rdata == last_value);
end
