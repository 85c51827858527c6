//! Flip-flops without their initial values.
//!
//! Each flip-flop of the exported Verilog says `initial q = 0`: so it starts in an FPGA. It overrides the random start of a Verilated model,
//! which then would not notice a block without its reset. So models are built without it; the committed Verilog keeps it.

/// The initial value of a flip-flop, as rust-hdl writes it: the line before the value, and the one after it.
const BEFORE: &str = "initial begin";
const AFTER: &str = "end";

/// The Verilog without the initial values of its flip-flops.
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
