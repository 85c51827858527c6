//! The next vertex of each context: written down in the first round of the pointer, and whenever a context takes a
//! vertex. A start then needs no sum to know its vertex.
//!
//! 1. The table is never cleared. Until the pointer has gone round once, the first vertex of a context comes from its
//!    number, and is written down.
//! 2. The table is read without asking whether the context has had a point, because to choose one flag
//!    of 24 takes long.
//!
//! Latency: none to read; a write is read from the next clock on.
//!
//! Source: a table in LUTs beside [`NextPoint`].

use super::next_point::{Following, NextPoint, Passed, Pointer};
use crate::engine::types::{context_bits, ContextId, Deal, Plan, VertexId, CONTEXT_BITS, PLAN_BITS};
use crate::leaf::{LutMemory, Unpack};
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

crate::packed! {
    /// A context takes a vertex at this edge, and this one after it; only once all contexts are planned.
    pub struct PlanWrite {
        pub valid: bool,
        pub context: ContextId,
        pub id: VertexId,
    }
}

#[derive(LogicBlock, Default)]
pub struct PlanTable {
    pub clock: Signal<In, Clock>,
    /// The rule by which points belong to contexts.
    pub deal: Signal<In, Deal>,
    /// The context under the pointer.
    pub pointer: Signal<In, Pointer>,
    /// The pointer has stood at every context since the last clear.
    pub is_planned: Signal<In, Bit>,
    /// The vertex that the context under the pointer takes next; in a batch, the one after
    /// its first vertex (`first_dealt`).
    pub due: Signal<Out, Plan>,
    pub first_dealt: Signal<Out, Bits<7>>,
    /// The context that the pointer has left, with its `due` and `first_dealt`; and the plan that follows its vertex.
    pub passed: Signal<In, Passed>,
    pub following: Signal<Out, Following>,
    /// The new plan of a context that takes a vertex.
    pub write: Signal<In, PlanWrite>,
    points: NextPoint,
    plans: LutMemory<CONTEXT_BITS, PLAN_BITS>,
    plan: Unpack<Plan, PLAN_BITS>,
    written: Signal<Local, Plan>,
    written_bits: Signal<Local, Bits<PLAN_BITS>>,
}

impl PlanTable {
    pub fn new(config: Config) -> Self {
        Self { plans: LutMemory::new(context_bits(config), PLAN_BITS), ..Self::default() }
    }
}

impl Logic for PlanTable {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, plans);
        self.points.deal.next = self.deal.val();
        self.points.pointer.next = self.pointer.val();
        self.points.passed.next = self.passed.val();
        self.first_dealt.next = self.points.first_dealt.val();
        self.following.next = self.points.following.val();

        self.plans.read_address.next = self.pointer.val().turn;
        self.plan.bits.next = self.plans.read_data.val();
        self.plans.write_address.next = self.pointer.val().turn;
        self.due.next = self.points.first.val();
        self.written.next = self.points.first.val();
        if self.is_planned.val() {
            self.plans.write_address.next = self.write.val().context;
            self.due.next = self.plan.value.val();
            self.written.next.id = self.write.val().id;
            self.written.next.is_seed = false;
        }
        self.written_bits.next = self.written.val().into();
        self.plans.write_data.next = self.written_bits.val();
        self.plans.write_enable.next = self.write.val().valid | (!self.is_planned.val());
    }
}
