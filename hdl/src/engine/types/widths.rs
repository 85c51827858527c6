//! Widths, and the types that have them.

use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

/// Bits of a triangle id: `2 * 16384` records.
pub const TRIANGLE_BITS: usize = 15;
/// Bits of a vertex id: 16384 points and the infinite vertex, all ones in the configuration's width.
pub const VERTEX_BITS: usize = 15;
/// Bits of a ring entry number: 64 entries.
pub const ENTRY_BITS: usize = 6;
/// Bits of a count of ring entries, 0 to 64.
pub const COUNT_BITS: usize = 7;
/// Bits of a count of locks: an insertion sets at most `2 * 64 - 2`.
pub const LOG_BITS: usize = 7;

/// Bits of a context number: 24 contexts.
pub const CONTEXT_BITS: usize = 5;
/// Bits of a latency, a clock count that wraps.
pub const LATENCY_BITS: usize = incircle_protocol::LATENCY_BITS as usize;
/// Bits of the address of a memory with a word for each ring entry of each context.
pub const RING_ADDRESS_BITS: usize = CONTEXT_BITS + ENTRY_BITS;
/// Bits of the address of a memory with a word for each lock of each context.
pub const LOG_ADDRESS_BITS: usize = CONTEXT_BITS + LOG_BITS;

/// A triangle record.
pub type TriangleId = Bits<TRIANGLE_BITS>;
/// A vertex.
pub type VertexId = Bits<VERTEX_BITS>;
/// A context.
pub type ContextId = Bits<CONTEXT_BITS>;
/// A bit for each context.
pub type ContextSet = Bits<24>;
/// An entry of a boundary list.
pub type RingEntry = Bits<ENTRY_BITS>;
/// A count of ring entries.
pub type RingCount = Bits<COUNT_BITS>;
/// A count of locks, or a place in a log of locks.
pub type LockCount = Bits<LOG_BITS>;
/// A count of clocks that wraps.
pub type Clocks = Bits<LATENCY_BITS>;
/// A column of a record.
pub type Slot = Bits<2>;

/// Address bits that number the contexts of a configuration.
pub fn context_bits(config: Config) -> usize {
    bits_to_number(config.contexts)
}

/// Address bits that number the ring entries of a configuration.
pub fn ring_bits(config: Config) -> usize {
    bits_to_number(config.ring)
}

/// Bits that number `things`; at least one.
fn bits_to_number(things: u32) -> usize {
    (u32::BITS - (things.max(2) - 1).leading_zeros()) as usize
}
