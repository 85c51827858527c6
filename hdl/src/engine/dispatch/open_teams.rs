//! The teams that are open: all their contexts may work, because the first 16 points of their job are taken (L8).
//!
//! 1. While the pointer goes round for the first time (`planned`), every team is closed. A team opens when its first
//!    context takes point 16 of its job, which is the 17th.
//!
//! Latency: none to read; a team that opens is open from the next clock on.
//!
//! Source: a table in LUTs. Flags in registers would need a choice among 24 of them.

use super::next_point::Planned;
use crate::engine::types::{context_bits, ContextId, CONTEXT_BITS};
use crate::leaf::LutMemory;
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct OpenTeams {
    pub clock: Signal<In, Clock>,
    /// In the first round of the pointer, a context and its team.
    pub planned: Signal<In, Planned>,
    /// The team `opened` opens at this edge; not allowed in the first round of the pointer.
    pub opens: Signal<In, Bit>,
    pub opened: Signal<In, ContextId>,
    /// The team that is asked about.
    pub asked: Signal<In, ContextId>,
    pub is_open: Signal<Out, Bit>,
    flags: LutMemory<CONTEXT_BITS, 1>,
}

impl OpenTeams {
    pub fn new(config: Config) -> Self {
        Self { flags: LutMemory::new(context_bits(config), 1), ..Self::default() }
    }
}

impl Logic for OpenTeams {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, flags);
        self.flags.read_address.next = self.asked.val();
        self.is_open.next = self.flags.read_data.val().any();
        self.flags.write_address.next = self.opened.val();
        self.flags.write_data.next = 1.into();
        self.flags.write_enable.next = self.opens.val();
        if self.planned.val().valid {
            self.flags.write_address.next = self.planned.val().team;
            self.flags.write_data.next = 0.into();
            self.flags.write_enable.next = true;
        }
    }
}
