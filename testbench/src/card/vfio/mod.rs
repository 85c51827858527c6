//! A card as a vfio-user device, and a driver for the card in user space. The device is a PCI device
//! behind a socket, with a configuration space, two windows of registers, DMA into the host's memory,
//! messages as interrupts, and a reset.
//!
//! [`VfioCard`] wraps any [`incircle_sim::pcie::Beats`] in the bridge that lies before the real card. The first
//! window has the registers of the card; the second has those of AMD's DMA bridge, in the subset that one channel each
//! way needs. [`VfioDriver`] finds the windows, maps memory for DMA, takes interrupts, and provides the three files
//! that the library's own driver expects. The library's jobs thus run through every part of a PCIe device.
//!
//! Both sides use the crate `vfio_user` 0.1.7, whose limits shape this module. The client does not look for errors in
//! answers, and would wait without end for the rest of an answer to a read; so the device answers every read, with all
//! ones where a bus would. The client has no deadline, so its caller sets one. The server trusts the sizes in messages,
//! and ends a connection only when the client does. The table of messages is not hidden from the host, as the kernel's
//! VFIO would hide it: the driver writes it.

mod bridge;
mod channel;
mod config_space;
mod descriptor;
mod dma_memory;
mod driver;
mod error;
mod interrupts;
mod link;
mod memory;
pub mod numbers;
mod places;
mod server;
mod transfers;

pub use bridge::MakeCard;
pub use channel::Way;
pub use descriptor::{Descriptor, Written};
pub use dma_memory::DmaMemory;
pub use driver::VfioDriver;
pub use error::DriverError;
pub use server::VfioCard;
pub use transfers::{Answers, Commands, Transfers};

use std::fs::File;
use std::io;

use rustix::fs::{fcntl_add_seals, ftruncate, memfd_create, MemfdFlags, SealFlags};

/// Creates anonymous memory that processes can share and whose size never changes.
fn shared_memory(bytes: u64) -> io::Result<File> {
    let memory = memfd_create("incircle-dma", MemfdFlags::CLOEXEC | MemfdFlags::ALLOW_SEALING)?;
    ftruncate(&memory, bytes)?;
    fcntl_add_seals(&memory, SealFlags::SHRINK | SealFlags::GROW)?;
    Ok(memory.into())
}
