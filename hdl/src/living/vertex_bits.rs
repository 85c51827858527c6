//! Two bits for each vertex, in block RAM: whether the vertex is in use, and whether ids of records are kept for it.
//!
//! 1. After a clear the first two vertices are marked as in use, one a clock (`is_seeding`). All other bits are
//!    arbitrary until they are written.
//! 2. A vertex of an `Insert`, or of a change that has ended, has the write port first, and at most one of `marks` and
//!    `unmarks` is high. In such a clock (`is_taken`) nothing else is written, and the other port waits.
//! 3. The second bit of a vertex in use is arbitrary: both bits are written together, and a vertex that falls out of
//!    use comes with its second bit. So one block RAM is enough.
//!
//! Latency: 2 clocks from `asked` to its bits.

use crate::engine::types::VertexId;
use crate::leaf::BlockMemory;
use crate::prelude::*;
use incircle_protocol::{vertex_id_bits, Config};

#[derive(LogicBlock, Default)]
pub struct VertexBits {
    pub clock: Signal<In, Clock>,
    /// After a reset and after a clear, the first two vertices are in use.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// A vertex comes into use; or falls out of use, and has ids that are kept for it or not (`unmarked_owns`).
    pub marks: Signal<In, Bit>,
    pub marked: Signal<In, VertexId>,
    pub unmarks: Signal<In, Bit>,
    pub unmarked: Signal<In, VertexId>,
    pub unmarked_owns: Signal<In, Bit>,
    /// The write port is taken by these, or the first two vertices are still to be marked.
    pub is_taken: Signal<Out, Bit>,
    pub is_seeding: Signal<Out, Bit>,
    /// A vertex, and its bits two clocks later.
    pub asked: Signal<In, VertexId>,
    pub is_used: Signal<Out, Bit>,
    pub has_ids: Signal<Out, Bit>,
    /// A vertex whose bits are written, unless the port is taken: it is in use, or if not, `owns` ids or not.
    pub writes: Signal<In, Bit>,
    pub written: Signal<In, VertexId>,
    pub used: Signal<In, Bit>,
    pub owns: Signal<In, Bit>,
    /// Bit 0: the vertex is in use. Bit 1: ids are kept for it.
    bits: BlockMemory<15, 2>,
    /// Number of vertices that are still to be marked after a clear.
    seeding: DFF<Bits<2>>,
    taken: Signal<Local, Bit>,
    seed: Signal<Local, Bits<2>>,
    one: Signal<Local, Bits<2>>,
}

impl VertexBits {
    /// The bits of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        Self { bits: BlockMemory::new(vertex_id_bits(config.points) as usize - 1, 2), ..Self::default() }
    }
}

impl Logic for VertexBits {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, seeding);
        clock!(self, clock, bits);
        self.one.next = 1.into();
        self.taken.next = self.marks.val() | self.unmarks.val();
        self.is_taken.next = self.taken.val();
        self.is_seeding.next = self.seeding.q.val().any();
        self.bits.read_address.next = self.asked.val();
        self.is_used.next = self.bits.read_data.val().get_bit(0);
        self.has_ids.next = self.bits.read_data.val().get_bit(1);

        self.bits.write_address.next = self.written.val();
        self.bits.write_enable.next = self.writes.val();
        self.bits.write_data.next = 0.into();
        if self.owns.val() {
            self.bits.write_data.next = 2.into();
        }
        if self.used.val() {
            self.bits.write_data.next = 1.into();
        }
        self.seed.next = self.seeding.q.val() - self.one.val();
        if self.seeding.q.val().any() {
            self.bits.write_address.next = bit_cast::<15, 2>(self.seed.val());
            self.bits.write_data.next = 1.into();
            self.bits.write_enable.next = true;
            if !self.taken.val() {
                self.seeding.d.next = self.seed.val();
            }
        }
        if self.unmarks.val() {
            self.bits.write_address.next = self.unmarked.val();
            self.bits.write_data.next = 0.into();
            if self.unmarked_owns.val() {
                self.bits.write_data.next = 2.into();
            }
            self.bits.write_enable.next = true;
        }
        if self.marks.val() {
            self.bits.write_address.next = self.marked.val();
            self.bits.write_data.next = 1.into();
            self.bits.write_enable.next = true;
        }
        if self.reset.val() | self.clears.val() {
            self.seeding.d.next = 2.into();
        }
    }
}
