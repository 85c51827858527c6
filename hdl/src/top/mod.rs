//! The core: everything put together.

mod core;
mod wrapper;

pub use self::core::Core;
pub use wrapper::{wrapper, CORE_NAME};
