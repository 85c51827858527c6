//! Leaves: the blocks with hand-written Verilog, such as memories and multipliers, and small blocks built from them.
//!
//! A leaf states its behaviour twice: `update()` for simulation in Rust, `hdl()` for synthesis and Verilator. The tests
//! in `testbench/tests/it/blocks/leaf/` compare both with a third, independent statement.

mod banked_memory;
mod block_memory;
mod deep_fifo;
mod delay_line;
mod dual_clock_memory;
mod ecp5;
mod fifo;
mod flag_delay;
mod lock_memory;
mod lookup_table;
mod lut_memory;
mod memory_shape;
mod multiplier;
mod paced_memory;
mod parameter;
mod shared_memory;
mod spill_ring;
mod synchroniser;
pub mod unpack;

pub use banked_memory::BankedMemory;
pub use block_memory::BlockMemory;
pub use deep_fifo::DeepFifo;
pub use delay_line::DelayLine;
pub use dual_clock_memory::DualClockMemory;
pub use fifo::Fifo;
pub use flag_delay::FlagDelay;
pub use lock_memory::LockMemory;
pub use lookup_table::LookupTable;
pub use lut_memory::LutMemory;
pub use multiplier::Multiplier;
pub use paced_memory::PacedMemory;
pub use parameter::Parameter;
pub use shared_memory::SharedMemory;
pub use spill_ring::SpillRing;
pub use synchroniser::Synchroniser;
pub use unpack::{Field, Unpack, Unpacked};
