//! Leaves: the blocks whose Verilog is written by hand, and the small blocks on top of them.
//!
//! A leaf states its behaviour twice: `update()` for simulation in Rust, `hdl()` for synthesis and Verilator.
//! `testbench/tests/blocks_leaf.rs` runs both against a third statement of the same.

mod banked_memory;
mod block_memory;
mod deep_fifo;
mod delay_line;
mod dual_clock_memory;
mod ecp5;
mod fifo;
mod flag_delay;
mod lock_memory;
mod lut_memory;
mod multiplier;
mod paced_memory;
mod parameter;
mod shared_memory;
mod synchroniser;
mod unpack;

pub use banked_memory::BankedMemory;
pub use block_memory::BlockMemory;
pub use deep_fifo::DeepFifo;
pub use delay_line::DelayLine;
pub use dual_clock_memory::DualClockMemory;
pub use fifo::Fifo;
pub use flag_delay::FlagDelay;
pub use lock_memory::LockMemory;
pub use lut_memory::LutMemory;
pub use multiplier::Multiplier;
pub use paced_memory::PacedMemory;
pub use parameter::Parameter;
pub use shared_memory::SharedMemory;
pub use synchroniser::Synchroniser;
pub use unpack::{Field, Unpack, Unpacked};

/// Widest address a memory leaf takes; keeps the number of words far from any overflow.
const MAX_ADDRESS_BITS: usize = 20;

/// Refuses the shape of a memory that its ports cannot carry.
fn assert_shape(address_bits: usize, address_port: usize, stored_bits: usize, data_port: usize) {
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
fn low_part(port: &str, width: usize, kept: usize) -> String {
    if kept == width {
        port.to_string()
    } else {
        format!("{port}[{}:0]", kept - 1)
    }
}

/// The Verilog for a value of `kept` bits, zero-extended to `width`.
fn zero_extended(value: &str, width: usize, kept: usize) -> String {
    if kept == width {
        value.to_string()
    } else {
        format!("{{{{{}{{1'b0}}}}, {value}}}", width - kept)
    }
}

/// A Verilog wire that takes up the bits of `port` from `kept` up, so that lint sees them used; nothing if there are none.
fn unused_part(port: &str, width: usize, kept: usize) -> String {
    if kept == width {
        String::new()
    } else {
        format!("wire unused_{port} = &{{1'b0, {port}[{}:{kept}]}};\n", width - 1)
    }
}
