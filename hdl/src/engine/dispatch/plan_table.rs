//! What each context takes next: written down in the pointer's first round, and whenever a context takes a vertex.
//!
//! 1. Nothing is cleared: until the pointer has gone round, each context's first vertex comes from its number, and is written down.
//! 2. What a context takes next is read without asking whether it has had a point: to choose one flag of 24 takes long.
//!
//! Latency: none to read; what is written is read from the next clock on.
//!
//! Source: a table in LUTs beside [`NextPoint`].

use super::next_point::NextPoint;
use crate::engine::types::{context_bits, Deal, Plan, PLAN_BITS};
use crate::leaf::{LutMemory, Unpack};
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

/// What each context takes next; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct PlanTable {
    /// Everything happens at its rising edge.
    pub clock: Signal<In, Clock>,
    /// Contexts that work, and which points are theirs.
    pub deal: Signal<In, Deal>,
    /// The context that the pointer stands at, and `3 turn + 2`.
    pub turn: Signal<In, Bits<5>>,
    pub third: Signal<In, Bits<7>>,
    /// The pointer has stood at every context since the last clear.
    pub is_planned: Signal<In, Bit>,
    /// What that context takes next; the vertex after its first, in a batch.
    pub due: Signal<Out, Plan>,
    pub first_dealt: Signal<Out, Bits<7>>,
    /// Another context, and what stood on `due` and `first_dealt` for it.
    pub taker: Signal<In, Bits<5>>,
    pub taken: Signal<In, Bits<15>>,
    pub took_seed: Signal<In, Bit>,
    pub taken_dealt: Signal<In, Bits<7>>,
    /// That is behind the first round; the vertex it takes after that; the first record of its mesh.
    pub taken_is_dealt: Signal<Out, Bit>,
    pub after_taken: Signal<Out, Bits<15>>,
    pub first_record: Signal<Out, Bits<15>>,
    /// A context takes a vertex at this edge, and this one after it; only while `is_planned`.
    pub takes: Signal<In, Bit>,
    pub owner: Signal<In, Bits<5>>,
    pub planned: Signal<In, Bits<15>>,
    following: NextPoint,
    plans: LutMemory<5, PLAN_BITS>,
    plan: Unpack<Plan, PLAN_BITS>,
    written: Signal<Local, Plan>,
    written_bits: Signal<Local, Bits<PLAN_BITS>>,
}

impl PlanTable {
    /// The table of a configuration.
    pub fn new(config: Config) -> Self {
        Self { plans: LutMemory::new(context_bits(config), PLAN_BITS), ..Self::default() }
    }
}

impl Logic for PlanTable {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, plans);
        self.following.deal.next = self.deal.val();
        self.following.turn.next = self.turn.val();
        self.following.third.next = self.third.val();
        self.following.taker.next = self.taker.val();
        self.following.taken.next = self.taken.val();
        self.following.took_seed.next = self.took_seed.val();
        self.following.taken_dealt.next = self.taken_dealt.val();
        self.first_dealt.next = self.following.first_dealt.val();
        self.taken_is_dealt.next = self.following.taken_is_dealt.val();
        self.after_taken.next = self.following.after_taken.val();
        self.first_record.next = self.following.first_record.val();

        self.plans.read_address.next = self.turn.val();
        self.plan.bits.next = self.plans.read_data.val();
        self.plans.write_address.next = self.turn.val();
        self.due.next = self.following.first.val();
        self.written.next = self.following.first.val();
        if self.is_planned.val() {
            self.plans.write_address.next = self.owner.val();
            self.due.next = self.plan.value.val();
            self.written.next.id = self.planned.val();
            self.written.next.is_seed = false;
        }
        self.written_bits.next = self.written.val().into();
        self.plans.write_data.next = self.written_bits.val();
        self.plans.write_enable.next = self.takes.val() | (!self.is_planned.val());
    }
}
