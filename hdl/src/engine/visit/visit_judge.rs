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

use super::near_corner::NearCorner;
use super::near_logic::NearLogic;
use super::verdict_logic::VerdictLogic;
use crate::engine::types::{NearVerdict, Turned, Verdict};
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
    /// In such a core as well: the rotated record in clock 0, and the search for the nearest vertex in clock 10.
    pub rotated: Vec<Signal<In, Turned>>,
    pub nearest: Vec<Signal<Out, NearVerdict>>,
    /// And whether the three corners turn left.
    pub turns_left: Vec<Signal<Out, Bit>>,
    predicates: VisitPredicates,
    verdict_logic: VerdictLogic,
    near_corner: Vec<NearCorner>,
    near_logic: Vec<NearLogic>,
}

impl VisitJudge {
    /// The number of clocks from the corners to the verdict.
    pub const LATENCY: usize = VisitPredicates::LATENCY;

    /// The judge of a core that answers questions.
    ///
    /// # Panics
    /// If the nearest corner is known in another clock than the signs, which is a fault in this source.
    pub fn with_sides() -> Self {
        assert_eq!(NearCorner::LATENCY, Self::LATENCY, "all findings of a visit come together");
        Self {
            sides: vec![Signal::default()],
            rotated: vec![Signal::default()],
            nearest: vec![Signal::default()],
            turns_left: vec![Signal::default()],
            predicates: VisitPredicates::with_sides(),
            near_corner: vec![NearCorner::default()],
            near_logic: vec![NearLogic::default()],
            ..Self::default()
        }
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
            self.near_corner[i].clock.next = self.clock.val();
            self.near_corner[i].corners.next = self.corners.val();
            self.near_corner[i].rotated.next = self.rotated[i].val();
            self.near_corner[i].pairs.next = self.predicates.pairs[i].val();
            self.near_logic[i].nearest.next = self.near_corner[i].nearest.val();
            self.near_logic[i].edges.next = self.predicates.signs.val().edges;
            self.near_logic[i].first_slot.next = self.turned.val().slot;
            self.nearest[i].next = self.near_logic[i].verdict.val();
            self.turns_left[i].next = self.predicates.turns_left[i].val();
        }
    }
}
