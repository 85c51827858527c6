// The promises of the FIFO between two clocks, and why it keeps them. tests/it/gates/proofs.rs puts this text into the
// FIFO's module and says how many bits a pointer has, P. The memory holds DEPTH entries.
//
// Pointers are taken as numbers, and compared by how far one is behind another, modulo twice DEPTH. The writer is at w.
// The reader's two cells hold older values of w, w1 and w2. The reader is behind those, at r. The writer's two cells
// hold older values of r, r1 and r2.
localparam DEPTH = 1 << (P - 1);
// The number that a Gray code stands for.
function [P-1:0] number(input [P-1:0] code);
    integer place;
    begin
        number[P-1] = code[P-1];
        for (place = P - 2; place >= 0; place = place - 1) number[place] = number[place + 1] ^ code[place];
    end
endfunction
// Reset comes at the start only, and lasts until each side has seen four edges with both in reset.
reg write_began = 0, read_began = 0;
reg [1:0] write_edges = 0, read_edges = 0;
wire both_began = write_began && read_began;
wire is_reset = !(write_edges == 3 && read_edges == 3);
always @(posedge write_clock) begin
    write_began <= 1;
    if (both_began && write_edges != 3) write_edges <= write_edges + 1;
end
always @(posedge read_clock) begin
    read_began <= 1;
    if (both_began && read_edges != 3) read_edges <= read_edges + 1;
end
always @(*) begin
    assume (write_reset == is_reset);
    assume (read_reset == is_reset);
    assume (!pop || valid);
end
// One entry, chosen freely by its number, as it was pushed.
reg [P-1:0] chosen_before;
always @($global_clock) chosen_before <= chosen;
always @(*) assume (chosen == chosen_before);
reg [1:0] entry;
always @(posedge write_clock) if (push && !is_full && write_count$q == chosen) entry <= push_data;
// Number of entries that were popped.
reg [P-1:0] popped = 0;
always @(posedge read_clock) popped <= read_reset ? 0 : popped + pop;

wire [P-1:0] w = write_count$q, r = read_count$q;
wire [P-1:0] w_next = w + 1'd1;
wire [P-1:0] w1 = number(write_seen_first), w2 = number(write_seen$received);
wire [P-1:0] r1 = number(read_seen_first), r2 = number(read_seen$received);
wire [P-1:0] w_w1 = w - w1, w1_w2 = w1 - w2, w2_r = w2 - r;
wire [P-1:0] w_r = w - r, r_r1 = r - r1, r1_r2 = r1 - r2, w_r2 = w - r2;
wire [P-1:0] ahead = chosen - r;
wire [P-1:0] in_array = r - 1, in_output = r - 1 - fetched$q;
always @(*) begin
    // The promises to the user: entries come out as they went in, in their order, and none is lost.
    if (!is_reset) begin
        assert (in_output + 1'd1 - shown$q == popped);
        if (valid && in_output == chosen) assert (data == entry);
        assert (w_r <= DEPTH);
    end
    // The invariants that make the promises inductive.
    if (is_reset) begin
        if (write_began) assert (w == 0 && write_gray$q == 0 && next_gray$q == 1 && full$q);
        if (read_began) assert (r == 0 && read_gray$q == 0 && empty$q && !fetched$q && !shown$q && popped == 0);
        if (!both_began) assert (write_edges == 0 && read_edges == 0);
        if (write_edges >= 1) assert (read_seen_first == 0);
        if (write_edges >= 2) assert (read_seen$received == 0);
        if (read_edges >= 1) assert (write_seen_first == 0);
        if (read_edges >= 2) assert (write_seen$received == 0);
    end else begin
        assert (write_began && read_began);
        assert (number(write_gray$q) == w && number(read_gray$q) == r);
        assert (number(next_gray$q) == w_next);
        assert ({2'b0, w_w1} + w1_w2 + w2_r <= DEPTH);
        assert ({2'b0, w_r} + r_r1 + r1_r2 <= DEPTH);
        if (!full$q) assert (w_r2 != DEPTH);
        if (!empty$q) assert (w2_r != 0);
        if (ahead < w_r) assert (chosen_word == entry);
        if (fetched$q && in_array == chosen) assert (array_word == entry);
    end
end
