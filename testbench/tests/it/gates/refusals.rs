//! Shows that the gate lets sound Verilog pass and rejects each kind of fault that rust-hdl is
//! known to emit without a warning.

use incircle_testbench::gate::{self, Cells, GateError};

/// A module with ports `clock`, `a`, `b` (8 bits), `y` (8 bits) around this body.
fn module(body: &str) -> String {
    format!(
        "module block(input wire clock, input wire [7:0] a, input wire [7:0] b, output reg [7:0] y);\n\
         {body}\nendmodule\n"
    )
}

const REGISTERED_SUM: &str = "always @(posedge clock) y <= a + b;";

#[test]
fn sound_verilog_passes() {
    gate::pass(&module(REGISTERED_SUM), "block").unwrap();
    gate::lint_strictly(&module(REGISTERED_SUM), "block").unwrap();
}

#[test]
fn an_undeclared_name_is_rejected_by_both_tools() {
    let verilog =
        module("wire [7:0] sum;\nassign sum = a + b + {7'd0, WIDTH_OF_SUM};\nalways @(posedge clock) y <= sum;");
    let error = gate::lint(&verilog, "block").unwrap_err();
    assert!(error.to_string().contains("WIDTH_OF_SUM"), "{error}");
    let error = gate::synthesise(&verilog, "block").unwrap_err();
    assert!(error.to_string().contains("WIDTH_OF_SUM"), "{error}");
}

#[test]
fn an_undeclared_name_that_yosys_only_mentions_is_rejected() {
    // The net is driven and read, so only its missing declaration gives it away.
    let verilog = module("assign parity = ^a;\nalways @(posedge clock) y <= {7'd0, parity};");
    let error = gate::synthesise(&verilog, "block").unwrap_err();
    assert!(matches!(error, GateError::Complaint { .. }), "{error}");
    assert!(error.to_string().contains("implicitly declared"), "{error}");
}

#[test]
fn a_latch_is_rejected_by_both_tools() {
    let verilog = module("always @(*) if (clock) y = a & b;");
    let error = gate::lint(&verilog, "block").unwrap_err();
    assert!(error.to_string().contains("LATCH"), "{error}");
    let error = gate::synthesise(&verilog, "block").unwrap_err();
    assert!(matches!(error, GateError::Complaint { .. }), "{error}");
    assert!(error.to_string().contains("Latch inferred"), "{error}");
}

#[test]
fn a_width_mismatch_is_rejected_by_the_strict_lint_and_is_the_known_hole_of_the_other() {
    let verilog = module("wire [3:0] low;\nassign low = a + b;\nalways @(posedge clock) y <= {low, low};");
    let error = gate::lint_strictly(&verilog, "block").unwrap_err();
    assert!(error.to_string().contains("WIDTH"), "{error}");
    gate::lint(&verilog, "block").unwrap();
}

#[test]
fn an_unused_signal_is_rejected() {
    let verilog = module("wire [7:0] lost;\nassign lost = a;\nalways @(posedge clock) y <= a + b;");
    let error = gate::lint(&verilog, "block").unwrap_err();
    assert!(error.to_string().contains("UNUSED"), "{error}");
}

#[test]
fn an_unused_part_of_a_bundle_is_not_a_fault() {
    let verilog = module("wire [7:0] sum;\nassign sum = a + b;\nalways @(posedge clock) y <= {sum[6:0], 1'b0};");
    gate::lint(&verilog, "block").unwrap();
    let error = gate::lint_strictly(&verilog, "block").unwrap_err();
    assert!(error.to_string().contains("UNUSED"), "{error}");
}

#[test]
fn an_input_left_open_is_rejected() {
    let verilog = "module child(input wire a, output wire b);\nassign b = a;\nendmodule\n\
        module block(output wire y);\nchild child(.a(), .b(y));\nendmodule\n";
    let error = gate::lint(verilog, "block").unwrap_err();
    assert!(error.to_string().contains("PINCONNECTEMPTY"), "{error}");
}

#[test]
fn an_undriven_net_and_a_loop_are_rejected_by_synthesis() {
    let undriven = module("wire [7:0] nothing;\nalways @(posedge clock) y <= a + nothing;");
    let error = gate::synthesise(&undriven, "block").unwrap_err();
    assert!(error.to_string().contains("nothing"), "{error}");
    let circle = module("wire [7:0] x;\nassign x = x ^ a;\nalways @(posedge clock) y <= x & b;");
    gate::synthesise(&circle, "block").unwrap_err();
}

#[test]
fn a_missing_module_and_a_syntax_error_are_rejected() {
    let verilog = module("missing child(.a(a));\nalways @(posedge clock) y <= a + b;");
    gate::lint(&verilog, "block").unwrap_err();
    gate::synthesise(&verilog, "block").unwrap_err();
    gate::synthesise("module block(;", "block").unwrap_err();
}

#[test]
fn cells_are_counted() {
    let verilog = "module block(input wire clock, input wire signed [17:0] a, input wire signed [17:0] b,
        output reg signed [35:0] y, output reg f);
        always @(posedge clock) begin y <= a * b; f <= a[0] & b[0]; end
        endmodule";
    let cells = gate::cell_count(verilog, "block").unwrap();
    let expected = Cells { lut4: 1, flip_flops: 37, multipliers: 1, ..Cells::default() };
    assert_eq!(cells, expected);
}
