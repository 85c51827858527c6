//! A card as a device of vfio-user: a PCI device behind a socket, with configuration space, two windows of registers, DMA into the host's memory,
//! messages as interrupts, and a reset; and a driver for it in user space.
//!
//! [`VfioCard`] has, around any [`incircle_sim::pcie::Beats`], the bridge that stands before the real card: the registers of its core in the
//! first window, and in the second those of AMD's DMA bridge, in the subset that one channel each way needs. [`VfioDriver`] finds the windows,
//! maps memory for DMA, takes interrupts, and gives the three files that the library's own driver wants: so that runs its jobs through all of it.
//!
//! Both sides use the crate `vfio_user` 0.1.7, whose limits are these. The client does not look at errors in answers, and would wait without end for
//! the rest of one to a read; so the device answers every read, with all ones where a bus would. The client has no deadline: its caller has. The
//! server trusts the sizes in messages, and ends a connection only when the client does. Nor is the table of messages hidden from the host, as
//! the kernel's VFIO does: the driver writes it.

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

/// Memory without a name that processes can share, of this size for ever.
fn shared_memory(bytes: u64) -> io::Result<File> {
    let memory = memfd_create("incircle-dma", MemfdFlags::CLOEXEC | MemfdFlags::ALLOW_SEALING)?;
    ftruncate(&memory, bytes)?;
    fcntl_add_seals(&memory, SealFlags::SHRINK | SealFlags::GROW)?;
    Ok(memory.into())
}
