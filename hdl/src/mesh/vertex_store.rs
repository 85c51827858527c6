//! The coordinates of the vertices, in three copies so that a triangle's three are read at once.
//!
//! 1. The infinite vertex has no coordinates: reading it gives an arbitrary word that decides nothing.
//! 2. Writes and fetches share a port of the first copy, so that a fetch costs no fourth copy. What is fetched at an edge with a
//!    write is arbitrary.
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

/// The vertex memory; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct VertexStore {
    pub clock: Signal<In, Clock>,
    /// A vertex written at this edge: x in the low half, y in the high.
    pub write: Signal<In, Arrival>,
    /// Vertices to read.
    pub id0: Signal<In, VertexId>,
    pub id1: Signal<In, VertexId>,
    pub id2: Signal<In, VertexId>,
    /// Their coordinates.
    pub corners: Signal<Out, Corners>,
    /// Another vertex to read, at an edge without a write.
    pub fetch_id: Signal<In, VertexId>,
    /// Its coordinates.
    pub fetched: Signal<Out, Point>,
    first_copy: SharedMemory<15, 32>,
    copies: [BlockMemory<15, 32>; 2],
}

impl VertexStore {
    /// Clocks from an id to its coordinates.
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
