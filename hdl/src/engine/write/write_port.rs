//! The registered write port of the triangle memory: takes the request of whichever block makes one.
//!
//! 1. Without a request the data are held, and `write.valid` and all `enables` are low.
//! 2. The enables are registers of their own, so that no logic stands between this port and the many block RAMs that it
//!    drives. For the same reason the record's id has two copies, each of which may stand near its RAMs. Reset gives
//!    the copies different values, because synthesis would merge equal registers.
//!
//! Latency: 1 clock; the memory shows the write from the clock after.
//! ```text
//! commit.valid    ___/^^^^^\___________
//! commit.id         .  5  6  .  .  .  .
//! solo.valid      ____________/^^\_____
//! solo.id           .  .  .  .  7  .  .
//! write.valid     ______/^^^^^\__/^^\__
//! write.id          .  .  5  6  .  7  .
//! enables.link1   ______/^^^^^\__/^^\__
//! ```

use crate::engine::types::{Write, WriteEnables};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct WritePort {
    pub clock: Signal<In, Clock>,
    /// Reset drops a write.
    pub reset: Signal<In, Bit>,
    /// Requests, of which at most one is valid: `solo` and `seed` come only while nothing else is at work.
    pub commit: Signal<In, Write>,
    pub solo: Signal<In, Write>,
    pub seed: Signal<In, Write>,
    /// The write that is made at the next edge.
    pub write: Signal<Out, Write>,
    /// The columns that the write concerns, none without a write; and the record's id twice more.
    pub enables: Signal<Out, WriteEnables>,
    port: DFF<Write>,
    enabled: DFF<WriteEnables>,
}

impl Logic for WritePort {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, port, enabled);
        self.write.next = self.port.q.val();
        self.enables.next = self.enabled.q.val();
        self.port.d.next.valid = false;
        self.enabled.d.next.vertices = false;
        self.enabled.d.next.link0 = false;
        self.enabled.d.next.link1 = false;
        self.enabled.d.next.link2 = false;
        if self.seed.val().valid {
            self.port.d.next = self.seed.val();
            self.enabled.d.next.vertices = self.seed.val().vertices;
            self.enabled.d.next.link0 = self.seed.val().link0;
            self.enabled.d.next.link1 = self.seed.val().link1;
            self.enabled.d.next.link2 = self.seed.val().link2;
            self.enabled.d.next.vertices_id = self.seed.val().id;
            self.enabled.d.next.links_id = self.seed.val().id;
        }
        if self.solo.val().valid {
            self.port.d.next = self.solo.val();
            self.enabled.d.next.vertices = self.solo.val().vertices;
            self.enabled.d.next.link0 = self.solo.val().link0;
            self.enabled.d.next.link1 = self.solo.val().link1;
            self.enabled.d.next.link2 = self.solo.val().link2;
            self.enabled.d.next.vertices_id = self.solo.val().id;
            self.enabled.d.next.links_id = self.solo.val().id;
        }
        if self.commit.val().valid {
            self.port.d.next = self.commit.val();
            self.enabled.d.next.vertices = self.commit.val().vertices;
            self.enabled.d.next.link0 = self.commit.val().link0;
            self.enabled.d.next.link1 = self.commit.val().link1;
            self.enabled.d.next.link2 = self.commit.val().link2;
            self.enabled.d.next.vertices_id = self.commit.val().id;
            self.enabled.d.next.links_id = self.commit.val().id;
        }
        if self.reset.val() {
            self.enabled.d.next.vertices = false;
            self.enabled.d.next.link0 = false;
            self.enabled.d.next.link1 = false;
            self.enabled.d.next.link2 = false;
            self.enabled.d.next.vertices_id = 0x7fff.into();
            self.enabled.d.next.links_id = 0x5555.into();
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
