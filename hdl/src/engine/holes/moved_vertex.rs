//! The moves of the contexts: whether the visits of a context look for its vertex and go round the star, or insert it;
//! and the point that a move in place gives to `LatePoint`.
//!
//! 1. In a run of deletions all visits are those of a deletion (`finds`). In a run of moves they are so until the
//!    vertex is out of the mesh. Then the context starts again with an item that `returns`.
//! 2. When the last visit of a move in place completes, the point of its vertex is given (`arrival`).
//!
//! Latency: none from `early` to `early_finds`, 1 clock to all others.

use crate::engine::types::{
    context_bits, Arrival, MovedItem, Moving, Start, Upcoming, Visit, CONTEXT_BITS, MOVED_ITEM_BITS,
};
use crate::leaf::{LutMemory, Unpack};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct MovedVertex {
    pub clock: Signal<In, Clock>,
    /// A run of deletions is under way; or one of moves, with the item that begins; and a context that takes a vertex.
    pub deletes: Signal<In, Bit>,
    pub moving: Signal<In, Moving>,
    pub start: Signal<In, Start>,
    /// The visit that completes in the next clock, and whether it belongs to a deletion or to a move whose vertex is in
    /// the mesh.
    pub early: Signal<In, Upcoming>,
    pub early_finds: Signal<Out, Bit>,
    /// Of the visit that completes in this clock: the same; it is also one of a move; the vertex has its new place
    /// already.
    pub finds: Signal<Out, Bit>,
    pub moves: Signal<Out, Bit>,
    pub stays: Signal<Out, Bit>,
    /// The visit ends a move in place, and the point that is then given.
    pub ends_in_place: Signal<In, Bit>,
    pub arrival: Signal<Out, Arrival>,
    items: LutMemory<CONTEXT_BITS, MOVED_ITEM_BITS>,
    read: Unpack<MovedItem, MOVED_ITEM_BITS>,
    item: DFF<MovedItem>,
    found: DFF<Bit>,
    moved: DFF<Bit>,
    visit: Signal<Local, Visit>,
    taken: Signal<Local, MovedItem>,
    taken_bits: Signal<Local, Bits<MOVED_ITEM_BITS>>,
    is_moved: Signal<Local, Bit>,
}

impl MovedVertex {
    /// The block of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        Self { items: LutMemory::new(context_bits(config), MOVED_ITEM_BITS), ..Self::default() }
    }
}

impl Logic for MovedVertex {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, item, found, moved);
        clock!(self, clock, items);
        self.taken.next.vertex = self.start.val().id;
        self.taken.next.target = self.moving.val().target;
        self.taken.next.returns = self.moving.val().returns;
        self.taken.next.stays = self.moving.val().stays;
        self.taken_bits.next = self.taken.val().into();
        self.items.write_address.next = self.start.val().context;
        self.items.write_data.next = self.taken_bits.val();
        self.items.write_enable.next = self.start.val().takes;
        self.visit.next = self.early.val().visit;
        self.items.read_address.next = self.visit.val().context;
        self.read.bits.next = self.items.read_data.val();
        self.item.d.next = self.read.value.val();
        self.is_moved.next = self.moving.val().runs & (!self.read.value.val().returns);
        self.early_finds.next = self.deletes.val() | self.is_moved.val();
        self.found.d.next = self.deletes.val() | self.is_moved.val();
        self.moved.d.next = self.is_moved.val();
        self.finds.next = self.found.q.val();
        self.moves.next = self.moved.q.val();
        self.stays.next = self.item.q.val().stays;
        self.arrival.next.came = self.ends_in_place.val();
        self.arrival.next.id = self.item.q.val().vertex;
        self.arrival.next.point = self.item.q.val().target;
    }
}
