//! The reasons why the driver does not start.

use std::io;

use vfio_user::Error;

use super::numbers::{DEVICE, VENDOR};

/// The reasons why the driver does not start.
#[derive(Debug, thiserror::Error)]
pub enum DriverError {
    /// Nobody answers at the socket.
    #[error("the card does not answer: {0}: check that it is served")]
    Socket(#[from] Error),
    /// The device at the socket is another one.
    #[error("this is device {vendor:04x}:{device:04x}, not {VENDOR:04x}:{DEVICE:04x}: choose another card")]
    Other {
        /// The vendor id that the device reports.
        vendor: u16,
        /// The device id that the device reports.
        device: u16,
    },
    /// The bridge is missing, or lacks a part that the driver needs.
    #[error("the card has no {0}: check how its bridge was made")]
    Lacks(&'static str),
    /// The system refuses memory or events.
    #[error("the system provides no memory or events: {0}: check its limits")]
    System(#[from] io::Error),
}
