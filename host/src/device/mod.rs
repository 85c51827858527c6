//! Devices: opened by address, used through a session.
//!
//! ```text
//! Device ──> Session ──> Backend <── CpuBackend      the engine in this process
//!    │                      ^
//! DeviceAddress             └─────── DeviceBackend   commands to a device, over a way of [`crate::transports`]
//! ```
//!
//! A [`Session`](session::Session) checks what it is given and says how long it may take. The rest of a job is that of
//! its back end.

mod address;
mod backend;
mod cpu_backend;
mod device_backend;
mod open;
mod session;

pub use address::DeviceAddress;
pub use open::Device;
pub use session::Session;
