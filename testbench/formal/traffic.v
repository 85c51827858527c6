// The promises of the clock counter, whose high half no simulation reaches. tests/it/gates/proofs.rs puts this text
// into the module `stream_register_block$traffic`.
reg has_started = 0, was_reset, was_kept;
reg [63:0] clocks_before;
reg [31:0] high_before;
always @(posedge clock) begin
    has_started <= 1;
    was_reset <= reset;
    was_kept <= reads && index == 10'd32;
    clocks_before <= clocks$q;
    high_before <= kept$q;
end
always @(*) if (has_started) begin
    if (index == 10'd32) assert (value == clocks$q[31:0]);
    if (index == 10'd33) assert (value == kept$q);
    if (was_reset) assert (clocks$q == 0 && kept$q == 0);
    else begin
        assert (clocks$q == clocks_before + 64'd1);
        assert (kept$q == (was_kept ? clocks_before[63:32] : high_before));
    end
end
