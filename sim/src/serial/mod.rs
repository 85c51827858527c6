//! Boards behind a serial line, in simulated time.
//!
//! A [`Board`] has a line to it and one from it. [`PinBoard`] is the Verilated `incircle_serial_top`, whose pins are driven and sampled bit
//! by bit. [`QuickBoard`] is the software model of the link around the Verilated core; it skips bits and idle time.

mod board;
mod core;
mod pins;
mod quick;
mod uart;

pub use board::board_link;
pub use pins::PinBoard;
pub use quick::QuickBoard;
pub use uart::{Symbol, SYMBOL_BITS};

use incircle_protocol::LinkConfig;

/// A board as its serial line sees it.
pub trait Board {
    /// Parameters of its link.
    fn link(&self) -> LinkConfig;

    /// Clocks since it was made. They go on over a [`Board::power_cycle`].
    fn clocks(&self) -> u64;

    /// Bits per second with which the host sends and samples from now on.
    fn set_rate(&mut self, rate: u32);

    /// Puts a symbol behind those that wait for the line to the board.
    fn send(&mut self, symbol: Symbol);

    /// Symbols that are not on the line to the board yet.
    fn waiting(&self) -> usize;

    /// What came from the board next, with the clock at which its stop bit was seen.
    fn receive(&mut self) -> Option<(u64, Symbol)>;

    /// So many clocks pass.
    fn run(&mut self, clocks: u64);

    /// Nothing is on the line or in the board, and time would change nothing.
    fn is_at_rest(&self) -> bool;

    /// As after its power was away.
    fn power_cycle(&mut self);
}
