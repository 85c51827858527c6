//! The phases of a solo insertion: it walks to the record of the point, splits it, and goes round the star
//! by tests and flips.
//!
//! 1. `is_locate`, `is_mend`, `is_fetch` and `is_test` wait for a visit. The other phases take a clock for each write.
//! 2. The insertion ends when the walk finds that the point equals a corner, or when the last test of a round
//!    finds its edge final.
//!
//! Latency: 1 clock; the phase is a function of registers.

use super::star_state::SoloPhase;
use crate::engine::types::{Slot, Verdict};
use crate::prelude::*;

/// The state of a solo insertion.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum SoloState {
    /// No insertion is at work.
    Idle,
    /// The walk to the record that holds the point.
    Locate,
    /// The writes of the three records that replace it.
    Split,
    /// The visits and writes that mend the links from outside to the second and third record.
    Mend,
    /// The visit that reads the star record at work.
    Fetch,
    /// The visit that tests the record outside.
    Test,
    /// The writes that flip the edge between the two.
    Flip,
}

#[derive(LogicBlock, Default)]
pub struct SoloSteps {
    pub clock: Signal<In, Clock>,
    /// Reset ends the insertion.
    pub reset: Signal<In, Bit>,
    /// An insertion begins; only while none is at work.
    pub starts: Signal<In, Bit>,
    /// A visit completes with this verdict.
    pub done: Signal<In, Bit>,
    pub verdict: Signal<In, Verdict>,
    /// The test is the last one of its round.
    pub is_round: Signal<In, Bit>,
    /// The phase, a bit each; or no insertion is at work (`is_idle`).
    pub phase: Signal<Out, SoloPhase>,
    pub is_idle: Signal<Out, Bit>,
    /// Within the phase, the number of the record, link or write.
    pub step: Signal<Out, Slot>,
    /// The insertion ends at this edge (`ends`), with its point in the mesh (`inserts`) or because the
    /// point is a duplicate.
    pub inserts: Signal<Out, Bit>,
    pub ends: Signal<Out, Bit>,
    state: DFF<SoloState>,
    place: DFF<Slot>,
    rests: Signal<Local, Bit>,
    inserts_now: Signal<Local, Bit>,
    is_locate: Signal<Local, Bit>,
    is_test: Signal<Local, Bit>,
    is_duplicate: Signal<Local, Bit>,
    is_last_step: Signal<Local, Bit>,
    third_step: Signal<Local, Slot>,
    one: Signal<Local, Slot>,
}

impl Logic for SoloSteps {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, place);
        self.one.next = 1.into();
        self.third_step.next = 2.into();
        self.is_locate.next = self.state.q.val() == SoloState::Locate;
        self.is_test.next = self.state.q.val() == SoloState::Test;
        self.is_last_step.next = self.place.q.val() == self.third_step.val();
        self.phase.next.is_locate = self.is_locate.val();
        self.phase.next.is_split = self.state.q.val() == SoloState::Split;
        self.phase.next.is_mend = self.state.q.val() == SoloState::Mend;
        self.phase.next.is_fetch = self.state.q.val() == SoloState::Fetch;
        self.phase.next.is_test = self.is_test.val();
        self.phase.next.is_flip = self.state.q.val() == SoloState::Flip;
        self.is_idle.next = self.state.q.val() == SoloState::Idle;
        self.step.next = self.place.q.val();

        self.is_duplicate.next = self.verdict.val().located & self.verdict.val().falls_onto_corner;
        self.rests.next = self.is_test.val() & self.done.val() & (!self.verdict.val().conflict);
        self.inserts_now.next = self.rests.val() & self.is_round.val();
        self.inserts.next = self.inserts_now.val();
        self.ends.next = self.inserts_now.val() | (self.is_locate.val() & self.done.val() & self.is_duplicate.val());

        match self.state.q.val() {
            SoloState::Locate => {
                self.place.d.next = 0.into();
                if self.done.val() & self.verdict.val().located {
                    self.state.d.next = SoloState::Split;
                }
                if self.done.val() & self.is_duplicate.val() {
                    self.state.d.next = SoloState::Idle;
                }
            }
            SoloState::Split => {
                self.place.d.next = self.place.q.val() + self.one.val();
                if self.is_last_step.val() {
                    self.place.d.next = 0.into();
                    self.state.d.next = SoloState::Mend;
                }
            }
            SoloState::Mend => {
                if self.done.val() {
                    self.place.d.next = 1.into();
                    if self.place.q.val() == self.one.val() {
                        self.state.d.next = SoloState::Fetch;
                    }
                }
            }
            SoloState::Fetch => {
                if self.done.val() {
                    self.state.d.next = SoloState::Test;
                }
            }
            SoloState::Test => {
                self.place.d.next = 0.into();
                if self.done.val() {
                    self.state.d.next = SoloState::Flip;
                }
                if self.rests.val() {
                    self.state.d.next = SoloState::Fetch;
                }
                if self.inserts_now.val() {
                    self.state.d.next = SoloState::Idle;
                }
            }
            SoloState::Flip => {
                self.place.d.next = self.place.q.val() + self.one.val();
                if self.is_last_step.val() {
                    self.state.d.next = SoloState::Test;
                }
            }
            _ => {
                self.state.d.next = SoloState::Idle;
                if self.starts.val() {
                    self.state.d.next = SoloState::Locate;
                }
            }
        }
        if self.reset.val() {
            self.state.d.next = SoloState::Idle;
        }
    }
}
