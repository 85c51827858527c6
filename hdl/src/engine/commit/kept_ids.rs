//! The ids of two free records for each vertex that has been deleted. A vertex that comes back takes them again, so a
//! mesh of `n` vertices has exactly `2 n - 2` records that are not free.
//!
//! 1. They need no memory of their own: they stand in the place of the point of the deleted vertex, which nobody reads.
//!    `first` has the low 15 bits of that word, and `second` the next 15.
//! 2. The check of an item that inserts the vertex fetches them, before the point of the item is stored. The item
//!    brings them to its context (`owns`, and `moving.target`), which has them until its ring is handed over. Whether
//!    ids are kept for the vertex of a context comes with them. A vertex that a context takes without an item has none.
//! 3. A vertex that moves comes back in the run in which it is put out of the mesh. Its ids go from its hole to its
//!    context at once.
//! 4. If the vertex does not come into the mesh, because its point is that of another one, its ids go back to the place
//!    of its point (`late_point`), and so do those of a deletion.
//! 5. The next item of a context may begin before the ring of this one is read, so a ring that is handed over takes its
//!    ids along. No other ring of the context is handed over before the first entry of this one is read (L6).
//!
//! Latency: none (combinational) from an event to `late_point`, and from the context of a solo insertion to its ids.

use crate::engine::types::{
    context_bits, Arrival, CommitJob, CommitRequest, ContextId, KeptWrite, Moving, SoloProgress, SoloStart, Start,
    TriangleId, VertexId, Visit, CONTEXT_BITS, TRIANGLE_BITS,
};
use crate::leaf::LutMemory;
use crate::predicate::{Point, POINT_BITS};
use crate::prelude::*;
use incircle_protocol::Config;

/// Width of two ids and the flag that they are kept, in bits.
const PAIR_BITS: usize = 2 * TRIANGLE_BITS + 1;

// The kernel holds the widths as literals, because rust-hdl allows no constants there.
const _: () = assert!(TRIANGLE_BITS == 15 && POINT_BITS == 32, "two ids have 30 bits and fit the word of a point");

#[derive(LogicBlock, Default)]
pub struct KeptIds {
    pub clock: Signal<In, Clock>,
    /// A context that starts and may take a vertex at this edge; ids are kept for that vertex, and stand in the target
    /// of `moving`. In a run of moves neither counts.
    pub start: Signal<In, Start>,
    pub owns: Signal<In, Bit>,
    pub moving: Signal<In, Moving>,
    /// Ids that a vertex keeps from now on.
    pub kept: Signal<In, KeptWrite>,
    /// A ring is handed over. The visit that completes, which hands it over if one does, and the vertex of its context;
    /// the vertex is not inserted, because its point is that of another one.
    pub commit: Signal<In, CommitRequest>,
    pub visit: Signal<In, Visit>,
    pub vertex: Signal<In, VertexId>,
    pub is_duplicate: Signal<In, Bit>,
    /// The ring whose first entry is at the head or on its way there; it is taken at this edge (`loads`); and it takes
    /// a new id (`takes`), which is `id` if it `has_ids`.
    pub job: Signal<In, CommitJob>,
    pub loads: Signal<In, Bit>,
    pub takes: Signal<In, Bit>,
    pub has_ids: Signal<Out, Bit>,
    pub id: Signal<Out, TriangleId>,
    /// Ids are kept for the vertex of the visit that completes, or for that of a solo insertion at work.
    pub owned: Signal<Out, Bit>,
    /// A solo insertion starts, or is at work; its ids, if they are kept.
    pub solo_start: Signal<In, SoloStart>,
    pub solo: Signal<In, SoloProgress>,
    pub solo_first: Signal<Out, TriangleId>,
    pub solo_second: Signal<Out, TriangleId>,
    /// The point of a move in place that ends, which has to be written.
    pub moved: Signal<In, Arrival>,
    /// That point; or a vertex that is out of the mesh, and the word with its ids, which has to be written in the place
    /// of its point. A visit that ends a move in place finds no duplicate, and a run of deletions moves nothing, so both
    /// never come in one clock.
    pub late_point: Signal<Out, Arrival>,
    /// The ids of the vertex that each context inserts, and of that whose ring the context has handed over.
    keepers: LutMemory<CONTEXT_BITS, PAIR_BITS>,
    handed: LutMemory<CONTEXT_BITS, PAIR_BITS>,
    solo_vertex: DFF<VertexId>,
    solo_context: DFF<ContextId>,
    /// A solo insertion has started one clock ago: that it is at work shows a clock later.
    has_started: DFF<Bit>,
    starts: Signal<Local, Bit>,
    pair: DFF<Bits<PAIR_BITS>>,
    is_second: DFF<Bit>,
    first: Signal<Local, Point>,
    second: Signal<Local, Point>,
    kept_word: Signal<Local, Point>,
    word: Signal<Local, Point>,
    /// The ids of the item that starts, and those of the context of the visit that completes.
    ids: Signal<Local, Bits<30>>,
    own_ids: Signal<Local, Bits<30>>,
    has_own: Signal<Local, Bit>,
    keeps: Signal<Local, Bit>,
    wide: Signal<Local, Bits<PAIR_BITS>>,
    flag: Signal<Local, Bits<PAIR_BITS>>,
    id_shift: Signal<Local, Point>,
    ends_in_vain: Signal<Local, Bit>,
}

