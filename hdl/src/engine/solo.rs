//! Insertion alone, in constant state: splits the located triangle into three, then flips once round the star.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset ends the insertion |
//! | `starts` | in | 1 | no visit is out and no lock held; held until `ends` |
//! | `p`, `records` | in | 15 | the new vertex and the next new id |
//! | `root_id`, `root` | in | 15, Turned | the located triangle |
//! | `done`, `token`, `turned`, `verdict` | in | | the visit that completes |
//! | `push`, `bundle` | out | 1, Bundle | a visit to make |
//! | `write` | out | Write | a record or a link, registered |
//! | `tests`, `flips`, `ends` | out | 1 | a test or a flip is finished, or the insertion, at this edge |
//!
//! 1. Its visits set no locks, and at most one is out.
//! 2. The star triangle at work has `p` in slot 0: `v = (p, a, b)`, `n = (outer, after, preceding)`.
//! 3. While the triangle outside is in conflict, the edge is flipped and the same position is tested again; otherwise the link
//!    that leads back is mended and the next star triangle is taken. It ends where the round began.
//!
//! ```text
//!        apex                  apex
//!        /  \                  /| \            star triangle  (p, a, apex)
//!      a ---- b     ----->    a |  b           flipped        (p, apex, b)
//!        \  /                  \| /
//!         p                     p
//! ```
//! Latency, with `f` flips: `3 f + 8` visits one after the other (2 mends, `f + 3` fetches, `2 f + 3` tests), each a clock more than the
//! visit latency, and `3 f + 4` clocks.
//!
//! Source: Lawson's flips, in the order of the star.

use super::{Bundle, SoloVisit, SoloWrites, Token, Turned, Verdict, Write};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// What an insertion alone does.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum SoloState {
    /// Awaits an insertion.
    Idle,
    /// Writes the three records that replace the root.
    Split,
    /// Mends the links of the outer neighbours of the second and third.
    Mend,
    /// Reads the star triangle at work.
    Fetch,
    /// Tests the triangle outside.
    Test,
    /// Flips the edge between the two.
    Flip,
}

/// Insertion alone; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Solo {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Ends the insertion.
    pub reset: Signal<In, Bit>,
    /// The core is alone.
    pub starts: Signal<In, Bit>,
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
    /// What it found out.
    pub verdict: Signal<In, Verdict>,
    /// A visit to make.
    pub push: Signal<Out, Bit>,
    /// The visit.
    pub bundle: Signal<Out, Bundle>,
    /// A record or a link.
    pub write: Signal<Out, Write>,
    /// A test is finished.
    pub tests: Signal<Out, Bit>,
    /// A flip is finished.
    pub flips: Signal<Out, Bit>,
    /// The insertion is finished.
    pub ends: Signal<Out, Bit>,
    state: DFF<SoloState>,
    step: DFF<Bits<2>>,
    awaits: DFF<Bit>,
    id: DFF<Bits<15>>,
    a: DFF<Bits<15>>,
    b: DFF<Bits<15>>,
    outer: DFF<Bits<15>>,
    after: DFF<Bits<15>>,
    preceding: DFF<Bits<15>>,
    /// The link by which `outer` leads back.
    back: DFF<Bits<15>>,
    apex: DFF<Bits<15>>,
    /// The links of `outer` that the flip hands on.
    apex_after_a: DFF<Bits<15>>,
    apex_before_b: DFF<Bits<15>>,
    request: DFF<Write>,
    visit: SoloVisit,
    writes: SoloWrites,
    is_visiting: Signal<Local, Bit>,
    is_split: Signal<Local, Bit>,
    is_flip: Signal<Local, Bit>,
    is_last_step: Signal<Local, Bit>,
    is_second_mend: Signal<Local, Bit>,
    rests: Signal<Local, Bit>,
    third_step: Signal<Local, Bits<2>>,
    one: Signal<Local, Bits<2>>,
}

