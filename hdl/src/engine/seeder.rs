//! Makes the first triangle and its ghosts out of the first three points.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset`, `clears` | in | 1 | reset and clear forget the first triangle |
//! | `infinite` | in | 15 | the infinite vertex, a constant |
//! | `prepares` | in | 1 | the first point has just come: a record of vertices 0, 1, 2 is written for the look |
//! | `looks`, `verdict` | in | 1, Verdict | the visit that completes is the look at that record for the third point |
//! | `seeded`, `collinear` | out | 1 | the first triangle stands; the first three points are collinear |
//! | `seeds` | out | 1 | the last record is written at this edge |
//! | `is_at_work` | out | 1 | the records are being written |
//! | `write` | out | Write | a record, registered |
//!
//! 1. The look says on which side of vertices 0, 1 the third point lies; collinear points write nothing more.
//!
//! Latency: 4 clocks from the look to `seeds`.
//!
//! Three points that turn left:
//! ```text
//! prepares        /^^\____________________________________________
//! looks           _________/^^\___________________________________
//! is_at_work      ____________/^^^^^^^^^^^\_______________________
//! write.valid     ___/^^\________/^^^^^^^^^^^\____________________
//! write.id          .  0  .  .  .  0  1  2  3  .  .  .  .  .  .  .
//! seeds           _____________________/^^\_______________________
//! seeded          ________________________/^^^^^^^^^^^^^^^^^^^^^^^
//! ```

use super::{SeedWrites, Verdict, Write};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The first triangle; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Seeder {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Forgets the first triangle.
    pub reset: Signal<In, Bit>,
    /// Forgets the first triangle.
    pub clears: Signal<In, Bit>,
    /// The infinite vertex.
    pub infinite: Signal<In, Bits<15>>,
    /// The first point has come.
    pub prepares: Signal<In, Bit>,
    /// The look completes.
    pub looks: Signal<In, Bit>,
    /// What it found out.
    pub verdict: Signal<In, Verdict>,
    /// The first triangle stands.
    pub seeded: Signal<Out, Bit>,
    /// The first three points are collinear.
    pub collinear: Signal<Out, Bit>,
    /// The last record is written.
    pub seeds: Signal<Out, Bit>,
    /// The records are being written.
    pub is_at_work: Signal<Out, Bit>,
    /// A record.
    pub write: Signal<Out, Write>,
    step: DFF<Bits<3>>,
    is_seeded: DFF<Bit>,
    is_collinear: DFF<Bit>,
    turns_left: DFF<Bit>,
    request: DFF<Write>,
    writes: SeedWrites,
    is_writing: Signal<Local, Bit>,
    is_last: Signal<Local, Bit>,
    look_step: Signal<Local, Bits<3>>,
    last_step: Signal<Local, Bits<3>>,
    one: Signal<Local, Bits<3>>,
}

impl Logic for Seeder {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, step, is_seeded, is_collinear, turns_left, request);
        self.look_step.next = 0.into();
        self.last_step.next = 4.into();
        self.one.next = 1.into();
        self.is_writing.next = self.step.q.val() != self.look_step.val();
        self.is_last.next = self.step.q.val() == self.last_step.val();
        self.seeded.next = self.is_seeded.q.val();
        self.collinear.next = self.is_collinear.q.val();
        self.seeds.next = self.is_last.val();
        self.is_at_work.next = self.is_writing.val();

        self.writes.step.next = self.step.q.val();
        self.writes.turns_left.next = self.turns_left.q.val();
        self.writes.infinite.next = self.infinite.val();
        self.request.d.next = self.writes.write.val();
        self.request.d.next.valid = self.is_writing.val() | self.prepares.val();
        self.write.next = self.request.q.val();

        if self.is_writing.val() {
            self.step.d.next = self.step.q.val() + self.one.val();
        }
        if self.is_last.val() {
            self.is_seeded.d.next = true;
            self.step.d.next = 0.into();
        }
        if self.looks.val() {
            self.turns_left.d.next = self.verdict.val().is_left;
            self.is_collinear.d.next = self.verdict.val().is_straight;
            if !self.verdict.val().is_straight {
                self.step.d.next = 1.into();
            }
        }
        if self.clears.val() | self.reset.val() {
            self.is_seeded.d.next = false;
            self.is_collinear.d.next = false;
        }
        if self.reset.val() {
            self.step.d.next = 0.into();
            self.request.d.next.valid = false;
        }
    }
}
