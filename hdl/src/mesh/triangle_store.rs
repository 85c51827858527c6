//! The triangle records, with a memory for each column, so that one neighbour can be written alone, and with a
//! lock for each record.
//!
//! 1. A read sees every write of an earlier edge. A record that is read and written at the same edge comes out torn:
//!    every column that is written is arbitrary. A walk may do that, and must visit the record again. A visit that
//!    takes or holds the lock cannot, because only the holder writes.
//! 2. A lock is taken whether or not the record is torn. A clear may meet any visit at a lock.
//!
//! Latency: 2 clocks from `read_id` to the columns and `was_set`, 3 to `took` and `foreign`.
//!
//! A write of record 5, then of its neighbour 1 alone; three reads of the record, the second of which takes its lock:
//! ```text
//! vertex columns  /^^\____________________
//! link column 1   /^^^^^\_________________
//! write.n1          8  9  .  .  .  .  .  .
//! read_id           .  .  5  5  5  .  .  .
//! read_locks      _________/^^\___________
//! v0                .  .  .  .  7  7  7  .
//! n1                .  .  .  .  9  9  9  .
//! took              ._______________/^^\__
//! was_set           .  .  .  .______/^^  .
//! ```
//!
//! Source: Cline and Renka's triangle-based structure, with three vertices and three neighbours for each triangle.

use super::lock_store::LockStore;
use super::record::Record;
use crate::engine::types::{ContextId, LockClear, TriangleId, Write, WriteEnables};
use crate::leaf::BlockMemory;
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct TriangleStore {
    pub clock: Signal<In, Clock>,
    /// A record, or some of its neighbours, to write at this edge; `enables` alone says which columns and at which id.
    pub write: Signal<In, Write>,
    pub enables: Signal<In, WriteEnables>,
    /// Id of the record to read, separately for its lock, its vertices and its neighbours.
    pub read_id: Signal<In, TriangleId>,
    pub vertices_id: Signal<In, TriangleId>,
    pub links_id: Signal<In, TriangleId>,
    /// The visit wants the lock at this edge, for this context.
    pub read_locks: Signal<In, Bit>,
    pub context_id: Signal<In, ContextId>,
    /// The record, with its lock as it was before the visit.
    pub record: Signal<Out, Record>,
    /// The outcome for the lock, a clock after the record; see `LockStore`.
    pub took: Signal<Out, Bit>,
    pub foreign: Signal<Out, Bit>,
    /// A lock to clear at this edge.
    pub clear: Signal<In, LockClear>,
    vertices: [BlockMemory<15, 15>; 3],
    links: [BlockMemory<15, 15>; 3],
    locks: LockStore,
}

impl TriangleStore {
    /// Number of clocks from `read_id` to the record.
    pub const LATENCY: usize = BlockMemory::<15, 15>::LATENCY;

    /// A store of `2^id_bits` records whose vertices have ids of `vertex_bits` bits, for `2^context_bits` contexts.
    pub fn new(id_bits: usize, vertex_bits: usize, context_bits: usize) -> Self {
        Self {
            vertices: [(); 3].map(|()| BlockMemory::new(id_bits, vertex_bits)),
            links: [(); 3].map(|()| BlockMemory::new(id_bits, id_bits)),
            locks: LockStore::new(id_bits, context_bits),
            ..Self::default()
        }
    }
}

impl Logic for TriangleStore {
    #[hdl_gen]
    fn update(&mut self) {
        for i in 0..3 {
            self.vertices[i].clock.next = self.clock.val();
            self.vertices[i].read_address.next = self.vertices_id.val();
            self.vertices[i].write_address.next = self.enables.val().vertices_id;
            self.vertices[i].write_enable.next = self.enables.val().vertices;
            self.links[i].clock.next = self.clock.val();
            self.links[i].read_address.next = self.links_id.val();
            self.links[i].write_address.next = self.enables.val().links_id;
        }
        self.vertices[0].write_data.next = self.write.val().v0;
        self.vertices[1].write_data.next = self.write.val().v1;
        self.vertices[2].write_data.next = self.write.val().v2;
        self.links[0].write_data.next = self.write.val().n0;
        self.links[1].write_data.next = self.write.val().n1;
        self.links[2].write_data.next = self.write.val().n2;
        self.links[0].write_enable.next = self.enables.val().link0;
        self.links[1].write_enable.next = self.enables.val().link1;
        self.links[2].write_enable.next = self.enables.val().link2;
        self.record.next.v0 = self.vertices[0].read_data.val();
        self.record.next.v1 = self.vertices[1].read_data.val();
        self.record.next.v2 = self.vertices[2].read_data.val();
        self.record.next.n0 = self.links[0].read_data.val();
        self.record.next.n1 = self.links[1].read_data.val();
        self.record.next.n2 = self.links[2].read_data.val();
        self.record.next.was_set = self.locks.was_set.val();
        self.locks.clock.next = self.clock.val();
        self.locks.id.next = self.read_id.val();
        self.locks.takes.next = self.read_locks.val();
        self.locks.context_id.next = self.context_id.val();
        self.locks.clear.next = self.clear.val();
        self.took.next = self.locks.took.val();
        self.foreign.next = self.locks.foreign.val();
    }
}
