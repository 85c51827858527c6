// Models for the tests of the binding.

// Counts by `step` while `points$valid`; `state` has no reset.
module counter(clock, reset, step, points$valid, count, state);
    input wire clock;
    input wire reset;
    input wire [7:0] step;
    input wire points$valid;
    output reg [39:0] count;
    output reg [15:0] state;
    always @(posedge clock) begin
        if (reset) count <= 40'd0;
        else if (points$valid) count <= count + {32'd0, step};
        if (points$valid) state <= state + 16'd1;
    end
endmodule

// Combinational, wider than a machine word.
module wide_adder(a, b, sum, carry);
    input wire [99:0] a;
    input wire [99:0] b;
    output wire [99:0] sum;
    output wire carry;
    assign {carry, sum} = {1'b0, a} + {1'b0, b};
endmodule

// Built with fast clocks: counts by `step`, and shows what the next count will be.
module fast_counter (
    input wire clock,
    input wire reset,
    input wire [7:0] step,
    output reg [39:0] count,
    output reg [39:0] next
);
    reg [39:0] wide;
    always @(*) begin
        wide = {32'd0, step};
        next = count + wide;
        if (reset) begin
            next = 40'd0;
        end
    end
    always @(posedge clock) count <= next;
endmodule
