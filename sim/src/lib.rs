//! The incircle core in Verilator, as a device that takes and returns words.
//!
//! The build of this crate exports the Verilog of every named configuration ([`incircle_protocol::NAMED`]) and
//! translates it, and `small` once more with runs. [`SimDevice`] drives the two streams of the core:
//! `command_{valid,ready,data}` and `response_{valid,ready,data,both}`. [`serial`] has whole boards with such a core
//! behind a serial line; [`faults`] disturbs that line, and [`serve`] puts a board behind a pseudo-terminal.
//! [`network`] has boards behind the pins of a PHY of Ethernet. [`pcie`] has cards behind the files of their driver, in
//! a directory. The program `incircle-sim` serves boards and cards. [`open`] and [`SimTransport`] make a core a device
//! of the library `incircle`, and [`waves`] lays out waveforms.
//!
//! The software twin of the simulated core is `incircle_model`, which this crate uses where no pins are needed.
//!
//! ```no_run
//! use incircle_protocol::{command_word, Opcode, SMALL};
//! let mut device = incircle_sim::SimDevice::new(SMALL)?;
//! device.send(&[command_word(Opcode::Hello)], 100)?;
//! let mut answer = [0; 9];
//! device.receive(&mut answer, 1000)?;
//! println!("{answer:x?} after {} clocks", device.clocks());
//! # Ok::<(), incircle_sim::SimError>(())
//! ```

mod device;
mod error;
pub mod faults;
mod job_watch;
pub mod network;
pub mod pcie;
pub mod serial;
pub mod serve;
#[cfg(test)]
mod tests;
mod transport;
pub mod waves;

pub use device::SimDevice;
pub use error::{Awaited, SimError};
pub use transport::{open, SimTransport};

/// The models that the build script translated and compiled.
mod models {
    verilated::include_models!();
}
