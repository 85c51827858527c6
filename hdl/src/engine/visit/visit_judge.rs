//! The predicates of a visit, and the verdict that follows from their signs.
//!
//! 1. Corners and point come straight from registers, and new ones may come at every edge. There is no reset, because
//!    the pipeline's valid bits decide which verdicts count.
//!
//! Latency: `LATENCY` = 10 clocks from the corners to the verdict, which has no register of its own.
//!
//! A point equals a corner of a triangle without area; a walk would leave the triangle for its first neighbour:
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
use crate::predicate::{Corners, Point, Sides, VisitPredicates};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct VisitJudge {
    pub clock: Signal<In, Clock>,
    /// Corners of the record as stored, and the point, in clock 0.
    pub corners: Signal<In, Corners>,
    pub p: Signal<In, Point>,
    /// The rotated record, in clock 10 with its signs, straight from registers.
    pub turned: Signal<In, Turned>,
    /// The findings of the visit, in clock 10.
    pub verdict: Signal<Out, Verdict>,
    /// Signs and values of its three orient2d, for the corners as stored, in clock 10: in a core that answers
    /// questions.
    pub sides: Vec<Signal<Out, Sides>>,
    predicates: VisitPredicates,
    verdict_logic: VerdictLogic,
}

impl VisitJudge {
    /// The number of clocks from the corners to the verdict.
    pub const LATENCY: usize = VisitPredicates::LATENCY;

    /// The judge of a core that answers questions.
    pub fn with_sides() -> Self {
        Self { sides: vec![Signal::default()], predicates: VisitPredicates::with_sides(), ..Self::default() }
    }
}

impl Logic for VisitJudge {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, predicates);
        self.predicates.corners.next = self.corners.val();
        self.predicates.p.next = self.p.val();
        self.verdict_logic.turned.next = self.turned.val();
        self.verdict_logic.signs.next = self.predicates.signs.val();
        self.verdict.next = self.verdict_logic.verdict.val();
        for i in 0..self.sides.len() {
            self.sides[i].next = self.predicates.sides[i].val();
        }
    }
}
