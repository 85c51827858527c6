//! The item that begins next, in a register, with the record at which its walk begins.
//!
//! 1. An item is chosen while the register is empty. A vertex that goes back into the mesh ([`ReturnLine`]) comes
//!    before the items of the queues, and an item of the queues comes only if there is room for its part.
//! 2. The item begins in a clock that the user chooses (`goes`). So nothing of the choice stands on the path from that
//!    clock's visit to the walk that begins.
//! 3. At most one item begins in two clocks. A core that could begin one in each takes 0.5 % less for a `Locate`.
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
    /// An item waits in the queues; there is room for its part. In the clock after it has been chosen, it leaves the
    /// queues (`pops`).
    pub waits: Signal<In, Bit>,
    pub has_room: Signal<In, Bit>,
    pub queued: Signal<In, Launch>,
    pub pops: Signal<Out, Bit>,
    /// The context of the item that may be chosen, and the record at which its walk would begin.
    pub context_id: Signal<Out, ContextId>,
    pub start_record: Signal<In, TriangleId>,
    /// The item that begins next, if there is one; its record; and whether its vertex goes back into the mesh.
    pub is_ready: Signal<Out, Bit>,
    pub launch: Signal<Out, Launch>,
    pub record: Signal<Out, TriangleId>,
    pub is_return: Signal<Out, Bit>,
    /// The item begins at this edge; only while `is_ready`.
    pub goes: Signal<In, Bit>,
    ready: DFF<Bit>,
    leaves: DFF<Bit>,
    item: DFF<Launch>,
    first: DFF<TriangleId>,
    comes_back: DFF<Bit>,
    chosen: Signal<Local, Launch>,
    takes: Signal<Local, Bit>,
}

impl Logic for NextItem {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, ready, leaves, item, first, comes_back);
        self.chosen.next = self.queued.val();
        if self.returns.val() {
            self.chosen.next = self.returned.val();
        }
        self.context_id.next = self.chosen.val().context;
        self.takes_returned.next = (!self.ready.q.val()) & self.returns.val();
        self.takes.next = (!self.ready.q.val()) & (!self.returns.val()) & self.waits.val() & self.has_room.val();
        self.leaves.d.next = self.takes.val() & (!self.reset.val());
        self.pops.next = self.leaves.q.val();
        self.is_ready.next = self.ready.q.val();
        self.launch.next = self.item.q.val();
        self.record.next = self.first.q.val();
        self.is_return.next = self.comes_back.q.val();

        if !self.ready.q.val() {
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
