//! Leaves free records out of the payload of a `Triangles`, and passes over those before the first record that is
//! asked for: records are numbered without the free ones.
//!
//! 1. Records come in the order of their ids, from id 0 on, until as many have come as the payload has.
//!
//! Latency: none from a record to `counts`.

use super::types::RecordCount;
use crate::engine::types::VertexId;
use crate::mesh::Record;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct LivingReads {
    pub clock: Signal<In, Clock>,
    pub infinite: Signal<In, VertexId>,
    /// A payload of `count` records begins, from the record of number `first` on.
    pub starts: Signal<In, Bit>,
    pub first: Signal<In, RecordCount>,
    pub count: Signal<In, RecordCount>,
    /// A record comes, and belongs to the payload (`counts`); some are still to come (`some_are_left`).
    pub comes: Signal<In, Bit>,
    pub record: Signal<In, Record>,
    pub counts: Signal<Out, Bit>,
    pub some_are_left: Signal<Out, Bit>,
    left: DFF<RecordCount>,
    passed: DFF<RecordCount>,
    is_free: Signal<Local, Bit>,
    lives: Signal<Local, Bit>,
    passes: Signal<Local, Bit>,
    one: Signal<Local, RecordCount>,
}

impl Logic for LivingReads {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, left, passed);
        self.one.next = 1.into();
        self.is_free.next = (self.record.val().v0 == self.infinite.val())
            & (self.record.val().v1 == self.infinite.val())
            & (self.record.val().v2 == self.infinite.val());
        self.some_are_left.next = self.left.q.val().any();
        self.lives.next = self.comes.val() & (!self.is_free.val()) & self.left.q.val().any();
        self.passes.next = self.passed.q.val().any();
        self.counts.next = self.lives.val() & (!self.passes.val());
        if self.lives.val() & self.passes.val() {
            self.passed.d.next = self.passed.q.val() - self.one.val();
        }
        if self.lives.val() & (!self.passes.val()) {
            self.left.d.next = self.left.q.val() - self.one.val();
        }
        if self.starts.val() {
            self.left.d.next = self.count.val();
            self.passed.d.next = self.first.val();
        }
    }
}
