//! The records of a first triangle and its ghost triangles.
//!
//! Let `a` be the first vertex, `b = a + 1` and `c = a + 2` if the three turn left, otherwise `b` and `c` the other way
//! round. With ids that count from the first record:
//! ```text
//! id  v              n          behind the hull edge
//! 0   (a, b, c)      1, 2, 3
//! 1   (c, b, inf)    3, 2, 0    b -> c
//! 2   (a, c, inf)    1, 3, 0    c -> a
//! 3   (b, a, inf)    2, 1, 0    a -> b
//! ```
//! Latency: none, the block is combinational.

use crate::engine::types::Write;
use crate::engine::write::RecordWrite;
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct SeedWrites {
    /// The record to write. 0: the vertices as they came, for the look at which way they turn; 1: the triangle; 2 to
    /// 4: the ghost triangles.
    pub step: Signal<In, Bits<3>>,
    /// The first of the three vertices; and the first of the four records, a multiple of 4.
    pub first_vertex: Signal<In, Bits<15>>,
    pub first_record: Signal<In, Bits<15>>,
    /// The three vertices turn left.
    pub turns_left: Signal<In, Bit>,
    /// The number of the infinite vertex.
    pub infinite: Signal<In, Bits<15>>,
    /// The record to write.
    pub write: Signal<Out, Write>,
    record: RecordWrite,
    a: Signal<Local, Bits<15>>,
    b: Signal<Local, Bits<15>>,
    c: Signal<Local, Bits<15>>,
    second: Signal<Local, Bits<15>>,
    third: Signal<Local, Bits<15>>,
    id0: Signal<Local, Bits<15>>,
    id1: Signal<Local, Bits<15>>,
    id2: Signal<Local, Bits<15>>,
    id3: Signal<Local, Bits<15>>,
    is_look: Signal<Local, Bit>,
    is_triangle: Signal<Local, Bit>,
    is_ghost1: Signal<Local, Bit>,
    is_ghost2: Signal<Local, Bit>,
    look_step: Signal<Local, Bits<3>>,
    triangle_step: Signal<Local, Bits<3>>,
    ghost1_step: Signal<Local, Bits<3>>,
    ghost2_step: Signal<Local, Bits<3>>,
    one: Signal<Local, Bits<15>>,
    two: Signal<Local, Bits<15>>,
    three: Signal<Local, Bits<15>>,
}

impl Logic for SeedWrites {
    #[hdl_gen]
    fn update(&mut self) {
        self.look_step.next = 0.into();
        self.triangle_step.next = 1.into();
        self.ghost1_step.next = 2.into();
        self.ghost2_step.next = 3.into();
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.three.next = 3.into();
        self.is_look.next = self.step.val() == self.look_step.val();
        self.is_triangle.next = self.step.val() == self.triangle_step.val();
        self.is_ghost1.next = self.step.val() == self.ghost1_step.val();
        self.is_ghost2.next = self.step.val() == self.ghost2_step.val();
        self.a.next = self.first_vertex.val();
        self.second.next = self.first_vertex.val() + self.one.val();
        self.third.next = self.first_vertex.val() + self.two.val();
        self.b.next = self.third.val();
        self.c.next = self.second.val();
        if self.turns_left.val() | self.is_look.val() {
            self.b.next = self.second.val();
            self.c.next = self.third.val();
        }
        self.id0.next = self.first_record.val();
        self.id1.next = self.first_record.val() | self.one.val();
        self.id2.next = self.first_record.val() | self.two.val();
        self.id3.next = self.first_record.val() | self.three.val();

        // The last ghost triangle is the default, so that the other cases change only what differs.
        self.record.id.next = self.id3.val();
        self.record.v0.next = self.b.val();
        self.record.v1.next = self.a.val();
        self.record.v2.next = self.infinite.val();
        self.record.n0.next = self.id2.val();
        self.record.n1.next = self.id1.val();
        self.record.n2.next = self.id0.val();
        if self.is_ghost2.val() {
            self.record.id.next = self.id2.val();
            self.record.v0.next = self.a.val();
            self.record.v1.next = self.c.val();
            self.record.n0.next = self.id1.val();
            self.record.n1.next = self.id3.val();
        }
        if self.is_ghost1.val() {
            self.record.id.next = self.id1.val();
            self.record.v0.next = self.c.val();
            self.record.v1.next = self.b.val();
            self.record.n0.next = self.id3.val();
            self.record.n1.next = self.id2.val();
        }
        if self.is_triangle.val() | self.is_look.val() {
            self.record.id.next = self.id0.val();
            self.record.v0.next = self.a.val();
            self.record.v1.next = self.b.val();
            self.record.v2.next = self.c.val();
            self.record.n0.next = self.id1.val();
            self.record.n1.next = self.id2.val();
            self.record.n2.next = self.id3.val();
        }
        if self.is_look.val() {
            self.record.n0.next = self.id0.val();
            self.record.n1.next = self.id0.val();
            self.record.n2.next = self.id0.val();
        }
        self.write.next = self.record.write.val();
    }
}
