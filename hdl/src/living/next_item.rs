//! The item that begins next, in a register, with the record at which its walk begins.
//!
//! 1. An item is chosen while the register is empty. A vertex that goes back into the mesh ([`ReturnLine`]) comes
//!    before the items of the queues, and an item of the queues comes only if there is room for its part.
//! 2. The item begins in a clock that the user chooses (`goes`). So nothing of the choice stands on the path from that
//!    clock's visit to the walk that begins.
//! 3. At most one item of a change begins in two clocks. Questions begin faster: one that begins makes room for the
//!    next at the same edge (`refills`), without which a `Locate` takes 1 % more cycles. There no vertex goes back.
//!
//! Latency: 1 clock from an item that waits to `is_ready`.
//!
//! [`ReturnLine`]: super::ReturnLine

use super::types::Launch;
use crate::engine::types::{ContextId, TriangleId};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct NextItem {
    pub clock: Signal<In, Clock>,
    /// Reset drops the item.
    pub reset: Signal<In, Bit>,
    /// A vertex waits to go back into the mesh, and its item; and whether it is chosen at this edge.
    pub returns: Signal<In, Bit>,
    pub returned: Signal<In, Launch>,
    pub takes_returned: Signal<Out, Bit>,
    /// An item waits in the queues; there is room for its part; and whether it is chosen at this edge.
    pub waits: Signal<In, Bit>,
    pub has_room: Signal<In, Bit>,
    pub queued: Signal<In, Launch>,
    pub takes_queued: Signal<Out, Bit>,
    /// The context of the item that may be chosen, and the record at which its walk would begin.
    pub context_id: Signal<Out, ContextId>,
    pub start_record: Signal<In, TriangleId>,
    /// The item that begins next, if there is one; its record; and whether its vertex goes back into the mesh.
    pub is_ready: Signal<Out, Bit>,
    pub launch: Signal<Out, Launch>,
    pub record: Signal<Out, TriangleId>,
    pub is_return: Signal<Out, Bit>,
    /// The item begins at this edge; only while `is_ready`. An item of the queues may take its place (`refills`).
    pub goes: Signal<In, Bit>,
    pub refills: Signal<In, Bit>,
    ready: DFF<Bit>,
    item: DFF<Launch>,
    first: DFF<TriangleId>,
    comes_back: DFF<Bit>,
    chosen: Signal<Local, Launch>,
    takes: Signal<Local, Bit>,
    is_open: Signal<Local, Bit>,
}

impl Logic for NextItem {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, ready, item, first, comes_back);
        self.chosen.next = self.queued.val();
        if self.returns.val() {
            self.chosen.next = self.returned.val();
        }
        self.context_id.next = self.chosen.val().context;
        self.takes_returned.next = (!self.ready.q.val()) & self.returns.val();
        self.is_open.next = (!self.ready.q.val()) | self.refills.val();
        self.takes.next = self.is_open.val() & (!self.returns.val()) & self.waits.val() & self.has_room.val();
        self.takes_queued.next = self.takes.val();
        self.is_ready.next = self.ready.q.val();
        self.launch.next = self.item.q.val();
        self.record.next = self.first.q.val();
        self.is_return.next = self.comes_back.q.val();

        if self.is_open.val() {
            self.item.d.next = self.chosen.val();
            self.first.d.next = self.start_record.val();
            self.comes_back.d.next = self.returns.val();
        }
        if self.goes.val() {
            self.ready.d.next = false;
        }
        if self.takes.val() | ((!self.ready.q.val()) & self.returns.val()) {
            self.ready.d.next = true;
        }
        if self.reset.val() {
            self.ready.d.next = false;
        }
    }
}
