//! Boards behind a serial line, in simulated time.
//!
//! A [`Board`] has a line in each direction. [`PinBoard`] is the Verilated `incircle_serial_top`, with its pins driven
//! and sampled bit by bit. [`QuickBoard`] is the software model of the serial link around the Verilated core; it skips
//! bits and idle time.

mod board;
mod core;
mod pins;
mod quick;
mod uart;

pub use board::board_link;
pub(crate) use core::StreamCore;
pub use pins::PinBoard;
pub use quick::QuickBoard;
pub use uart::{Symbol, SYMBOL_BITS};

use incircle_protocol::LinkConfig;

/// A board as its serial line sees it.
pub trait Board {
    /// Parameters of the board's serial link.
    fn link(&self) -> LinkConfig;

    /// Number of clocks since the board was made. A [`Board::power_cycle`] does not set it back.
    fn clocks(&self) -> u64;

    /// Sets the bits per second with which the host sends and samples from now on.
    fn set_rate(&mut self, rate: u32);

    /// Queues a symbol for the line to the board.
    fn send(&mut self, symbol: Symbol);

    /// Number of symbols that are queued and not on the line yet.
    fn waiting(&self) -> usize;

    /// Takes the next symbol from the board, with the clock at which its stop bit was sampled.
    fn receive(&mut self) -> Option<(u64, Symbol)>;

    /// Lets this many clocks pass.
    fn run(&mut self, clocks: u64);

    /// Whether neither the line nor the board does anything, so that passing time would change nothing.
    fn is_at_rest(&self) -> bool;

    /// Puts the board into the state after its power was cut and restored.
    fn power_cycle(&mut self);
}
