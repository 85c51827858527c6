//! The queue of visits: bundles come in, and their visits are issued, one in each clock, first in, first out. A cavity
//! asks for up to three visits at once, but the read port of the triangle memory serves one a clock.
//!
//! 1. The one to three visits of a bundle are issued in order, one a clock. `Bundle` says in which fields they differ.
//! 2. The queue has a place for every ring entry of every context. A context never has more visits in flight than its
//!    ring has entries, so the queue never overflows.
//! 3. The id of the record goes to all block RAMs of the triangle memory. Three registers hold the id, so that each can
//!    lie near the RAMs that it drives. Reset clears one, sets all bits of another and does not act on the third,
//!    because synthesis would merge equal registers.
//!
//! Latency: 1 clock from `push` to `visit` if the queue is empty.
//!
//! A bundle of three visits and one of a single visit, then a read-out:
//! ```text
//! push            ___/^^^^^\_________________
//! bundle.entry      .  1  4  .  .  .  .  .  .
//! visit_valid     ______/^^^^^^^^^^^\________
//! visit.entry       .  .  1  2  3  4  .  .  .
//! read            __________________/^^\_____
//! read_valid      _____________________/^^\__
//! visit.record      .  .  .  .  .  .  .  9  .
//! ```

use crate::engine::types::{Bundle, Push, RecordRead, TriangleId, Visit, BUNDLE_BITS, RING_ADDRESS_BITS};
use crate::leaf::{DeepFifo, Unpack};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct Issue {
    pub clock: Signal<In, Clock>,
    /// Reset empties the queue.
    pub reset: Signal<In, Bit>,
    /// A bundle that enters the queue at this edge.
    pub push: Signal<In, Push>,
    /// A record that the read-out wants; only while the queue is empty.
    pub read: Signal<In, RecordRead>,
    /// The visit that is issued in this clock; in a read-out only `visit.record` counts.
    pub visit_valid: Signal<Out, Bit>,
    pub visit: Signal<Out, Visit>,
    /// Copies of `visit.record` from two more registers; arbitrary after a reset until the next visit or read-out.
    pub vertices_id: Signal<Out, TriangleId>,
    pub links_id: Signal<Out, TriangleId>,
    /// The issue register holds a read-out, not a visit.
    pub read_valid: Signal<Out, Bit>,
    queue: DeepFifo<RING_ADDRESS_BITS, BUNDLE_BITS>,
    head: Unpack<Bundle, BUNDLE_BITS>,
    pushed: Signal<Local, Bundle>,
    bundle_bits: Signal<Local, Bits<BUNDLE_BITS>>,
    issued: DFF<Visit>,
    vertices_copy: DFF<TriangleId>,
    links_copy: DFF<TriangleId>,
    issued_valid: DFF<Bit>,
    issued_read: DFF<Bit>,
    second_is_due: DFF<Bit>,
    third_is_due: DFF<Bit>,
    record: Signal<Local, TriangleId>,
    no_record: Signal<Local, TriangleId>,
    is_at_first: Signal<Local, Bit>,
    second_follows: Signal<Local, Bit>,
    third_follows: Signal<Local, Bit>,
}

impl Issue {
    /// The smallest width that `DeepFifo` accepts for its address.
    const MIN_ADDRESS_BITS: usize = DeepFifo::<RING_ADDRESS_BITS, BUNDLE_BITS>::WINDOW_BITS + 1;

    /// Builds a queue of `2^address_bits` bundles, 32 at least.
    ///
    /// # Panics
    ///
    /// If `address_bits` is above `RING_ADDRESS_BITS`.
    pub fn new(address_bits: usize) -> Self {
        Self { queue: DeepFifo::new(address_bits.max(Self::MIN_ADDRESS_BITS), BUNDLE_BITS), ..Self::default() }
    }
}

impl Logic for Issue {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            issued,
            vertices_copy,
            links_copy,
            issued_valid,
            issued_read,
            second_is_due,
            third_is_due
        );
        clock!(self, clock, queue);
        self.queue.reset.next = self.reset.val();
        self.queue.push.next = self.push.val().valid;
        self.pushed.next = self.push.val().bundle;
        self.bundle_bits.next = self.pushed.val().into();
        self.queue.push_data.next = self.bundle_bits.val();
        self.head.bits.next = self.queue.data.val();
        self.visit.next = self.issued.q.val();
        self.visit_valid.next = self.issued_valid.q.val();
        self.vertices_id.next = self.vertices_copy.q.val();
        self.links_id.next = self.links_copy.q.val();
        self.read_valid.next = self.issued_read.q.val();

        self.is_at_first.next = (!self.second_is_due.q.val()) & (!self.third_is_due.q.val());
        self.second_follows.next = self.head.value.val().is_pair & self.is_at_first.val();
        self.third_follows.next = self.head.value.val().is_triple & self.second_is_due.q.val();
        self.queue.pop.next = self.queue.valid.val() & (!self.second_follows.val()) & (!self.third_follows.val());
        self.second_is_due.d.next = self.queue.valid.val() & self.second_follows.val();
        self.third_is_due.d.next = self.queue.valid.val() & self.third_follows.val();

        self.issued_valid.d.next = self.queue.valid.val();
        self.issued_read.d.next = self.read.val().valid;
        self.issued.d.next.context = self.head.value.val().context;
        self.issued.d.next.rotates = self.head.value.val().rotates;
        self.issued.d.next.locks = self.head.value.val().locks;
        self.issued.d.next.cavity_entry = self.head.value.val().cavity_entry;
        self.issued.d.next.cavity_record = self.head.value.val().cavity_record;
        self.issued.d.next.entry = self.head.value.val().entry;
        self.issued.d.next.after = self.head.value.val().after;
        self.record.next = self.head.value.val().record;
        if self.second_is_due.q.val() {
            self.issued.d.next.entry = self.head.value.val().after;
            self.issued.d.next.after = self.head.value.val().second_after;
            self.record.next = self.head.value.val().second_record;
        }
        if self.third_is_due.q.val() {
            self.issued.d.next.entry = self.head.value.val().second_after;
            self.issued.d.next.after = 0.into();
            self.record.next = self.head.value.val().third_record;
        }
        if self.read.val().valid {
            self.record.next = self.read.val().id;
        }
        self.issued.d.next.record = self.record.val();
        self.vertices_copy.d.next = self.record.val();
        self.links_copy.d.next = self.record.val();
        self.no_record.next = 0.into();
        if self.reset.val() {
            self.vertices_copy.d.next = self.no_record.val();
            self.links_copy.d.next = !self.no_record.val();
            self.issued_valid.d.next = false;
            self.issued_read.d.next = false;
            self.second_is_due.d.next = false;
            self.third_is_due.d.next = false;
        }
    }
}
