//! The star of a point that is inserted alone: the triangle at work, the one outer it, the visits that read both and the writes that
//! change them.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset drops the write |
//! | `is_locate`, `is_split`, `is_mend`, `is_fetch`, `is_test`, `is_flip` | in | 1 | what is done; at most one |
//! | `step` | in | 2 | which record of the split, link of the mend, write of the flip |
//! | `is_last_flip` | in | 1 | the last write of the flip is made |
//! | `owner`, `p`, `records`, `root_id`, `root` | in | | the context, the new vertex, the next new id, the located triangle |
//! | `done`, `token`, `turned`, `conflict` | in | | the visit that completes |
//! | `bundle` | out | Bundle | the visit that is due, if one is |
//! | `is_round` | out | 1 | the star triangle at work is the last one of the round |
//! | `write` | out | Write | a record or a link, registered |
//!
//! 1. The star triangle at work has `p` in slot 0: `v = (p, a, b)`, `n = (outer, after, preceding)`.
//! 2. The second mend makes the split root the star triangle at work; a test without conflict, the one after it.
//! 3. A flip puts the second of its two triangles outer, and leaves the first at work, towards the apex.
//!
//! Latency: 1 clock.

use super::{Bundle, SoloVisit, SoloWrites, Token, Turned, Write};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The star; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct SoloStar {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Drops the write.
    pub reset: Signal<In, Bit>,
    /// The context.
    pub owner: Signal<In, Bits<5>>,
    /// The point is located.
    pub is_locate: Signal<In, Bit>,
    /// The root is split.
    pub is_split: Signal<In, Bit>,
    /// The outer neighbours learn of the split.
    pub is_mend: Signal<In, Bit>,
    /// The star triangle at work is read.
    pub is_fetch: Signal<In, Bit>,
    /// The triangle outer is tested.
    pub is_test: Signal<In, Bit>,
    /// The edge between the two is flipped.
    pub is_flip: Signal<In, Bit>,
    /// Which of the writes.
    pub step: Signal<In, Bits<2>>,
    /// The flip is finished.
    pub is_last_flip: Signal<In, Bit>,
    /// The new vertex.
    pub p: Signal<In, Bits<15>>,
    /// The next new id.
    pub records: Signal<In, Bits<15>>,
    /// The located triangle.
    pub root_id: Signal<In, Bits<15>>,
    /// Its record.
    pub root: Signal<In, Turned>,
    /// A visit completes.
    pub done: Signal<In, Bit>,
    /// The visit.
    pub token: Signal<In, Token>,
    /// Its record.
    pub turned: Signal<In, Turned>,
    /// The triangle outer is in conflict.
    pub conflict: Signal<In, Bit>,
    /// The visit that is due.
    pub bundle: Signal<Out, Bundle>,
    /// The round ends here.
    pub is_round: Signal<Out, Bit>,
    /// A record or a link.
    pub write: Signal<Out, Write>,
    id: DFF<Bits<15>>,
    a: DFF<Bits<15>>,
    b: DFF<Bits<15>>,
    outer: DFF<Bits<15>>,
    after: DFF<Bits<15>>,
    preceding: DFF<Bits<15>>,
    /// The link by which `outer` leads back.
    back: DFF<Bits<15>>,
    apex: DFF<Bits<15>>,
    /// The links of the triangle outer that the flip hands on.
    apex_after_a: DFF<Bits<15>>,
    apex_before_b: DFF<Bits<15>>,
    request: DFF<Write>,
    visit: SoloVisit,
    writes: SoloWrites,
    rests: Signal<Local, Bit>,
    is_flipped: Signal<Local, Bit>,
    one: Signal<Local, Bits<2>>,
}

impl Logic for SoloStar {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, id, a, b, outer, after, preceding, back);
        dff_setup!(self, clock, apex, apex_after_a, apex_before_b, request);
        self.one.next = 1.into();
        self.is_round.next = self.b.q.val() == self.root.val().v1;
        self.write.next = self.request.q.val();

        self.visit.owner.next = self.owner.val();
        self.visit.is_locate.next = self.is_locate.val();
        self.visit.is_mend.next = self.is_mend.val();
        self.visit.is_second.next = self.step.val() == self.one.val();
        self.visit.is_fetch.next = self.is_fetch.val();
        self.visit.root_id.next = self.root_id.val();
        self.visit.root.next = self.root.val();
        self.visit.id.next = self.id.q.val();
        self.visit.outer.next = self.outer.q.val();
        self.visit.back.next = self.back.q.val();
        self.bundle.next = self.visit.bundle.val();

        self.writes.is_split.next = self.is_split.val();
        self.writes.is_mend.next = self.is_mend.val();
        self.writes.is_test.next = self.is_test.val();
        self.writes.step.next = self.step.val();
        self.writes.p.next = self.p.val();
        self.writes.records.next = self.records.val();
        self.writes.root_id.next = self.root_id.val();
        self.writes.root.next = self.root.val();
        self.writes.id.next = self.id.q.val();
        self.writes.a.next = self.a.q.val();
        self.writes.b.next = self.b.q.val();
        self.writes.outer.next = self.outer.q.val();
        self.writes.after.next = self.after.q.val();
        self.writes.preceding.next = self.preceding.q.val();
        self.writes.apex.next = self.apex.q.val();
        self.writes.apex_after_a.next = self.apex_after_a.q.val();
        self.writes.apex_before_b.next = self.apex_before_b.q.val();
        self.writes.visited.next = self.token.val().u;
        self.writes.slot.next = self.turned.val().slot;

        // A link that leads back to the star triangle at work already needs no write.
        self.rests.next = self.is_test.val() & self.done.val() & (!self.conflict.val());
        self.is_flipped.next = self.back.q.val() != self.id.q.val();
        self.request.d.next = self.writes.write.val();
        self.request.d.next.valid = self.is_split.val()
            | self.is_flip.val()
            | (self.is_mend.val() & self.done.val())
            | (self.rests.val() & self.is_flipped.val());

        if self.is_mend.val() {
            self.id.d.next = self.root_id.val();
        }
        if self.is_fetch.val() & self.done.val() {
            self.a.d.next = self.turned.val().v1;
            self.b.d.next = self.turned.val().v2;
            self.outer.d.next = self.turned.val().n0;
            self.after.d.next = self.turned.val().n1;
            self.preceding.d.next = self.turned.val().n2;
            self.back.d.next = self.id.q.val();
        }
        if self.is_test.val() & self.done.val() {
            self.apex.d.next = self.turned.val().v0;
            self.apex_after_a.d.next = self.turned.val().n1;
            self.apex_before_b.d.next = self.turned.val().n2;
        }
        if self.rests.val() {
            self.id.d.next = self.after.q.val();
        }
        if self.is_last_flip.val() {
            self.b.d.next = self.apex.q.val();
            self.after.d.next = self.outer.q.val();
            self.back.d.next = self.outer.q.val();
            self.outer.d.next = self.apex_after_a.q.val();
        }
        if self.reset.val() {
            self.request.d.next.valid = false;
        }
    }
}
