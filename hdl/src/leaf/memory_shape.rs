//! The shape of a memory leaf: its limits, and the Verilog for ports that are wider than the memory.

/// Largest number of address bits of a memory leaf; keeps the number of words far from any overflow.
pub(super) const MAX_ADDRESS_BITS: usize = 20;

/// Panics if the ports of a memory cannot carry its shape.
pub(super) fn assert_shape(address_bits: usize, address_port: usize, stored_bits: usize, data_port: usize) {
    let widest = address_port.min(MAX_ADDRESS_BITS);
    assert!((1..=widest).contains(&address_bits), "a memory here has 1 to {widest} address bits, not {address_bits}");
    assert!(
        (1..=data_port).contains(&stored_bits),
        "a memory here keeps 1 to {data_port} bits of a word, not {stored_bits}"
    );
}

/// The Verilog for the low `kept` of the `width` bits of a port.
///
/// A port of one bit is a scalar in the emitted Verilog and takes no range.
pub(super) fn low_part(port: &str, width: usize, kept: usize) -> String {
    if kept == width {
        port.to_string()
    } else {
        format!("{port}[{}:0]", kept - 1)
    }
}

/// The Verilog for a value of `kept` bits, zero-extended to `width`.
pub(super) fn zero_extended(value: &str, width: usize, kept: usize) -> String {
    if kept == width {
        value.to_string()
    } else {
        format!("{{{{{}{{1'b0}}}}, {value}}}", width - kept)
    }
}

/// A Verilog wire that reads the bits of `port` from bit `kept` up, so that lint sees them used, or nothing
/// if there are none.
pub(super) fn unused_part(port: &str, width: usize, kept: usize) -> String {
    if kept == width {
        String::new()
    } else {
        format!("wire unused_{port} = &{{1'b0, {port}[{}:{kept}]}};\n", width - 1)
    }
}
