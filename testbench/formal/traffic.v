// What the clocks of the counters promise, though no simulation gets to their high half: put into `stream_register_block$traffic` by
// tests/blocks_stream_proof.rs.
reg has_started = 0, was_reset, was_kept;
reg [63:0] clocks_before;
reg [31:0] high_before;
always @(posedge clock) begin
    has_started <= 1;
    was_reset <= reset;
    was_kept <= keeps;
    clocks_before <= clocks$q;
    high_before <= clocks_high;
end
always @(*) if (has_started) begin
    assert (clocks_low == clocks$q[31:0]);
    if (was_reset) assert (clocks$q == 0 && clocks_high == 0);
    else begin
        assert (clocks$q == clocks_before + 64'd1);
        assert (clocks_high == (was_kept ? clocks_before[63:32] : high_before));
    end
end