impl KeptIds {
    pub fn new(config: Config) -> Self {
        Self {
            keepers: LutMemory::new(context_bits(config), PAIR_BITS),
            handed: LutMemory::new(context_bits(config), PAIR_BITS),
            ..Self::default()
        }
    }
}

impl Logic for KeptIds {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, solo_vertex, solo_context, has_started, pair, is_second);
        clock!(self, clock, keepers, handed);
        self.id_shift.next = 15.into();
        self.flag.next = 0x4000_0000.into();
        self.first.next = bit_cast::<32, 15>(self.kept.val().first);
        self.second.next = bit_cast::<32, 15>(self.kept.val().second);
        self.kept_word.next = self.first.val() | (self.second.val() << self.id_shift.val());

        // Only a run of moves deletes and inserts.
        self.keepers.write_address.next = self.start.val().context;
        self.keepers.write_enable.next = self.start.val().takes;
        self.keeps.next = self.owns.val();
        self.word.next = self.moving.val().target;
        if self.moving.val().runs {
            self.keepers.write_address.next = self.kept.val().context;
            self.keepers.write_enable.next = self.kept.val().valid;
            self.keeps.next = true;
            self.word.next = self.kept_word.val();
        }
        self.ids.next = self.word.val().get_bits::<30>(0);
        self.wide.next = bit_cast::<31, 30>(self.ids.val());
        self.keepers.write_data.next = self.wide.val();
        if self.keeps.val() {
            self.keepers.write_data.next = self.wide.val() | self.flag.val();
        }

        self.starts.next = self.solo_start.val().valid & (!self.solo.val().is_at_work) & (!self.has_started.q.val());
        self.has_started.d.next = self.starts.val();
        if self.starts.val() {
            self.solo_vertex.d.next = self.solo_start.val().vertex;
            self.solo_context.d.next = self.solo_start.val().context;
        }
        self.keepers.read_address.next = self.visit.val().context;
        self.handed.write_address.next = self.visit.val().context;
        self.handed.write_data.next = self.keepers.read_data.val();
        self.handed.write_enable.next = self.commit.val().valid;
        self.handed.read_address.next = self.job.val().context;
        if self.solo.val().is_at_work {
            self.keepers.read_address.next = self.solo_context.q.val();
        }
        self.has_own.next = self.keepers.read_data.val().get_bit(30);
        self.owned.next = self.has_own.val();
        self.solo_first.next = self.keepers.read_data.val().get_bits::<15>(0);
        self.solo_second.next = self.keepers.read_data.val().get_bits::<15>(15);

        self.has_ids.next = self.pair.q.val().get_bit(30);
        self.id.next = self.pair.q.val().get_bits::<15>(0);
        if self.is_second.q.val() {
            self.id.next = self.pair.q.val().get_bits::<15>(15);
        }
        if self.takes.val() {
            self.is_second.d.next = true;
        }
        if self.loads.val() {
            self.pair.d.next = self.handed.read_data.val();
            self.is_second.d.next = false;
        }

        self.ends_in_vain.next = self.is_duplicate.val() | (self.solo.val().ends & (!self.solo.val().inserts));
        self.own_ids.next = self.keepers.read_data.val().get_bits::<30>(0);
        self.late_point.next = self.moved.val();
        if self.ends_in_vain.val() & self.has_own.val() {
            self.late_point.next.came = true;
            self.late_point.next.id = self.vertex.val();
            self.late_point.next.point = bit_cast::<32, 30>(self.own_ids.val());
            if self.solo.val().is_at_work {
                self.late_point.next.id = self.solo_vertex.q.val();
            }
        }
        if self.kept.val().valid & (!self.moving.val().runs) {
            self.late_point.next.came = true;
            self.late_point.next.id = self.kept.val().vertex;
            self.late_point.next.point = self.kept_word.val();
        }
    }
}