impl Logic for Solo {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, step, awaits, id, a, b, outer, after, preceding, back);
        dff_setup!(self, clock, apex, apex_after_a, apex_before_b, request);
        self.one.next = 1.into();
        self.third_step.next = 2.into();
        self.is_second_mend.next = self.step.q.val() == self.one.val();
        self.is_last_step.next = self.step.q.val() == self.third_step.val();

        self.visit.is_mend.next = self.state.q.val() == SoloState::Mend;
        self.visit.is_second.next = self.is_second_mend.val();
        self.visit.is_fetch.next = self.state.q.val() == SoloState::Fetch;
        self.visit.root_id.next = self.root_id.val();
        self.visit.root.next = self.root.val();
        self.visit.id.next = self.id.q.val();
        self.visit.outer.next = self.outer.q.val();
        self.visit.back.next = self.back.q.val();
        self.bundle.next = self.visit.bundle.val();
        self.is_visiting.next = (self.state.q.val() == SoloState::Mend)
            | (self.state.q.val() == SoloState::Fetch)
            | (self.state.q.val() == SoloState::Test);
        self.push.next = self.is_visiting.val() & (!self.awaits.q.val());
        self.awaits.d.next = self.is_visiting.val() & (!self.done.val());

        self.writes.step.next = self.step.q.val();
        self.is_split.next = self.state.q.val() == SoloState::Split;
        self.writes.is_split.next = self.is_split.val();
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
        self.writes.is_mend.next = self.state.q.val() == SoloState::Mend;
        self.writes.is_test.next = self.state.q.val() == SoloState::Test;
        self.writes.visited.next = self.token.val().u;
        self.writes.slot.next = self.turned.val().slot;
        self.write.next = self.request.q.val();
        self.request.d.next.valid = false;

        self.rests.next = (self.state.q.val() == SoloState::Test) & self.done.val() & (!self.verdict.val().conflict);
        self.tests.next = (self.state.q.val() == SoloState::Test) & self.done.val();
        self.is_flip.next = self.state.q.val() == SoloState::Flip;
        self.flips.next = self.is_flip.val() & self.is_last_step.val();
        self.ends.next = self.rests.val() & (self.b.q.val() == self.root.val().v1);

        if self.is_split.val() | self.is_flip.val() {
            self.request.d.next = self.writes.write.val();
            self.step.d.next = self.step.q.val() + self.one.val();
        }
        match self.state.q.val() {
            SoloState::Idle => {
                self.step.d.next = 0.into();
                if self.starts.val() {
                    self.state.d.next = SoloState::Split;
                }
            }
            SoloState::Split => {
                if self.is_last_step.val() {
                    self.step.d.next = 0.into();
                    self.state.d.next = SoloState::Mend;
                }
            }
            SoloState::Mend => {
                if self.done.val() {
                    self.request.d.next = self.writes.write.val();
                    self.step.d.next = 1.into();
                    if self.is_second_mend.val() {
                        self.id.d.next = self.root_id.val();
                        self.state.d.next = SoloState::Fetch;
                    }
                }
            }
            SoloState::Fetch => {
                self.back.d.next = self.id.q.val();
                if self.done.val() {
                    self.a.d.next = self.turned.val().v1;
                    self.b.d.next = self.turned.val().v2;
                    self.outer.d.next = self.turned.val().n0;
                    self.after.d.next = self.turned.val().n1;
                    self.preceding.d.next = self.turned.val().n2;
                    self.state.d.next = SoloState::Test;
                }
            }
            SoloState::Test => {
                self.step.d.next = 0.into();
                self.apex.d.next = self.turned.val().v0;
                self.apex_after_a.d.next = self.turned.val().n1;
                self.apex_before_b.d.next = self.turned.val().n2;
                if self.done.val() & self.verdict.val().conflict {
                    self.state.d.next = SoloState::Flip;
                }
                if self.rests.val() {
                    if self.back.q.val() != self.id.q.val() {
                        self.request.d.next = self.writes.write.val();
                    }
                    self.id.d.next = self.after.q.val();
                    self.state.d.next = SoloState::Fetch;
                    if self.b.q.val() == self.root.val().v1 {
                        self.state.d.next = SoloState::Idle;
                    }
                }
            }
            SoloState::Flip => {
                if self.is_last_step.val() {
                    self.b.d.next = self.apex.q.val();
                    self.after.d.next = self.outer.q.val();
                    self.back.d.next = self.outer.q.val();
                    self.outer.d.next = self.apex_after_a.q.val();
                    self.state.d.next = SoloState::Test;
                }
            }
            _ => {
                self.state.d.next = SoloState::Idle;
            }
        }
        if self.reset.val() {
            self.state.d.next = SoloState::Idle;
            self.awaits.d.next = false;
            self.request.d.next.valid = false;
        }
    }
}
