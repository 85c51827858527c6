//! Whether a context whose item ends with its hole returns the priority. In a run there is one team.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{FillEnd, Priority};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct FillPriority {
    pub ending: Signal<In, FillEnd>,
    pub held: Signal<In, Priority>,
    pub returns: Signal<Out, Bit>,
}

impl Logic for FillPriority {
    #[hdl_gen]
    fn update(&mut self) {
        self.returns.next =
            self.ending.val().valid & self.held.val().is_held & (self.held.val().context == self.ending.val().context);
    }
}
