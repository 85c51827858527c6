//! A card in a PCIe slot, behind the character devices of Xilinx's driver XDMA.
//!
//! A card has three files: command beats are written to one, answer beats are read from another, and the third has its
//! registers. Both streams block, so each has a thread; the caller waits for them until its deadline and no longer.
//! [`PcieTransport`] is what `Device::open("pcie:0")` makes; [`PcieTransport::new`] makes one of any three files, such
//! as some in memory.
//!
//! What is held is bounded by the commands that are under way and their answers, each once. Nothing that a card says is
//! believed: an answer has at most the words that its command may bring, and what they say is checked above.

mod address;
mod buffer;
mod fault;
pub(super) mod files;
pub(super) mod left_behind;
mod registers;
mod streams;
mod transport;

pub use address::{cards, CardAddress, CardInfo};
pub use fault::{CardFault, PcieFault};
pub use registers::CardRegisters;
pub use transport::PcieTransport;
