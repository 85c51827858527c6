//! Queues bundles and issues their visits, one a clock, first in first out.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset empties the queue |
//! | `push`, `bundle` | in | 1, Bundle | a bundle enters the queue |
//! | `read`, `read_id` | in | 1, 15 | a read-out wants this record; only while the queue is empty |
//! | `token_valid`, `token` | out | 1, Token | the visit issued; in a read-out `token.u` alone counts |
//! | `read_valid` | out | 1 | the issue register holds a read-out |
//!
//! 1. A bundle of two visits takes two clocks, the first visit first.
//! 2. The queue is as deep as the ring: there are never more visits out than entries, so it never overflows.
//!
//! Latency: 1 clock from `push` to `token` when the queue is empty.
//!
//! A bundle of two visits and one of one, then a read-out:
//! ```text
//! push            ___/^^^^^\______________
//! bundle.x          .  1  3  .  .  .  .  .
//! token_valid     ______/^^^^^^^^\________
//! token.x           .  .  1  2  3  .  .  .
//! read            _______________/^^\_____
//! read_valid      __________________/^^\__
//! token.u           .  .  .  .  .  .  9  .
//! ```

use super::{Bundle, Token, BUNDLE_BITS};
use crate::leaf::{Fifo, Unpack};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The queue and the issue register; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Issue {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Empties the queue.
    pub reset: Signal<In, Bit>,
    /// A bundle enters.
    pub push: Signal<In, Bit>,
    /// The bundle.
    pub bundle: Signal<In, Bundle>,
    /// A read-out wants a record.
    pub read: Signal<In, Bit>,
    /// The record.
    pub read_id: Signal<In, Bits<15>>,
    /// A visit is issued.
    pub token_valid: Signal<Out, Bit>,
    /// The visit.
    pub token: Signal<Out, Token>,
    /// A read-out is issued.
    pub read_valid: Signal<Out, Bit>,
    queue: Fifo<6, BUNDLE_BITS>,
    head: Unpack<Bundle, BUNDLE_BITS>,
    bundle_bits: Signal<Local, Bits<BUNDLE_BITS>>,
    issued: DFF<Token>,
    issued_valid: DFF<Bit>,
    issued_read: DFF<Bit>,
    second_is_due: DFF<Bit>,
    waits_for_second: Signal<Local, Bit>,
}

impl Issue {
    /// A queue of `2^entry_bits` bundles.
    pub fn new(entry_bits: usize) -> Self {
        Self { queue: Fifo::new(entry_bits, BUNDLE_BITS), ..Self::default() }
    }
}

impl Logic for Issue {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, issued, issued_valid, issued_read, second_is_due);
        clock!(self, clock, queue);
        self.queue.reset.next = self.reset.val();
        self.queue.push.next = self.push.val();
        self.bundle_bits.next = self.bundle.val().into();
        self.queue.push_data.next = self.bundle_bits.val();
        self.head.bits.next = self.queue.data.val();
        self.token.next = self.issued.q.val();
        self.token_valid.next = self.issued_valid.q.val();
        self.read_valid.next = self.issued_read.q.val();

        self.waits_for_second.next = self.head.value.val().is_pair & (!self.second_is_due.q.val());
        self.queue.pop.next = self.queue.valid.val() & (!self.waits_for_second.val());
        self.second_is_due.d.next = self.queue.valid.val() & self.waits_for_second.val();

        self.issued_valid.d.next = self.queue.valid.val();
        self.issued_read.d.next = self.read.val();
        self.issued.d.next.rotates = self.head.value.val().rotates;
        self.issued.d.next.locks = self.head.value.val().locks;
        self.issued.d.next.f_entry = self.head.value.val().f_entry;
        self.issued.d.next.f = self.head.value.val().f;
        self.issued.d.next.x = self.head.value.val().x;
        self.issued.d.next.after = self.head.value.val().after;
        self.issued.d.next.u = self.head.value.val().u;
        if self.second_is_due.q.val() {
            self.issued.d.next.x = self.head.value.val().second_x;
            self.issued.d.next.after = self.head.value.val().second_after;
            self.issued.d.next.u = self.head.value.val().second_u;
        }
        if self.read.val() {
            self.issued.d.next.u = self.read_id.val();
        }
        if self.reset.val() {
            self.issued_valid.d.next = false;
            self.issued_read.d.next = false;
            self.second_is_due.d.next = false;
        }
    }
}
