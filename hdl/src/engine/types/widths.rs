//! The widths of the numbers that travel through the engine, and the types that have them.

use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

/// Width of a record id in bits: at most `2 * 16384` records.
pub const TRIANGLE_BITS: usize = 15;
/// Width of a vertex number in bits: 16384 points, and the infinite vertex, which is all ones
/// in the configuration's width.
pub const VERTEX_BITS: usize = 15;
/// Width of a ring entry's number in bits: at most 64 entries.
pub const ENTRY_BITS: usize = 6;
/// Width of a count of ring entries in bits: 0 to 64.
pub const COUNT_BITS: usize = 7;
/// Width of a count of locks in bits: an attempt takes at most `2 * 64 - 2`.
pub const LOG_BITS: usize = 7;

/// Width of a context number in bits: at most 24 contexts.
pub const CONTEXT_BITS: usize = 5;
/// Width of a latency in bits; a latency is a clock count that wraps.
pub const LATENCY_BITS: usize = incircle_protocol::LATENCY_BITS as usize;
/// Width of the address of a memory with a word for each ring entry of each context.
pub const RING_ADDRESS_BITS: usize = CONTEXT_BITS + ENTRY_BITS;
/// Width of the address of a memory with a word for each lock of each context.
pub const LOG_ADDRESS_BITS: usize = CONTEXT_BITS + LOG_BITS;

pub type TriangleId = Bits<TRIANGLE_BITS>;
pub type VertexId = Bits<VERTEX_BITS>;
pub type ContextId = Bits<CONTEXT_BITS>;
/// One bit for each context.
pub type ContextSet = Bits<24>;
/// The number of an entry in the ring of a context.
pub type RingEntry = Bits<ENTRY_BITS>;
pub type RingCount = Bits<COUNT_BITS>;
/// A count of locks, or a place in a log of locks.
pub type LockCount = Bits<LOG_BITS>;
/// A count of clocks that wraps.
pub type Clocks = Bits<LATENCY_BITS>;
/// The slot of a vertex or neighbour in a record, 0 to 2.
pub type Slot = Bits<2>;

/// The number of address bits that number the contexts of a configuration.
pub fn context_bits(config: Config) -> usize {
    bits_to_number(config.contexts)
}

/// The number of address bits that number the ring entries of a configuration.
pub fn ring_bits(config: Config) -> usize {
    bits_to_number(config.ring)
}

/// The number of bits that tell `things` apart; at least one.
fn bits_to_number(things: u32) -> usize {
    (u32::BITS - (things.max(2) - 1).leading_zeros()) as usize
}
