//! The visits that follow a completed visit.
//!
//! 1. If a root visit or a test met no foreign lock, `bundle` holds the visits that follow when the cavity opens or the
//!    tested record joins it. For every other visit `bundle` holds the same visit again, except that `walks_on` changes
//!    its record and `locates` lets it take the lock.
//!
//! ```text
//!           c                         c
//!          / \                       ^ \
//!         /   \       split       X /   \ Y       X = (a -> c), Y = (c -> b), both with u behind them
//!        /  u  \     ------->      /     v
//!       a ----> b                 a       b
//!           p                         p
//! ```
//! Latency: 1 clock from the early inputs; none from the others.
//!
//! A walk goes on at record 6, a root opens the cavity, and a test of entry 4 passes and allocates entry 9:
//! ```text
//! early.record           5  6  7  .  .
//! early.n1               .  1  8  .  .
//! walks_on             ___/^^\________
//! bundle.record          .  6  0  8  .
//! bundle.is_pair       ______/^^^^^\__
//! bundle.cavity_record   .  .  6  7  .
//! bundle.entry           .  .  0  4  .
//! bundle.after           .  .  1  9  .
//! ```

use crate::engine::types::{Bundle, Case, RingEntry, TriangleId, Turned, Visit};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct NextVisits {
    pub clock: Signal<In, Clock>,
    /// The visit that completes in the next clock, with its record.
    pub early_visit: Signal<In, Visit>,
    pub early_turned: Signal<In, Turned>,
    /// The case of the visit that completes in this clock.
    pub found: Signal<In, Case>,
    /// The neighbour to which the walk goes on.
    pub walk_next: Signal<In, TriangleId>,
    /// The entry that a test allocates if the tested record joins the cavity.
    pub entry: Signal<In, RingEntry>,
    /// The visits that the completed visit asks for, if it asks for any.
    pub bundle: Signal<Out, Bundle>,
    /// The part of the bundle that is known a clock ahead.
    prepared: DFF<Bundle>,
    halves: DFF<Bit>,
    opens: Signal<Local, Bit>,
    splits: Signal<Local, Bit>,
}

impl Logic for NextVisits {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, prepared, halves);
        self.opens.next =
            (!self.early_visit.val().rotates) & self.early_visit.val().locks & (!self.early_turned.val().foreign);
        self.splits.next = self.early_visit.val().rotates & (!self.early_turned.val().foreign);

        // A revisit is the default, so that only the fields of the other cases need a choice.
        self.prepared.d.next.is_pair = self.opens.val() | self.splits.val();
        self.prepared.d.next.is_triple = self.opens.val();
        self.prepared.d.next.context = self.early_visit.val().context;
        self.prepared.d.next.rotates = self.early_visit.val().rotates | self.opens.val();
        self.prepared.d.next.locks = self.early_visit.val().locks;
        self.prepared.d.next.entry = self.early_visit.val().entry;
        self.prepared.d.next.after = self.early_visit.val().after;
        self.prepared.d.next.cavity_entry = self.early_visit.val().cavity_entry;
        self.prepared.d.next.cavity_record = self.early_visit.val().cavity_record;
        self.prepared.d.next.record = self.early_visit.val().record;
        self.prepared.d.next.second_after = self.early_visit.val().after;
        self.prepared.d.next.second_record = self.early_turned.val().n2;
        self.prepared.d.next.third_record = self.early_turned.val().n2;
        if self.splits.val() {
            self.prepared.d.next.cavity_record = self.early_visit.val().record;
            self.prepared.d.next.record = self.early_turned.val().n1;
        }
        if self.opens.val() {
            self.prepared.d.next.entry = 0.into();
            self.prepared.d.next.after = 1.into();
            self.prepared.d.next.cavity_entry = 0.into();
            self.prepared.d.next.cavity_record = self.early_visit.val().record;
            self.prepared.d.next.record = self.early_turned.val().n0;
            self.prepared.d.next.second_after = 2.into();
            self.prepared.d.next.second_record = self.early_turned.val().n1;
        }
        self.halves.d.next = self.splits.val();

        // `found`, `walk_next` and `entry` come late in the clock, so only a few fields depend on them.
        self.bundle.next = self.prepared.q.val();
        // L5: the walk saw the root without a lock, so the same record is visited again, this time under its lock.
        if self.found.val().locates {
            self.bundle.next.locks = true;
        }
        if self.found.val().walks_on {
            self.bundle.next.record = self.walk_next.val();
        }
        if self.halves.q.val() {
            self.bundle.next.after = self.entry.val();
            self.bundle.next.cavity_entry = self.entry.val();
        }
    }
}
