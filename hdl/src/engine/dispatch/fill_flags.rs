//! The flags of a context whose item ends with its hole: the context falls asleep, and its locks become due.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{ContextSet, FillEnd};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct FillFlags {
    pub ending: Signal<In, FillEnd>,
    pub asleep: Signal<In, ContextSet>,
    pub busy: Signal<In, ContextSet>,
    pub asleep_after: Signal<Out, ContextSet>,
    pub busy_after: Signal<Out, ContextSet>,
    wide: Signal<Local, ContextSet>,
    one: Signal<Local, ContextSet>,
    ended: Signal<Local, ContextSet>,
}

impl Logic for FillFlags {
    #[hdl_gen]
    fn update(&mut self) {
        self.one.next = 1.into();
        self.wide.next = bit_cast::<24, 5>(self.ending.val().context);
        self.ended.next = 0.into();
        if self.ending.val().valid {
            self.ended.next = self.one.val() << self.wide.val();
        }
        self.asleep_after.next = self.asleep.val() | self.ended.val();
        self.busy_after.next = self.busy.val() | self.ended.val();
    }
}
