//! The registered push port of the visit pipeline: passes on the visits of whichever block asks for some.
//!
//! 1. Three sources ask: the completed visit, a context that starts, and a solo insertion. No context starts in a clock
//!    in which the completed visit may ask, and a solo insertion asks only while no other context works. So at most one
//!    source asks at a time.
//! 2. The bundle is chosen by `may_ask` and `solo_is_at_work`, which are known sooner than `asks` and `valid`. The long
//!    path of a verdict then ends at one bit instead of a whole bundle.
//!
//! Latency: 1 clock from a request to `push`.
//! ```text
//! asks            ___/^^\______________
//! may_ask         ___/^^^^^\___________
//! follows.record    .  5  .  .  .  .  .
//! starts          _________/^^\________
//! record            .  .  .  6  .  .  .
//! solo_is_at_work ____________/^^^^^\__
//! solo_asks       _______________/^^\__
//! solo.record       .  .  .  .  .  7  .
//! push            ______/^^\__/^^\__/^^
//! bundle.record     .  .  5  .  6  .  7
//! ```

use crate::engine::types::{Bundle, Follow, Push, Start};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct PushPort {
    pub clock: Signal<In, Clock>,
    /// Reset drops the visits in the port.
    pub reset: Signal<In, Bit>,
    /// The visits that follow a completed visit.
    pub follow: Signal<In, Follow>,
    /// A context that starts to walk.
    pub start: Signal<In, Start>,
    /// A solo insertion is at work; `solo` is the visit that it asks for.
    pub solo_is_at_work: Signal<In, Bit>,
    pub solo: Signal<In, Push>,
    /// In a core that answers questions, and only while the insertion engine rests: a question asks for the visit.
    pub question_asks: Vec<Signal<In, Bit>>,
    pub question: Vec<Signal<In, Bundle>>,
    pub push: Signal<Out, Push>,
    pushes: DFF<Bit>,
    pushed: DFF<Bundle>,
}

impl PushPort {
    /// The port of a core that answers questions.
    pub fn with_runs() -> Self {
        Self { question_asks: vec![Signal::default()], question: vec![Signal::default()], ..Self::default() }
    }
}

impl Logic for PushPort {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, pushes, pushed);
        self.push.next.valid = self.pushes.q.val();
        self.push.next.bundle = self.pushed.q.val();
        self.pushes.d.next = self.follow.val().asks | self.start.val().valid | self.solo.val().valid;
        self.pushed.d.next = self.follow.val().bundle;
        if !self.follow.val().may_ask {
            self.pushed.d.next.is_pair = false;
            self.pushed.d.next.is_triple = false;
            self.pushed.d.next.context = self.start.val().context;
            self.pushed.d.next.rotates = false;
            self.pushed.d.next.locks = false;
            self.pushed.d.next.record = self.start.val().record;
        }
        if self.solo_is_at_work.val() {
            self.pushed.d.next = self.solo.val().bundle;
        }
        for i in 0..self.question.len() {
            if self.question_asks[i].val() {
                self.pushes.d.next = true;
                self.pushed.d.next = self.question[i].val();
            }
        }
        if self.reset.val() {
            self.pushes.d.next = false;
        }
    }
}
