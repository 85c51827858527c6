// A device that answers every word w with w + 1, twice, at once or one after the other, and refuses each word in its
// first clock. After the word ffffffff it answers nothing and takes nothing until reset.
module echo(
    input wire clock,
    input wire reset,
    input wire command_valid,
    output wire command_ready,
    input wire [31:0] command_data,
    output wire response_valid,
    input wire response_ready,
    output wire [63:0] response_data,
    output wire response_both
);
    reg deaf;
    reg waited;
    reg [1:0] answers_left;
    reg [31:0] word;

    assign command_ready = waited && command_valid && !deaf && answers_left == 2'd0;
    assign response_valid = answers_left != 2'd0;
    assign response_both = answers_left == 2'd2 && word[0];
    assign response_data = {response_both ? word : 32'd0, word};

    always @(posedge clock) begin
        if (reset) begin
            deaf <= 1'b0;
            waited <= 1'b0;
            answers_left <= 2'd0;
        end else begin
            waited <= command_valid && !command_ready;
            if (command_valid && command_ready) begin
                deaf <= command_data == 32'hffffffff;
                answers_left <= command_data == 32'hffffffff ? 2'd0 : 2'd2;
                word <= command_data + 32'd1;
            end
            if (response_valid && response_ready) answers_left <= response_both ? 2'd0 : answers_left - 2'd1;
        end
    end
endmodule
