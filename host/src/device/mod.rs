//! Devices: opened by address, used through a session.
//!
//! ```text
//! Device ──> Session ──> Backend <── CpuBackend      the CPU triangulator
//!    │                      ^
//! DeviceAddress             └─────── DeviceBackend   commands to a device, over one of [`crate::transports`]
//! ```
//!
//! A [`Fleet`](fleet::Fleet) has a session on each of several devices, for the parts of one set.
//!
//! A [`LivingSession`] keeps a mesh that lives on a device, with the methods of a triangulation on the host.
//!
//! A [`Session`](session::Session) checks points and options and sets the time limit. Everything else about a job is up
//! to the back end.

mod address;
mod backend;
mod constrained;
mod cpu_backend;
mod device_backend;
mod fleet;
mod in_parts;
mod lay;
mod living;
mod open;
mod session;

pub use address::DeviceAddress;
pub use fleet::Fleet;
pub use living::{LivingMesh, LivingSession};
pub use open::Device;
pub use session::Session;
