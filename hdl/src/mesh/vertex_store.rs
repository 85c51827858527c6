//! The coordinates of the vertices, in three copies, so that the three of a record can be read at once.
//!
//! 1. The infinite vertex has no coordinates. Reading them gives an arbitrary word, on which no decision depends.
//! 2. Writes and fetches share a port of the first copy, so that fetches do not cost a fourth copy. A fetch at an edge
//!    with a write gives an arbitrary word.
//!
//! Latency: 2 clocks from an id to its coordinates.
//! ```text
//! write_enable    /^^\___________
//! write_id          3  .  .  .  .
//! write_position   42  .  .  .  .
//! id0               .  3  .  .  .
//! fetch_id          .  .  3  .  .
//! position0         .  .  . 42  .
//! fetched           .  .  .  . 42
//! ```

use crate::engine::types::{Arrival, VertexId};
use crate::leaf::{BlockMemory, SharedMemory};
use crate::predicate::{Corners, Point};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct VertexStore {
    pub clock: Signal<In, Clock>,
    /// A vertex to write at this edge; its point has x in the low half and y in the high half.
    pub write: Signal<In, Arrival>,
    /// Ids of the three vertices to read.
    pub id0: Signal<In, VertexId>,
    pub id1: Signal<In, VertexId>,
    pub id2: Signal<In, VertexId>,
    /// Coordinates of the three vertices, 2 clocks later.
    pub corners: Signal<Out, Corners>,
    /// Id of another vertex to fetch, at an edge without a write.
    pub fetch_id: Signal<In, VertexId>,
    /// Coordinates of the fetched vertex, 2 clocks later.
    pub fetched: Signal<Out, Point>,
    first_copy: SharedMemory<15, 32>,
    copies: [BlockMemory<15, 32>; 2],
}

impl VertexStore {
    /// Number of clocks from an id to its coordinates.
    pub const LATENCY: usize = BlockMemory::<15, 32>::LATENCY;

    /// A store of `2^id_bits` vertices.
    pub fn new(id_bits: usize) -> Self {
        Self {
            first_copy: SharedMemory::new(id_bits, 32),
            copies: [(); 2].map(|()| BlockMemory::new(id_bits, 32)),
            ..Self::default()
        }
    }
}

impl Logic for VertexStore {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, first_copy);
        self.first_copy.read_address.next = self.id0.val();
        self.first_copy.write_data.next = self.write.val().point;
        self.first_copy.write_enable.next = self.write.val().came;
        self.first_copy.shared_address.next = self.fetch_id.val();
        if self.write.val().came {
            self.first_copy.shared_address.next = self.write.val().id;
        }
        for i in 0..2 {
            self.copies[i].clock.next = self.clock.val();
            self.copies[i].write_address.next = self.write.val().id;
            self.copies[i].write_data.next = self.write.val().point;
            self.copies[i].write_enable.next = self.write.val().came;
        }
        self.copies[0].read_address.next = self.id1.val();
        self.copies[1].read_address.next = self.id2.val();
        self.corners.next.r0 = self.first_copy.read_data.val();
        self.corners.next.r1 = self.copies[0].read_data.val();
        self.corners.next.r2 = self.copies[1].read_data.val();
        self.fetched.next = self.first_copy.shared_data.val();
    }
}
