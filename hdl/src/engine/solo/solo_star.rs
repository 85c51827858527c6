//! The star of a point that is inserted alone: the triangle at work, the one outer it, the visits that read both and the writes that
//! change them.
//!
//! 1. The star triangle at work has `p` in slot 0: `v = (p, a, b)`, `n = (outer, after, preceding)`.
//! 2. The second mend makes the split root the star triangle at work; a test without conflict, the one after it.
//! 3. A flip puts the second of its two triangles outer, and leaves the first at work, towards the apex.
//!
//! 4. All inputs that change go into registers first: what is done and the visit are looked at a clock later. The context, the new
//!    vertex, the next new id and the located triangle stand still for longer than that.
//!
//! Latency: 2 clocks from a visit that completes to `write`; `bundle`, `tests` and `flips` are of the clock before.

use super::solo_visit::SoloVisit;
use super::solo_writes::SoloWrites;
use crate::engine::types::{Bundle, Token, Turned, Write};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The star; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct SoloStar {
    /// Reset drops the write.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// What is done; at most one.
    pub is_locate: Signal<In, Bit>,
    pub is_split: Signal<In, Bit>,
    pub is_mend: Signal<In, Bit>,
    pub is_fetch: Signal<In, Bit>,
    pub is_test: Signal<In, Bit>,
    pub is_flip: Signal<In, Bit>,
    /// Which record of the split, link of the mend, write of the flip.
    pub step: Signal<In, Bits<2>>,
    pub owner: Signal<In, Bits<5>>,
    pub p: Signal<In, Bits<15>>,
    pub records: Signal<In, Bits<15>>,
    pub root_id: Signal<In, Bits<15>>,
    pub root: Signal<In, Turned>,
    pub done: Signal<In, Bit>,
    pub token: Signal<In, Token>,
    pub turned: Signal<In, Turned>,
    pub conflict: Signal<In, Bit>,
    /// The visit that is due, if one is.
    pub bundle: Signal<Out, Bundle>,
    /// A test or a flip is finished.
    pub tests: Signal<Out, Bit>,
    pub flips: Signal<Out, Bit>,
    /// The star triangle at work is the last one of the round; looked at when its test completes.
    pub is_round: Signal<Out, Bit>,
    /// A record or a link, registered.
    pub write: Signal<Out, Write>,
    locates: DFF<Bit>,
    splits: DFF<Bit>,
    mends: DFF<Bit>,
    fetches: DFF<Bit>,
    is_testing: DFF<Bit>,
    is_flipping: DFF<Bit>,
    split1: DFF<Bit>,
    split2: DFF<Bit>,
    split3: DFF<Bit>,
    flip1: DFF<Bit>,
    flip2: DFF<Bit>,
    mend1: DFF<Bit>,
    mend2: DFF<Bit>,
    ends_flip: DFF<Bit>,
    comes: DFF<Bit>,
    visited: DFF<Bits<15>>,
    found: DFF<Turned>,
    is_conflict: DFF<Bit>,
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
    /// What is known long before it is asked for.
    is_last: DFF<Bit>,
    third: DFF<Bits<15>>,
    visit: SoloVisit,
    writes: SoloWrites,
    rests: Signal<Local, Bit>,
    is_flipped: Signal<Local, Bit>,
    one: Signal<Local, Bits<2>>,
    first_write: Signal<Local, Bits<2>>,
    last_write: Signal<Local, Bits<2>>,
    is_first: Signal<Local, Bit>,
    is_second: Signal<Local, Bit>,
    is_last_write: Signal<Local, Bit>,
    one_more: Signal<Local, Bits<15>>,
}

