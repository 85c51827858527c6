//! The coordinates of the vertices, in three copies so that a triangle's three are read at once.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock` | in | 1 | everything happens at its rising edge |
//! | `write_id`, `write_position`, `write_enable` | in | 15, 32, 1 | a vertex written at this edge: x in the low half, y in the high |
//! | `id0..id2` | in | 15 | vertices to read |
//! | `position0..position2` | out | 32 | their coordinates |
//!
//! 1. The infinite vertex has no coordinates: reading it gives an arbitrary word that decides nothing.
//!
//! Latency: 2 clocks from an id to its coordinates.
//! ```text
//! write_enable    /^^\___________
//! write_id          3  .  .  .  .
//! write_position   42  .  .  .  .
//! id0               .  3  .  .  .
//! position0         .  .  . 42  .
//! ```

use crate::leaf::BlockMemory;
use rust_hdl_core::prelude::*;

/// The vertex memory; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct VertexStore {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Vertex to write.
    pub write_id: Signal<In, Bits<15>>,
    /// Its coordinates.
    pub write_position: Signal<In, Bits<32>>,
    /// Write at this edge.
    pub write_enable: Signal<In, Bit>,
    /// First vertex to read.
    pub id0: Signal<In, Bits<15>>,
    /// Second.
    pub id1: Signal<In, Bits<15>>,
    /// Third.
    pub id2: Signal<In, Bits<15>>,
    /// Coordinates of the first.
    pub position0: Signal<Out, Bits<32>>,
    /// Of the second.
    pub position1: Signal<Out, Bits<32>>,
    /// Of the third.
    pub position2: Signal<Out, Bits<32>>,
    copies: [BlockMemory<15, 32>; 3],
}

impl VertexStore {
    /// Clocks from an id to its coordinates.
    pub const LATENCY: usize = BlockMemory::<15, 32>::LATENCY;

    /// A store of `2^id_bits` vertices.
    pub fn new(id_bits: usize) -> Self {
        Self { copies: [(); 3].map(|()| BlockMemory::new(id_bits, 32)), ..Self::default() }
    }
}

impl Logic for VertexStore {
    #[hdl_gen]
    fn update(&mut self) {
        for i in 0..3 {
            self.copies[i].clock.next = self.clock.val();
            self.copies[i].write_address.next = self.write_id.val();
            self.copies[i].write_data.next = self.write_position.val();
            self.copies[i].write_enable.next = self.write_enable.val();
        }
        self.copies[0].read_address.next = self.id0.val();
        self.copies[1].read_address.next = self.id1.val();
        self.copies[2].read_address.next = self.id2.val();
        self.position0.next = self.copies[0].read_data.val();
        self.position1.next = self.copies[1].read_data.val();
        self.position2.next = self.copies[2].read_data.val();
    }
}
