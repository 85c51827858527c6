//! Tests of the blocks in `hdl/src/leaf`.

mod banked_memory;
mod block_memory;
mod cells;
mod deep_fifo;
mod delay_line;
mod dual_clock_memory;
mod fifo;
mod flag_delay;
mod lock_memory;
mod lookup_table;
mod lut_memory;
mod multiplier;
mod paced_memory;
mod shared_memory;
mod synchroniser;
