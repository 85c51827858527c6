//! Counts the vertices that deletions have taken away, and the records that are free.
//!
//! 1. The records of a `Triangles` and of the insert report are those that are not free; a `Read` goes by ids.
//!
//! Latency: 1 clock from an event; none from `records` and `insertions`.

use super::types::{RecordCount, Word};
use crate::prelude::*;
use incircle_protocol::Opcode;

#[derive(LogicBlock, Default)]
pub struct LivingTally {
    pub clock: Signal<In, Clock>,
    /// Reset and clear forget the mesh.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// A vertex is deleted; or a vertex takes the ids that were kept for it.
    pub deletes: Signal<In, Bit>,
    pub returns: Signal<In, Bit>,
    /// Number of ids of records that have been used, and of insertions.
    pub records: Signal<In, RecordCount>,
    pub insertions: Signal<In, Word>,
    /// The command; the records that it may name; all that are not free; and the vertices.
    pub opcode: Signal<In, Bits<8>>,
    pub bound: Signal<Out, RecordCount>,
    pub living: Signal<Out, RecordCount>,
    pub vertices: Signal<Out, Word>,
    deleted: DFF<Word>,
    /// Number of records that are free.
    free: DFF<RecordCount>,
    one: Signal<Local, Word>,
    two: Signal<Local, RecordCount>,
    none: Signal<Local, RecordCount>,
    triangles_code: Signal<Local, Bits<8>>,
}

// The kernel holds the opcode as a literal, because rust-hdl allows no constants there.
const _: () = assert!(Opcode::Triangles as u8 == 7, "the opcode of this block follows the protocol");

impl Logic for LivingTally {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, deleted, free);
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.none.next = 0.into();
        self.triangles_code.next = 7.into();
        self.living.next = self.records.val() - self.free.q.val();
        self.bound.next = self.records.val();
        if self.opcode.val() == self.triangles_code.val() {
            self.bound.next = self.records.val() - self.free.q.val();
        }
        self.vertices.next = self.insertions.val() - self.deleted.q.val();
        if self.deletes.val() {
            self.deleted.d.next = self.deleted.q.val() + self.one.val();
        }
        if self.deletes.val() & (!self.returns.val()) {
            self.free.d.next = self.free.q.val() + self.two.val();
        }
        if self.returns.val() & (!self.deletes.val()) {
            self.free.d.next = self.free.q.val() - self.two.val();
        }
        if self.reset.val() | self.clears.val() {
            self.deleted.d.next = 0.into();
            self.free.d.next = self.none.val();
        }
    }
}
