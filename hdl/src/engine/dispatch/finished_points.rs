//! Counts the points that are finished, and says when nothing is left to do.
//!
//! 1. Two points may be finished in one clock: one by a commit or a solo insertion, and a duplicate.
//! 2. Fewer than three points, or three collinear ones, are never finished. Then nothing is left to do as soon as no
//!    visit is in flight.
//! 3. A finished point is noted at its edge, counted at the next and compared at the third, but `arrived` is compared
//!    at once. In the clock after a point has come `is_quiet` may be out of date, but no command reads `is_quiet` then.
//!
//! Latency: 3 clocks from a finished point to `is_quiet`, 1 from `arrived`, none from the other inputs.
//!
//! Three points come and make the first triangle. Then two more come, one of them a duplicate:
//! ```text
//! arrived           0  1  2  3  3  3  3  3  3  4  5  5  5  5  5  5
//! all_rest        /^^^^^^^^^^^\_____/^^^^^^^^^^^^^^\________/^^^^^
//! has_no_start    /^^^^^^^^^^^\___________________________________
//! seeds           _____________________/^^\_______________________
//! commit_ends     ____________________________________/^^\________
//! duplicate       ____________________________________/^^\________
//! finishes        _____________________/^^\___________/^^\________
//! is_quiet        /^^^^^^^^^^^\________________________________/^^
//! ```

use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct FinishedPoints {
    pub clock: Signal<In, Clock>,
    /// Reset and clear set the count to zero.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// The number of points that have come.
    pub arrived: Signal<In, Bits<15>>,
    /// A first triangle is complete: three points are finished.
    pub seeds: Signal<In, Bit>,
    /// A commit is complete, a solo insertion has ended, or a duplicate is found: each finishes a point.
    pub commit_ends: Signal<In, Bit>,
    pub solo_ends: Signal<In, Bit>,
    pub duplicate: Signal<In, Bit>,
    /// No first triangle is being made, because the points that have come are too few or collinear.
    pub has_no_start: Signal<In, Bit>,
    /// No visit is in flight and no lock is held.
    pub all_rest: Signal<In, Bit>,
    /// Every point is finished or never will be, and no insertion is at work.
    pub is_quiet: Signal<Out, Bit>,
    /// A point is finished at this edge.
    pub finishes: Signal<Out, Bit>,
    /// In a core with changes: the mesh has been changed, so that all points come as items, which are not counted here;
    /// and some point of an `Insert` is not finished.
    pub has_changed: Vec<Signal<In, Bit>>,
    pub is_pending: Vec<Signal<In, Bit>>,
    finished: DFF<Bits<15>>,
    /// The number of points that were finished at the last edge.
    more: DFF<Bits<2>>,
    is_behind: DFF<Bit>,
    inserts: Signal<Local, Bit>,
    wide_more: Signal<Local, Bits<15>>,
}

impl FinishedPoints {
    /// The block of a core with changes.
    pub fn with_changes() -> Self {
        Self { has_changed: vec![Signal::default()], is_pending: vec![Signal::default()], ..Self::default() }
    }
}

impl Logic for FinishedPoints {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, finished, more, is_behind);
        self.inserts.next = self.commit_ends.val() | self.solo_ends.val();
        self.finishes.next = self.inserts.val() | self.duplicate.val() | self.seeds.val();

        self.is_behind.d.next = self.finished.q.val() != self.arrived.val();
        for i in 0..self.has_changed.len() {
            if self.has_changed[i].val() {
                self.is_behind.d.next = self.is_pending[i].val();
            }
        }
        self.is_quiet.next = ((!self.is_behind.q.val()) | self.has_no_start.val()) & self.all_rest.val();

        self.more.d.next = 0.into();
        if self.inserts.val() | self.duplicate.val() {
            self.more.d.next = 1.into();
        }
        if self.inserts.val() & self.duplicate.val() {
            self.more.d.next = 2.into();
        }
        if self.seeds.val() {
            self.more.d.next = 3.into();
        }
        self.wide_more.next = bit_cast::<15, 2>(self.more.q.val());
        self.finished.d.next = self.finished.q.val() + self.wide_more.val();
        if self.reset.val() | self.clears.val() {
            self.more.d.next = 0.into();
            self.finished.d.next = 0.into();
        }
        if self.reset.val() {
            self.is_behind.d.next = false;
        }
    }
}
