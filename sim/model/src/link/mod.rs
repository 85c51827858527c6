//! The parts that the models of the serial link and of the UDP link share: a session's words on their way between host
//! and core.

mod answers;
mod crc;
mod device;
mod flow;

pub use crc::Crc32;
pub use device::{core_identity, Instantly, Passed, WordDevice};

pub(crate) use flow::{Flow, Taken};
