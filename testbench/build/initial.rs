//! Takes the initial values of flip-flops out of the exported Verilog.
//!
//! Each flip-flop of the exported Verilog says `initial q = 0`, the value it has when an FPGA starts. In a Verilated
//! model that value would override the random start, and a block that lacks its reset would go unnoticed. Models are
//! therefore built without the initial values; the committed Verilog keeps them.

/// The line before and the line after the initial value of a flip-flop, as rust-hdl writes them.
const BEFORE: &str = "initial begin";
const AFTER: &str = "end";

/// Returns the Verilog without the initial values of its flip-flops.
pub fn without_initial_values(verilog: &str) -> String {
    let mut lines = verilog.lines();
    let mut kept = String::with_capacity(verilog.len());
    while let Some(line) = lines.next() {
        if line.trim() == BEFORE {
            let value = lines.next().unwrap_or_default().trim();
            assert!(value.starts_with("q = ") && value.ends_with(';'), "{value:?} is no initial value of a flip-flop");
            assert_eq!(lines.next().map(str::trim), Some(AFTER), "an initial value of a flip-flop is one statement");
            continue;
        }
        kept.push_str(line);
        kept.push('\n');
    }
    kept
}
