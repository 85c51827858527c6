//! The registered write port of the triangle memory: takes the request of whichever block makes one.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset drops a write |
//! | `commit`, `solo`, `seed` | in | Write | requests; at most one is valid: the last two come only while nothing else is at work |
//! | `write` | out | Write | the write made at the next edge |
//!
//! 1. Without a request the data are held and `write.valid` is low.
//!
//! Latency: 1 clock; the memory shows the write from the clock after.
//! ```text
//! commit.valid    ___/^^^^^\___________
//! commit.id         .  5  6  .  .  .  .
//! solo.valid      ____________/^^\_____
//! solo.id           .  .  .  .  7  .  .
//! write.valid     ______/^^^^^\__/^^\__
//! write.id          .  .  5  6  .  7  .
//! ```

use super::Write;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The write port; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct WritePort {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Drops a write.
    pub reset: Signal<In, Bit>,
    /// Request of the commit.
    pub commit: Signal<In, Write>,
    /// Request of an insertion alone.
    pub solo: Signal<In, Write>,
    /// Request of the first triangle.
    pub seed: Signal<In, Write>,
    /// The write.
    pub write: Signal<Out, Write>,
    port: DFF<Write>,
}

impl Logic for WritePort {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, port);
        self.write.next = self.port.q.val();
        self.port.d.next.valid = false;
        if self.seed.val().valid {
            self.port.d.next = self.seed.val();
        }
        if self.solo.val().valid {
            self.port.d.next = self.solo.val();
        }
        if self.commit.val().valid {
            self.port.d.next = self.commit.val();
        }
        if self.reset.val() {
            self.port.d.next.valid = false;
            self.port.d.next.id = 0.into();
            self.port.d.next.vertices = false;
            self.port.d.next.link0 = false;
            self.port.d.next.link1 = false;
            self.port.d.next.link2 = false;
            self.port.d.next.v0 = 0.into();
            self.port.d.next.v1 = 0.into();
            self.port.d.next.v2 = 0.into();
            self.port.d.next.n0 = 0.into();
            self.port.d.next.n1 = 0.into();
            self.port.d.next.n2 = 0.into();
        }
    }
}
