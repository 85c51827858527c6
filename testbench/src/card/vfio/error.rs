//! Why the driver does not start.

use std::io;

use vfio_user::Error;

use super::numbers::{DEVICE, VENDOR};

/// Why the driver does not start.
#[derive(Debug, thiserror::Error)]
pub enum DriverError {
    /// Nobody answers at the socket.
    #[error("the card does not answer: {0}: check that it is served")]
    Socket(#[from] Error),
    /// It is another device.
    #[error("this is device {vendor:04x}:{device:04x}, not {VENDOR:04x}:{DEVICE:04x}: choose another card")]
    Other {
        /// Who made it.
        vendor: u16,
        /// Which it is.
        device: u16,
    },
    /// The bridge is not there, or lacks something.
    #[error("the card has no {0}: check how its bridge was made")]
    Lacks(&'static str),
    /// The system refuses.
    #[error("memory or events cannot be had: {0}: check limits of the system")]
    System(#[from] io::Error),
}
