//! The core with all its parts, and the devices that put a link around the core.

mod core;
mod living_core;
mod serial_top;
mod stream_top;
mod udp_top;
mod udp_wrapper;
mod wrapper;

pub use self::core::Core;
pub use living_core::LivingCore;
pub use serial_top::SerialTop;
pub use stream_top::StreamTop;
pub use udp_top::UdpTop;
pub use udp_wrapper::{udp_wrapper, UdpPins, UDP_TOP_NAME};
pub use wrapper::{serial_wrapper, stream_wrapper, wrapper, ChipParts, CORE_NAME, SERIAL_TOP_NAME, STREAM_TOP_NAME};
