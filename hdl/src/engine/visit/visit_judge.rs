//! The predicates of a visit and the verdict that follows from them.
//!
//! 1. Corners and point come straight from registers. New ones are taken at every edge; there is no reset.
//!
//! Latency: `LATENCY` = 10 clocks from the corners to the verdict, which has no register of its own.
//!
//! A point that falls onto a corner of a triangle without area; a walk would leave it by its first link:
//! ```text
//! r0                2  .  .  .  .  .  .  .  .  .  .  .
//! r1                6  .  .  .  .  .  .  .  .  .  .  .
//! r2                4  .  .  .  .  .  .  .  .  .  .  .
//! p                 6  .  .  .  .  .  .  .  .  .  .  .
//! turned.n0         .  .  .  .  .  .  .  .  .  .  9  .
//! walk_next         .  .  .  .  .  .  .  .  .  .  9  .
//! corner            .  .  .  .  .  .  .  .  .  ./^^  .
//! ```

use super::verdict_logic::VerdictLogic;
use crate::engine::types::{Turned, Verdict};
use crate::predicate::VisitPredicates;
use rust_hdl_core::prelude::*;

/// Signs and verdict; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct VisitJudge {
    /// Everything happens at its rising edge.
    pub clock: Signal<In, Clock>,
    /// Corners of the record as stored, and the point, in clock 0.
    pub r0: Signal<In, Bits<32>>,
    pub r1: Signal<In, Bits<32>>,
    pub r2: Signal<In, Bits<32>>,
    pub p: Signal<In, Bits<32>>,
    /// The record turned, when its signs are there, straight from registers, in clock 10.
    pub turned: Signal<In, Turned>,
    /// What the visit found out, in clock 10.
    pub verdict: Signal<Out, Verdict>,
    predicates: VisitPredicates,
    verdict_logic: VerdictLogic,
}

impl VisitJudge {
    /// Clocks from the corners to the verdict.
    pub const LATENCY: usize = VisitPredicates::LATENCY;
}

impl Logic for VisitJudge {
    #[hdl_gen]
    fn update(&mut self) {
        self.predicates.clock.next = self.clock.val();
        self.predicates.r0.next = self.r0.val();
        self.predicates.r1.next = self.r1.val();
        self.predicates.r2.next = self.r2.val();
        self.predicates.p.next = self.p.val();
        self.verdict_logic.turned.next = self.turned.val();
        self.verdict_logic.e0_negative.next = self.predicates.e0_negative.val();
        self.verdict_logic.e1_negative.next = self.predicates.e1_negative.val();
        self.verdict_logic.e2_negative.next = self.predicates.e2_negative.val();
        self.verdict_logic.e0_zero.next = self.predicates.e0_zero.val();
        self.verdict_logic.e1_zero.next = self.predicates.e1_zero.val();
        self.verdict_logic.e2_zero.next = self.predicates.e2_zero.val();
        self.verdict_logic.e1_below_e0.next = self.predicates.e1_below_e0.val();
        self.verdict_logic.e2_below_e0.next = self.predicates.e2_below_e0.val();
        self.verdict_logic.e2_below_e1.next = self.predicates.e2_below_e1.val();
        self.verdict_logic.incircle_positive.next = self.predicates.incircle_positive.val();
        self.verdict_logic.incircle_zero.next = self.predicates.incircle_zero.val();
        self.verdict_logic.p_before_r0.next = self.predicates.p_before_r0.val();
        self.verdict_logic.p_before_r1.next = self.predicates.p_before_r1.val();
        self.verdict_logic.p_before_r2.next = self.predicates.p_before_r2.val();
        self.verdict_logic.p_equals_r0.next = self.predicates.p_equals_r0.val();
        self.verdict_logic.p_equals_r1.next = self.predicates.p_equals_r1.val();
        self.verdict_logic.p_equals_r2.next = self.predicates.p_equals_r2.val();
        self.verdict_logic.r0_before_r1.next = self.predicates.r0_before_r1.val();
        self.verdict_logic.r0_before_r2.next = self.predicates.r0_before_r2.val();
        self.verdict_logic.r1_before_r2.next = self.predicates.r1_before_r2.val();
        self.verdict.next = self.verdict_logic.verdict.val();
    }
}
