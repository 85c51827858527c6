//! The names of rust-hdl that nearly every block uses.

pub(crate) use rust_hdl_core::prelude::*;
pub(crate) use rust_hdl_widgets::prelude::*;
