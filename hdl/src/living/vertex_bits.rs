//! Two bits for each vertex, in block RAM: whether the vertex is in use, and whether ids of records are kept for it.
//!
//! 1. After a clear the first two vertices are marked as in use, one a clock (`is_seeding`). All other bits are
//!    arbitrary until they are written.
//! 2. A vertex of an `Insert`, or of a change that has ended, has the write port first, and at most one of `marks` and
//!    `unmarks` is high. In such a clock (`is_taken`) nothing else is written, and the other port waits.
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
    /// A vertex comes into use, and loses its ids if it `disowns` them; or falls out of use.
    pub marks: Signal<In, Bit>,
    pub marked: Signal<In, VertexId>,
    pub disowns: Signal<In, Bit>,
    pub unmarks: Signal<In, Bit>,
    pub unmarked: Signal<In, VertexId>,
    /// The write port is taken by these, or the first two vertices are still to be marked.
    pub is_taken: Signal<Out, Bit>,
    pub is_seeding: Signal<Out, Bit>,
    /// A vertex, and its bits two clocks later.
    pub asked: Signal<In, VertexId>,
    pub is_used: Signal<Out, Bit>,
    pub has_ids: Signal<Out, Bit>,
    /// A vertex whose first bit is written, unless the port is taken; and its second bit too (`writes_ids`).
    pub writes: Signal<In, Bit>,
    pub written: Signal<In, VertexId>,
    pub used: Signal<In, Bit>,
    pub writes_ids: Signal<In, Bit>,
    pub owns: Signal<In, Bit>,
    in_use: BlockMemory<15, 1>,
    keepers: BlockMemory<15, 1>,
    /// Number of vertices that are still to be marked after a clear.
    seeding: DFF<Bits<2>>,
    taken: Signal<Local, Bit>,
    seeds: Signal<Local, Bit>,
    seed: Signal<Local, Bits<2>>,
    one: Signal<Local, Bits<2>>,
}

impl VertexBits {
    /// The bits of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        let bits = |of: Config| BlockMemory::new(vertex_id_bits(of.points) as usize - 1, 1);
        Self { in_use: bits(config), keepers: bits(config), ..Self::default() }
    }
}

impl Logic for VertexBits {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, seeding);
        clock!(self, clock, in_use, keepers);
        self.one.next = 1.into();
        self.taken.next = self.marks.val() | self.unmarks.val();
        self.is_taken.next = self.taken.val();
        self.is_seeding.next = self.seeding.q.val().any();
        self.in_use.read_address.next = self.asked.val();
        self.keepers.read_address.next = self.asked.val();
        self.is_used.next = self.in_use.read_data.val().any();
        self.has_ids.next = self.keepers.read_data.val().any();

        self.in_use.write_address.next = self.unmarked.val();
        self.in_use.write_data.next = 0.into();
        self.in_use.write_enable.next = self.unmarks.val();
        self.keepers.write_address.next = self.marked.val();
        self.keepers.write_data.next = 0.into();
        self.keepers.write_enable.next = self.marks.val() & self.disowns.val();
        if self.marks.val() {
            self.in_use.write_address.next = self.marked.val();
            self.in_use.write_data.next = 1.into();
            self.in_use.write_enable.next = true;
        }
        self.seed.next = self.seeding.q.val() - self.one.val();
        self.seeds.next = self.seeding.q.val().any() & (!self.taken.val());
        if self.seeds.val() {
            self.in_use.write_address.next = bit_cast::<15, 2>(self.seed.val());
            self.in_use.write_data.next = 1.into();
            self.in_use.write_enable.next = true;
            self.keepers.write_address.next = bit_cast::<15, 2>(self.seed.val());
            self.keepers.write_enable.next = true;
            self.seeding.d.next = self.seed.val();
        }
        if self.writes.val() & (!self.taken.val()) {
            self.in_use.write_address.next = self.written.val();
            if self.used.val() {
                self.in_use.write_data.next = 1.into();
            }
            self.in_use.write_enable.next = true;
            self.keepers.write_address.next = self.written.val();
            if self.owns.val() {
                self.keepers.write_data.next = 1.into();
            }
            self.keepers.write_enable.next = self.writes_ids.val();
        }
        if self.reset.val() | self.clears.val() {
            self.seeding.d.next = 2.into();
        }
    }
}
