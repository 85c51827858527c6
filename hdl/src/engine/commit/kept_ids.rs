//! The ids of two free records for each vertex that has been deleted. A vertex that comes back takes them again, so a
//! mesh of `n` vertices has exactly `2 n - 2` records that are not free.
//!
//! 1. Whether ids are kept for the vertex of a context comes with its item (`owns`). A vertex that a context takes
//!    without an item has none. The next item of a context may begin before the ring of this one is read, so a ring
//!    that is handed over takes the flag along.
//! 2. The ids of a ring are read while its first entries come to the head, and those of a solo insertion while it
//!    locates its point.
//!
//! Latency: 2 clocks from a vertex to its ids.

use crate::engine::types::{
    context_bits, CommitJob, CommitRequest, ContextId, KeptWrite, SoloStart, Start, TriangleId, VertexId, CONTEXT_BITS,
    TRIANGLE_BITS, VERTEX_BITS,
};
use crate::leaf::{BlockMemory, LutMemory};
use crate::prelude::*;
use incircle_protocol::{vertex_id_bits, Config};

/// Width of two ids in bits.
const PAIR_BITS: usize = 2 * TRIANGLE_BITS;

#[derive(LogicBlock, Default)]
pub struct KeptIds {
    pub clock: Signal<In, Clock>,
    /// A context that starts and may take a vertex at this edge; ids are kept for that vertex.
    pub start: Signal<In, Start>,
    pub owns: Signal<In, Bit>,
    /// Ids that a vertex keeps from now on.
    pub kept: Signal<In, KeptWrite>,
    /// A ring is handed over.
    pub commit: Signal<In, CommitRequest>,
    /// The ring whose first entry is at the head or on its way there; it is taken at this edge (`loads`); and it takes
    /// a new id (`takes`), which is `id` if it `has_ids`.
    pub job: Signal<In, CommitJob>,
    pub loads: Signal<In, Bit>,
    pub takes: Signal<In, Bit>,
    pub has_ids: Signal<Out, Bit>,
    pub id: Signal<Out, TriangleId>,
    /// A solo insertion starts, or is at work; its ids, if it `solo_has_ids`.
    pub solo_start: Signal<In, SoloStart>,
    pub solo_is_at_work: Signal<In, Bit>,
    pub solo_has_ids: Signal<Out, Bit>,
    pub solo_first: Signal<Out, TriangleId>,
    pub solo_second: Signal<Out, TriangleId>,
    pairs: BlockMemory<VERTEX_BITS, PAIR_BITS>,
    keepers: LutMemory<CONTEXT_BITS, 1>,
    handed: LutMemory<CONTEXT_BITS, 1>,
    handed_job: Signal<Local, CommitJob>,
    solo_vertex: DFF<VertexId>,
    solo_context: DFF<ContextId>,
    /// A solo insertion has started one clock ago: that it is at work shows a clock later.
    has_started: DFF<Bit>,
    starts: Signal<Local, Bit>,
    pair: DFF<Bits<PAIR_BITS>>,
    owned: DFF<Bit>,
    is_second: DFF<Bit>,
    first: Signal<Local, Bits<PAIR_BITS>>,
    second: Signal<Local, Bits<PAIR_BITS>>,
    shift: Signal<Local, Bits<PAIR_BITS>>,
}

impl KeptIds {
    pub fn new(config: Config) -> Self {
        Self {
            pairs: BlockMemory::new(vertex_id_bits(config.points) as usize - 1, PAIR_BITS),
            keepers: LutMemory::new(context_bits(config), 1),
            handed: LutMemory::new(context_bits(config), 1),
            ..Self::default()
        }
    }
}

impl Logic for KeptIds {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, solo_vertex, solo_context, has_started, pair, owned, is_second);
        clock!(self, clock, pairs, keepers, handed);
        self.handed_job.next = self.commit.val().job;
        self.shift.next = 15.into();
        self.first.next = bit_cast::<PAIR_BITS, 15>(self.kept.val().first);
        self.second.next = bit_cast::<PAIR_BITS, 15>(self.kept.val().second);
        self.pairs.write_address.next = self.kept.val().vertex;
        self.pairs.write_data.next = self.first.val() | (self.second.val() << self.shift.val());
        self.pairs.write_enable.next = self.kept.val().valid;
        self.keepers.write_address.next = self.start.val().context;
        self.keepers.write_data.next = 0.into();
        if self.owns.val() {
            self.keepers.write_data.next = 1.into();
        }
        self.keepers.write_enable.next = self.start.val().takes;

        self.starts.next = self.solo_start.val().valid & (!self.solo_is_at_work.val()) & (!self.has_started.q.val());
        self.has_started.d.next = self.starts.val();
        if self.starts.val() {
            self.solo_vertex.d.next = self.solo_start.val().vertex;
            self.solo_context.d.next = self.solo_start.val().context;
        }
        self.pairs.read_address.next = self.job.val().vertex;
        self.keepers.read_address.next = self.handed_job.val().context;
        self.handed.write_address.next = self.handed_job.val().context;
        self.handed.write_data.next = self.keepers.read_data.val();
        self.handed.write_enable.next = self.commit.val().valid;
        self.handed.read_address.next = self.job.val().context;
        if self.solo_is_at_work.val() {
            self.pairs.read_address.next = self.solo_vertex.q.val();
            self.keepers.read_address.next = self.solo_context.q.val();
        }
        self.solo_has_ids.next = self.keepers.read_data.val().any();
        self.solo_first.next = self.pairs.read_data.val().get_bits::<15>(0);
        self.solo_second.next = self.pairs.read_data.val().get_bits::<15>(15);

        self.has_ids.next = self.owned.q.val();
        self.id.next = self.pair.q.val().get_bits::<15>(0);
        if self.is_second.q.val() {
            self.id.next = self.pair.q.val().get_bits::<15>(15);
        }
        if self.takes.val() {
            self.is_second.d.next = true;
        }
        if self.loads.val() {
            self.pair.d.next = self.pairs.read_data.val();
            self.owned.d.next = self.handed.read_data.val().any();
            self.is_second.d.next = false;
        }
    }
}
