//! Counts the points that are finished, and says when there is nothing left to do.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset`, `clears` | in | 1 | reset and clear set the count to zero |
//! | `arrived` | in | 15 | points that have come |
//! | `seeds` | in | 1 | the first triangle stands: three points are finished |
//! | `commit_ends`, `solo_ends`, `duplicate` | in | 1 | a point is finished each |
//! | `collinear`, `is_seeding` | in | 1 | the first three points are collinear; their records are being written |
//! | `all_rest` | in | 1 | no visit is out and no lock held |
//! | `is_quiet` | out | 1 | every point is finished or will never be, and nothing is at work |
//! | `finishes` | out | 1 | a point is finished at this edge |
//!
//! 1. Two points may be finished in one clock: one by a commit or alone, and a duplicate.
//! 2. Fewer than three points, or three collinear ones, are never finished: then there is nothing left to do as soon as no visit is
//!    out, unless the first records are being written.
//!
//! Latency: 1 clock to the count; none from the other inputs.
//!
//! Three points come and make the first triangle. Two more come, of which one is a duplicate:
//! ```text
//! arrived           0  1  2  3  3  3  3  3  3  4  5  5  5  5  5  5
//! all_rest        /^^^^^^^^^^^\_____/^^^^^^^^^^^^^^\________/^^^^^
//! is_seeding      __________________/^^^^^\_______________________
//! seeds           _____________________/^^\_______________________
//! commit_ends     ____________________________________/^^\________
//! duplicate       ____________________________________/^^\________
//! finishes        _____________________/^^\___________/^^\________
//! is_quiet        /^^^^^^^^\______________/^^\______________/^^^^^
//! ```

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Finished points; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Progress {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Zero.
    pub reset: Signal<In, Bit>,
    /// Zero.
    pub clears: Signal<In, Bit>,
    /// Points that have come.
    pub arrived: Signal<In, Bits<15>>,
    /// Three points are finished.
    pub seeds: Signal<In, Bit>,
    /// A point is finished.
    pub commit_ends: Signal<In, Bit>,
    /// A point is finished.
    pub solo_ends: Signal<In, Bit>,
    /// A point is finished.
    pub duplicate: Signal<In, Bit>,
    /// There will be no triangle.
    pub collinear: Signal<In, Bit>,
    /// The first records are being written.
    pub is_seeding: Signal<In, Bit>,
    /// No visit is out, no lock held.
    pub all_rest: Signal<In, Bit>,
    /// Nothing is left to do.
    pub is_quiet: Signal<Out, Bit>,
    /// A point is finished.
    pub finishes: Signal<Out, Bit>,
    finished: DFF<Bits<15>>,
    inserts: Signal<Local, Bit>,
    all_are_finished: Signal<Local, Bit>,
    is_too_few: Signal<Local, Bit>,
    has_no_start: Signal<Local, Bit>,
    by_commit: Signal<Local, Bits<15>>,
    by_duplicate: Signal<Local, Bits<15>>,
    with_commit: Signal<Local, Bits<15>>,
    three: Signal<Local, Bits<15>>,
}

impl Logic for Progress {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, finished);
        self.three.next = 3.into();
        self.inserts.next = self.commit_ends.val() | self.solo_ends.val();
        self.finishes.next = self.inserts.val() | self.duplicate.val() | self.seeds.val();

        self.all_are_finished.next = self.finished.q.val() == self.arrived.val();
        self.is_too_few.next = self.arrived.val() < self.three.val();
        self.has_no_start.next = (self.is_too_few.val() | self.collinear.val()) & (!self.is_seeding.val());
        self.is_quiet.next = (self.all_are_finished.val() | self.has_no_start.val()) & self.all_rest.val();

        // A commit and a duplicate may end in one clock.
        self.by_commit.next = 0.into();
        self.by_duplicate.next = 0.into();
        if self.inserts.val() {
            self.by_commit.next = 1.into();
        }
        if self.duplicate.val() {
            self.by_duplicate.next = 1.into();
        }
        self.with_commit.next = self.finished.q.val() + self.by_commit.val();
        self.finished.d.next = self.with_commit.val() + self.by_duplicate.val();
        if self.seeds.val() {
            self.finished.d.next = 3.into();
        }
        if self.reset.val() | self.clears.val() {
            self.finished.d.next = 0.into();
        }
    }
}
