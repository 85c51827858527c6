//! Boards on a network, in simulated time.

mod board;
mod frame;
mod parameters;

pub use board::NetworkBoard;
pub use parameters::{network_link, ADDRESS};
