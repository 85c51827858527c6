//! Holds the inputs of the root module in registers of their own.
//!
//! Verilator evaluates all logic that depends on an input at every evaluation, whether the input has changed or not:
//! twice a clock, for a third of the work. Behind registers the inputs cost nothing until the port [`APPLY`] changes.
//! The run side changes it after an input was set, and before the next edge of the clock.

/// Name of the port that passes the inputs on. The run side drives it.
const APPLY: &str = "inputs$apply";
/// What stands between these two is not in waveforms.
const HIDDEN: &str = "/*verilator tracing_off*/";
const SHOWN: &str = "/*verilator tracing_on*/";

/// The text with the inputs of module `top` held, all but `clock`. `None` if the module has no input `clock`, or does
/// not declare each of its ports on a line of its own, as `input wire [31:0] name,`.
pub(super) fn held(verilog: &str, top: &str) -> Option<String> {
    let head = format!("module {top} (\n");
    let (before, module) = verilog.split_once(&head)?;
    let (ports, rest) = module.split_once(");\n")?;
    let (body, after) = rest.split_once("endmodule")?;
    let mut inputs = Vec::new();
    let mut has_clock = false;
    for line in ports.lines().map(|line| line.trim().trim_end_matches(',')).filter(|line| !line.is_empty()) {
        match line.strip_prefix("input wire ") {
            Some("clock") => has_clock = true,
            Some(input) => inputs.push(input),
            None if line.starts_with("output ") => {}
            None => return None,
        }
    }
    if !has_clock {
        return None;
    }
    let mut registers = String::new();
    let mut loads = String::new();
    let mut body = body.to_owned();
    for input in inputs {
        let name = input.split_whitespace().last()?;
        registers += &format!("    reg {};\n", input.replace(name, &format!("held_{name}")));
        loads += &format!("        held_{name} <= {name};\n");
        body = body.replace(&format!("({name})"), &format!("(held_{name})"));
    }
    // Waveforms show the inputs once, under the names of the ports.
    Some(format!(
        "{before}{head}    {HIDDEN} input wire {APPLY}, {SHOWN}\n{ports});\n    {HIDDEN}\n{registers}    {SHOWN}\n    \
         always @(posedge {APPLY} or negedge {APPLY}) begin\n{loads}    \
         end\n{body}endmodule{after}"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_inputs_but_the_clock_are_held() {
        let text = "module top (\n    input wire clock,\n    input wire [7:0] a,\n    output wire b\n);\n    \
                    inner inner (.clock(clock), .a(a), .b(b));\nendmodule\n";
        let held = held(text, "top").unwrap();
        assert!(held.contains("    reg [7:0] held_a;\n"), "{held}");
        assert!(held.contains("        held_a <= a;\n"), "{held}");
        assert!(held.contains("inner inner (.clock(clock), .a(held_a), .b(b));"), "{held}");
    }

    #[test]
    fn modules_of_another_form_are_refused() {
        assert_eq!(held("module top (\n    input wire a\n);\nendmodule\n", "top"), None, "no clock");
        assert_eq!(held("module top(clock);\n    input wire clock;\nendmodule\n", "top"), None, "no list of ports");
        assert_eq!(held("module top (\n    inout wire clock\n);\nendmodule\n", "top"), None, "an inout");
    }
}
