//! The transport to a card in a PCIe slot, behind the character devices of Xilinx's driver XDMA.
//!
//! Programs open a card with `Device::open("pcie:0")`. This module is for those that list [`cards`], tell faults apart
//! ([`CardFault`], [`PcieFault`]), or look at the registers of a card.
//!
//! A card has three files: command beats are written to one, answer beats are read from another, and the third has its
//! registers. Calls on both streams block, so each stream has a thread; the caller waits for the threads until its
//! deadline and no longer. [`PcieTransport::new`] makes a transport of any three files, such as files in memory.
//!
//! Memory is bounded by the commands under way and their answers, each held once. Nothing that a card says is believed:
//! an answer has at most the words that its command may bring, and the session checks the words.

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