impl Logic for SoloStar {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, id, a, b, outer, after, preceding, back);
        dff_setup!(self, clock, apex, apex_after_a, apex_before_b, request, is_last, third);
        dff_setup!(self, clock, locates, splits, mends, fetches, is_testing, is_flipping, ends_flip);
        dff_setup!(self, clock, split1, split2, split3, flip1, flip2, mend1, mend2);
        dff_setup!(self, clock, comes, visited, found, is_conflict);
        self.first_write.next = 0.into();
        self.one.next = 1.into();
        self.last_write.next = 2.into();
        self.is_last_write.next = self.step.val() == self.last_write.val();
        self.one_more.next = 1.into();
        self.is_last.d.next = self.b.q.val() == self.root.val().v1;
        self.third.d.next = self.records.val() + self.one_more.val();
        self.is_round.next = self.is_last.q.val();
        self.write.next = self.request.q.val();

        self.locates.d.next = self.is_locate.val() & (!self.reset.val());
        self.splits.d.next = self.is_split.val() & (!self.reset.val());
        self.mends.d.next = self.is_mend.val() & (!self.reset.val());
        self.fetches.d.next = self.is_fetch.val() & (!self.reset.val());
        self.is_testing.d.next = self.is_test.val() & (!self.reset.val());
        self.is_flipping.d.next = self.is_flip.val() & (!self.reset.val());
        self.is_first.next = self.step.val() == self.first_write.val();
        self.is_second.next = self.step.val() == self.one.val();
        self.split1.d.next = self.is_split.val() & self.is_first.val();
        self.split2.d.next = self.is_split.val() & self.is_second.val();
        self.split3.d.next = self.is_split.val() & self.is_last_write.val();
        self.flip1.d.next = self.is_flip.val() & self.is_first.val();
        self.flip2.d.next = self.is_flip.val() & self.is_second.val();
        self.mend1.d.next = self.is_mend.val() & self.is_first.val();
        self.mend2.d.next = self.is_mend.val() & self.is_second.val();
        self.ends_flip.d.next = self.is_flip.val() & self.is_last_write.val() & (!self.reset.val());
        self.comes.d.next = self.done.val();
        self.visited.d.next = self.token.val().u;
        self.found.d.next = self.turned.val();
        self.is_conflict.d.next = self.conflict.val();
        self.tests.next = self.is_testing.q.val() & self.comes.q.val();
        self.flips.next = self.ends_flip.q.val();

        self.visit.owner.next = self.owner.val();
        self.visit.is_locate.next = self.locates.q.val();
        self.visit.is_mend.next = self.mends.q.val();
        self.visit.is_second.next = self.mend2.q.val();
        self.visit.is_fetch.next = self.fetches.q.val();
        self.visit.root_id.next = self.root_id.val();
        self.visit.root.next = self.root.val();
        self.visit.id.next = self.id.q.val();
        self.visit.outer.next = self.outer.q.val();
        self.visit.back.next = self.back.q.val();
        self.bundle.next = self.visit.bundle.val();

        self.writes.split1.next = self.split1.q.val();
        self.writes.split2.next = self.split2.q.val();
        self.writes.split3.next = self.split3.q.val();
        self.writes.flip1.next = self.flip1.q.val();
        self.writes.flip2.next = self.flip2.q.val();
        self.writes.mend1.next = self.mend1.q.val();
        self.writes.mend2.next = self.mend2.q.val();
        self.writes.is_test.next = self.is_testing.q.val();
        self.writes.p.next = self.p.val();
        self.writes.second.next = self.records.val();
        self.writes.third.next = self.third.q.val();
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
        self.writes.visited.next = self.visited.q.val();
        self.writes.slot.next = self.found.q.val().slot;

        // A link that leads back to the star triangle at work already needs no write.
        self.rests.next = self.is_testing.q.val() & self.comes.q.val() & (!self.is_conflict.q.val());
        self.is_flipped.next = self.back.q.val() != self.id.q.val();
        self.request.d.next = self.writes.write.val();
        self.request.d.next.valid = self.splits.q.val()
            | self.is_flipping.q.val()
            | (self.mends.q.val() & self.comes.q.val())
            | (self.rests.val() & self.is_flipped.val());

        if self.mends.q.val() {
            self.id.d.next = self.root_id.val();
        }
        if self.fetches.q.val() & self.comes.q.val() {
            self.a.d.next = self.found.q.val().v1;
            self.b.d.next = self.found.q.val().v2;
            self.outer.d.next = self.found.q.val().n0;
            self.after.d.next = self.found.q.val().n1;
            self.preceding.d.next = self.found.q.val().n2;
            self.back.d.next = self.id.q.val();
        }
        if self.is_testing.q.val() & self.comes.q.val() {
            self.apex.d.next = self.found.q.val().v0;
            self.apex_after_a.d.next = self.found.q.val().n1;
            self.apex_before_b.d.next = self.found.q.val().n2;
        }
        if self.rests.val() {
            self.id.d.next = self.after.q.val();
        }
        if self.ends_flip.q.val() {
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
