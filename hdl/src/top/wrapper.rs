//! The outside of the core: a module with ANSI ports, written by hand.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | one clock; synchronous reset, active high |
//! | `command_valid`, `command_ready`, `command_data` | in, out, in | 1, 1, 32 | the command stream |
//! | `response_valid`, `response_ready`, `response_data` | out, in, out | 1, 1, 32 | the answer stream |
//! | `write_valid`, `write_id`, `write_vertices`, `write_links` | out | 1, 15, 1, 3 | with the probe: the write port of the triangle memory |
//! | `write_v0..2`, `write_n0..2` | out | 15 | with the probe: its data |

/// Name of the module.
pub const CORE_NAME: &str = "incircle_core";

/// The fields of the write port, lowest bit first, with their widths; the order is that of [`Write`](crate::engine::Write).
const PROBE: [(&str, usize); 10] = [
    ("write_valid", 1),
    ("write_id", 15),
    ("write_vertices", 1),
    ("write_links", 3),
    ("write_v0", 15),
    ("write_v1", 15),
    ("write_v2", 15),
    ("write_n0", 15),
    ("write_n1", 15),
    ("write_n2", 15),
];

/// The Verilog of the wrapper around the root module `core`.
pub fn wrapper(core: &str, with_probe: bool) -> String {
    let mut ports = vec![
        "input wire clock".to_string(),
        "input wire reset".into(),
        "input wire command_valid".into(),
        "output wire command_ready".into(),
        "input wire [31:0] command_data".into(),
        "output wire response_valid".into(),
        "input wire response_ready".into(),
        "output wire [31:0] response_data".into(),
    ];
    // Without the probe the port ends in a wire that synthesis removes.
    let bits: usize = PROBE.iter().map(|(_, width)| width).sum();
    let mut declaration = format!("    wire [{}:0] unused_write;\n", bits - 1);
    let mut write = "unused_write".to_string();
    if with_probe {
        let mut fields: Vec<&str> = Vec::new();
        for (name, width) in PROBE {
            let range = if width == 1 { String::new() } else { format!("[{}:0] ", width - 1) };
            ports.push(format!("output wire {range}{name}"));
            fields.insert(0, name);
        }
        write = format!("{{{}}}", fields.join(", "));
        declaration = String::new();
    }
    let ports = ports.join(",\n    ");
    format!(
        "\
`default_nettype none
module {CORE_NAME} (
    {ports}
);
{declaration}    {core} core (
        .clock(clock),
        .reset(reset),
        .command_valid(command_valid),
        .command_ready(command_ready),
        .command_data(command_data),
        .response_valid(response_valid),
        .response_ready(response_ready),
        .response_data(response_data),
        .write({write})
    );
endmodule
`default_nettype wire
"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_probe_is_as_wide_as_the_write_port() {
        let width: usize = PROBE.iter().map(|(_, width)| width).sum();
        assert_eq!(width, <crate::engine::Write as rust_hdl_core::prelude::Synth>::BITS);
    }
}
