//! The next vertex of each context: written down in the first round of the pointer, and whenever a context takes a
//! vertex. A start then needs no sum to know its vertex.
//!
//! 1. The table is never cleared. Until the pointer has gone round once, the first vertex of a context comes from its
//!    number, and is written down.
//! 2. The table is read without asking whether the context has had a point, because to choose one flag of 24 takes
//!    long.
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
    /// The context under the pointer with the vertex that it takes next.
    pub shown: Signal<Out, Passed>,
    /// The context that the pointer has left, as it was shown; and the plan that follows its vertex.
    pub passed: Signal<In, Passed>,
    pub following: Signal<Out, Following>,
    /// The new plan of a context that takes a vertex.
    pub write: Signal<In, PlanWrite>,
    points: NextPoint,
    plans: LutMemory<CONTEXT_BITS, PLAN_BITS>,
    plan: Unpack<Plan, PLAN_BITS>,
    rounds: Signal<Local, Bits<11>>,
    round_size: Signal<Local, Bits<11>>,
    planned_id: Signal<Local, VertexId>,
    first: Signal<Local, Plan>,
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
        self.shown.next.context = self.pointer.val().turn;
        self.shown.next.team = self.pointer.val().team;
        self.shown.next.is_first = self.pointer.val().is_first;
        self.shown.next.dealt = self.points.first_dealt.val();
        self.following.next = self.points.following.val();

        self.plans.read_address.next = self.pointer.val().turn;
        self.plan.bits.next = self.plans.read_data.val();
        self.plans.write_address.next = self.pointer.val().turn;
        self.first.next = self.points.first.val();
        self.shown.next.id = self.first.val().id;
        self.shown.next.is_seed = self.first.val().is_seed;
        self.written.next = self.points.first.val();
        // The first round of a job has 16 points, so the ids behind it are those from `16 jobs` on. The first context
        // of a team begins in front of it, and the others begin behind it.
        self.planned_id.next = self.plan.value.val().id;
        self.rounds.next = self.planned_id.val().get_bits::<11>(4);
        self.round_size.next = bit_cast::<11, 5>(self.deal.val().jobs);
        self.shown.next.is_dealt = !self.pointer.val().is_first;
        if self.is_planned.val() {
            self.plans.write_address.next = self.write.val().context;
            self.shown.next.id = self.plan.value.val().id;
            self.shown.next.is_seed = self.plan.value.val().is_seed;
            self.shown.next.is_dealt = self.rounds.val() >= self.round_size.val();
            self.written.next.id = self.write.val().id;
            self.written.next.is_seed = false;
        }
        self.written_bits.next = self.written.val().into();
        self.plans.write_data.next = self.written_bits.val();
        self.plans.write_enable.next = self.write.val().valid | (!self.is_planned.val());
    }
}
