//! The registered push port of the visit pipeline: takes the visits of whoever asks for some.
//!
//! 1. Who asks also may ask. Nobody starts in a clock in which a visit may ask, and only the insertion alone asks while it is at work.
//!    So each bundle is chosen by what is known soonest.
//!
//! Latency: 1 clock.
//! ```text
//! asks            ___/^^\______________
//! may_ask         ___/^^^^^\___________
//! follows.u         .  5  .  .  .  .  .
//! starts          _________/^^\________
//! u                 .  .  .  6  .  .  .
//! is_alone        ____________/^^^^^\__
//! solo_asks       _______________/^^\__
//! solo.u            .  .  .  .  .  7  .
//! push            ______/^^\__/^^\__/^^
//! bundle.u          .  .  5  .  6  .  7
//! ```

use crate::engine::types::Bundle;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The push port; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct PushPort {
    /// Reset drops the visits.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// A visit that completes asks for these; it may.
    pub asks: Signal<In, Bit>,
    pub may_ask: Signal<In, Bit>,
    pub follows: Signal<In, Bundle>,
    /// A context starts to walk at this record.
    pub starts: Signal<In, Bit>,
    pub starter: Signal<In, Bits<5>>,
    pub u: Signal<In, Bits<15>>,
    /// An insertion alone is at work; it asks for this visit.
    pub is_alone: Signal<In, Bit>,
    pub solo_asks: Signal<In, Bit>,
    pub solo: Signal<In, Bundle>,
    /// The visits to make.
    pub push: Signal<Out, Bit>,
    pub bundle: Signal<Out, Bundle>,
    pushes: DFF<Bit>,
    pushed: DFF<Bundle>,
}

impl Logic for PushPort {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, pushes, pushed);
        self.push.next = self.pushes.q.val();
        self.bundle.next = self.pushed.q.val();
        self.pushes.d.next = self.asks.val() | self.starts.val() | self.solo_asks.val();
        self.pushed.d.next = self.follows.val();
        if !self.may_ask.val() {
            self.pushed.d.next.is_pair = false;
            self.pushed.d.next.is_triple = false;
            self.pushed.d.next.owner = self.starter.val();
            self.pushed.d.next.rotates = false;
            self.pushed.d.next.locks = false;
            self.pushed.d.next.u = self.u.val();
        }
        if self.is_alone.val() {
            self.pushed.d.next = self.solo.val();
        }
        if self.reset.val() {
            self.pushes.d.next = false;
        }
    }
}
