//! The records of the first triangle and its ghosts.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `step` | in | 3 | 0: vertices 0, 1, 2 as they came, for the look which way they turn; 1: the triangle; 2 to 4: the ghosts |
//! | `turns_left` | in | 1 | they turn left |
//! | `infinite` | in | 15 | the infinite vertex |
//! | `write` | out | Write | the record |
//!
//! With `b = 1`, `c = 2` if they turn left and the other way round if not:
//! ```text
//! id  v              n          behind the hull edge
//! 0   (0, b, c)      1, 2, 3
//! 1   (c, b, inf)    3, 2, 0    b -> c
//! 2   (0, c, inf)    1, 3, 0    c -> 0
//! 3   (b, 0, inf)    2, 1, 0    0 -> b
//! ```
//! Latency: none (combinational).

use super::{RecordWrite, Write};
use rust_hdl_core::prelude::*;

/// The first records; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct SeedWrites {
    /// Which record.
    pub step: Signal<In, Bits<3>>,
    /// The first three points turn left.
    pub turns_left: Signal<In, Bit>,
    /// The infinite vertex.
    pub infinite: Signal<In, Bits<15>>,
    /// The record.
    pub write: Signal<Out, Write>,
    record: RecordWrite,
    b: Signal<Local, Bits<15>>,
    c: Signal<Local, Bits<15>>,
    is_look: Signal<Local, Bit>,
    is_triangle: Signal<Local, Bit>,
    is_ghost1: Signal<Local, Bit>,
    is_ghost2: Signal<Local, Bit>,
    look_step: Signal<Local, Bits<3>>,
    triangle_step: Signal<Local, Bits<3>>,
    ghost1_step: Signal<Local, Bits<3>>,
    ghost2_step: Signal<Local, Bits<3>>,
}

impl Logic for SeedWrites {
    #[hdl_gen]
    fn update(&mut self) {
        self.look_step.next = 0.into();
        self.triangle_step.next = 1.into();
        self.ghost1_step.next = 2.into();
        self.ghost2_step.next = 3.into();
        self.is_look.next = self.step.val() == self.look_step.val();
        self.is_triangle.next = self.step.val() == self.triangle_step.val();
        self.is_ghost1.next = self.step.val() == self.ghost1_step.val();
        self.is_ghost2.next = self.step.val() == self.ghost2_step.val();
        self.b.next = 2.into();
        self.c.next = 1.into();
        if self.turns_left.val() | self.is_look.val() {
            self.b.next = 1.into();
            self.c.next = 2.into();
        }

        // The last ghost, unless another record is asked for.
        self.record.id.next = 3.into();
        self.record.v0.next = self.b.val();
        self.record.v1.next = 0.into();
        self.record.v2.next = self.infinite.val();
        self.record.n0.next = 2.into();
        self.record.n1.next = 1.into();
        self.record.n2.next = 0.into();
        if self.is_ghost2.val() {
            self.record.id.next = 2.into();
            self.record.v0.next = 0.into();
            self.record.v1.next = self.c.val();
            self.record.n0.next = 1.into();
            self.record.n1.next = 3.into();
        }
        if self.is_ghost1.val() {
            self.record.id.next = 1.into();
            self.record.v0.next = self.c.val();
            self.record.v1.next = self.b.val();
            self.record.n0.next = 3.into();
            self.record.n1.next = 2.into();
        }
        if self.is_triangle.val() | self.is_look.val() {
            self.record.id.next = 0.into();
            self.record.v0.next = 0.into();
            self.record.v1.next = self.b.val();
            self.record.v2.next = self.c.val();
            self.record.n0.next = 1.into();
            self.record.n1.next = 2.into();
            self.record.n2.next = 3.into();
        }
        if self.is_look.val() {
            self.record.n0.next = 0.into();
            self.record.n1.next = 0.into();
            self.record.n2.next = 0.into();
        }
        self.write.next = self.record.write.val();
    }
}
