//! Proves the FIFO between two clocks, the AXI4-Lite port and the clocks of the counters: for every sequence of
//! inputs, and of edges of two clocks, of any length. Faults are put in as well, and each must be found;
//! otherwise a proof would say nothing.

use incircle_hdl::export;
use incircle_hdl::stream::AsyncFifo;
use incircle_testbench::gate::{self, GateError};
use rust_hdl_core::prelude::*;

const FIFO: &str = "stream_fifo";
const PORT: &str = "stream_register_port";

/// Steps that an induction may take. One is enough for sound designs.
const STEPS: u32 = 4;

/// Replaces text that the Verilog holds exactly once.
fn replace(text: &str, old: &str, new: &str) -> String {
    assert_eq!(text.matches(old).count(), 1, "{old:?} stands in the Verilog once");
    text.replace(old, new)
}

fn block(name: &str) -> String {
    let blocks = incircle_blocks::blocks();
    blocks.into_iter().find(|block| block.0 == name).expect("a block of this name").1
}

/// The block with its properties.
fn with_properties(verilog: &str, name: &str, properties: &str) -> String {
    let end = format!("endmodule // {name}\n");
    replace(verilog, &end, &format!("{properties}{end}"))
}

/// A FIFO with pointers of `P` bits, so of `2^(P - 1)` entries, and its properties. The properties look into the memory
/// and the synchronisers, so these get ports that show their content.
fn fifo<const P: usize>() -> String {
    let mut fifo = AsyncFifo::<P, 2>::new();
    fifo.connect_all();
    let mut text = export::verilog(&fifo, FIFO).expect("a sound FIFO");
    let last = P - 1;
    let below = P - 2;
    let seen = |which: &str| format!("output wire [{last}:0] {which}_first; assign {which}_first = first;");
    for (child, ports, show) in [
        (
            "memory",
            "chosen, chosen_word, array_word",
            format!(
                "input wire [{last}:0] chosen; output wire [1:0] chosen_word, array_word;
                 assign chosen_word = memory[chosen[{below}:0]]; assign array_word = word;"
            ),
        ),
        ("read_seen", "read_seen_first", seen("read_seen")),
        ("write_seen", "write_seen_first", seen("write_seen")),
    ] {
        let module = format!("module {FIFO}${child}(");
        text = replace(&text, &module, &format!("{module}{ports},"));
        let start = text.find(&module).expect("it was just put there");
        let code = "// Update code (custom)";
        let place = start + text[start..].find(code).expect("code of a leaf") + code.len();
        text.insert_str(place, &format!("\n{show}\n"));
        let connections: String = ports.split(", ").map(|port| format!(".{port}({port}), ")).collect();
        let instance = format!("    {FIFO}${child} {child}(");
        text = replace(&text, &instance, &format!("{instance}{connections}"));
    }
    let module = format!("module {FIFO}(");
    text = replace(&text, &module, &format!("{module}chosen,"));
    let show = format!(
        "localparam P = {P};
         input wire [{last}:0] chosen; wire [1:0] chosen_word, array_word;
         wire [{last}:0] read_seen_first, write_seen_first;"
    );
    text = text.replacen("// Constant declarations", &format!("{show}\n// Constant declarations"), 1);
    with_properties(&text, FIFO, include_str!("../../../formal/async_fifo.v"))
}

fn port() -> String {
    with_properties(&block(PORT), PORT, include_str!("../../../formal/register_port.v"))
}

/// Checks that a design with `new` in place of `old` is not proven.
fn must_fail(text: &str, (name, has_several_clocks): (&str, bool), (old, new): (&str, &str)) {
    let proven = gate::prove(&replace(text, old, new), name, has_several_clocks, STEPS);
    match proven {
        Err(GateError::Refused { output, .. }) => assert!(output.contains("proof did fail"), "{old:?}: {output}"),
        Err(error) => panic!("{old:?}: {error}"),
        Ok(()) => panic!("{new:?} in place of {old:?} is not found"),
    }
}

fn prove_fifo<const P: usize>() {
    gate::prove(&fifo::<P>(), FIFO, true, STEPS).unwrap_or_else(|error| panic!("pointers of {P} bits: {error}"));
}

/// Proves the FIFO with 4, 8 and 16 entries. The real one has 512: its Verilog is the same text, in which the depth
/// sets only the widths of pointers, addresses and one mask. The proof carries over by that reading, not by a tool.
/// More entries take too long: 32 take ten times as long as 16.
#[test]
fn the_fifo_is_proven() {
    prove_fifo::<3>();
    prove_fifo::<4>();
    prove_fifo::<5>();
}

#[test]
fn faults_of_the_fifo_are_found() {
    let text = fifo::<3>();
    for fault in [
        ("full$d = next_gray$q == full_code;", "full$d = 1'b0;"),
        ("full$d = next_gray$q == full_code;", "full$d = next_gray$q == read_seen$received;"),
        ("full$d = write_gray$q == full_code;", "full$d = 1'b0;"),
        ("next_gray$d = second_write ^ second_half;", "next_gray$d = second_write;"),
        ("empty$d = read_code == write_seen$received;", "empty$d = read_gray$q == write_seen$received;"),
        ("memory$read_address = read_count$q;", "memory$read_address = read_ahead;"),
        ("memory$write_enable = takes;", "memory$write_enable = push;"),
        ("moves = pop | (~shown$q);", "moves = 1'b1;"),
        // An entry must be able to come through, or the proof would be empty.
        ("assert (w_r <= DEPTH);", "assert (w_r <= DEPTH && !valid);"),
    ] {
        must_fail(&text, (FIFO, true), fault);
    }
}

#[test]
fn the_register_port_is_proven() {
    gate::prove(&port(), PORT, false, STEPS).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn faults_of_the_register_port_are_found() {
    let text = port();
    for fault in [
        ("writes = has_address$q & has_data$q & (~is_written$q);", "writes = has_address$q & has_data$q;"),
        ("reads = has_read$q & (~is_read$q);", "reads = has_read$q;"),
        ("if (write_is_known) begin", "if (read_is_known) begin"),
        ("s_axi$wready = ~has_data$q;", "s_axi$wready = 1'b1;"),
        // Answers must be possible, or the proof would be empty.
        ("if (could_read) assert (s_axi$rvalid);", "if (could_read) assert (!s_axi$rvalid);"),
    ] {
        must_fail(&text, (PORT, false), fault);
    }
}

const BLOCK: &str = "stream_register_block";

fn traffic() -> String {
    with_properties(&block(BLOCK), &format!("{BLOCK}$traffic"), include_str!("../../../formal/traffic.v"))
}

#[test]
fn the_clocks_and_their_high_half_are_proven() {
    let text = traffic();
    gate::prove(&text, BLOCK, false, STEPS).unwrap_or_else(|error| panic!("{error}"));
    for fault in [
        ("kept$d = clocks$q[(32'h20)+:(32)];", "kept$d = clocks$q[(32'h1f)+:(32)];"),
        ("clocks$d = clocks$q + one_clock;", "clocks$d[31:0] = clocks$q[31:0] + one;"),
    ] {
        must_fail(&text, (BLOCK, false), fault);
    }
}
