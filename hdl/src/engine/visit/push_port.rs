//! The registered push port of the visit pipeline: takes the visits of whoever asks for some.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset drops the visits |
//! | `asks`, `may_ask`, `follows` | in | 1, 1, Bundle | a visit that completes asks for these; it may |
//! | `starts`, `starter`, `u` | in | 1, 5, 15 | a context starts to walk at this record |
//! | `is_alone`, `solo_asks`, `solo` | in | 1, 1, Bundle | an insertion alone is at work; it asks for this visit |
//! | `push`, `bundle` | out | 1, Bundle | the visits to make |
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
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Drops the visits.
    pub reset: Signal<In, Bit>,
    /// A visit that completes asks for others.
    pub asks: Signal<In, Bit>,
    /// It may.
    pub may_ask: Signal<In, Bit>,
    /// They.
    pub follows: Signal<In, Bundle>,
    /// A context starts to walk.
    pub starts: Signal<In, Bit>,
    /// Which.
    pub starter: Signal<In, Bits<5>>,
    /// Where.
    pub u: Signal<In, Bits<15>>,
    /// An insertion alone is at work.
    pub is_alone: Signal<In, Bit>,
    /// It asks for a visit.
    pub solo_asks: Signal<In, Bit>,
    /// The visit.
    pub solo: Signal<In, Bundle>,
    /// There are visits to make.
    pub push: Signal<Out, Bit>,
    /// They.
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
