//! The steps of a commit: which entry of the ring is taken when, and what is written in which clock.
//!
//! 1. An entry is loaded or advanced to as soon as it is on the head, unless its id must wait for an inner triangle.
//! 2. Between two records stands the link of the triangle outside, if that one must learn a new id.
//! 3. The first entry's record is written last, because it needs the last one's id.
//!
//! Latency: 1 clock; `takes` is a function of registers and `awaits_id`.

use crate::engine::types::RingHead;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// What the commit does.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum CommitState {
    /// Awaits a ring.
    Idle,
    /// Writes the record of the current entry, once the id of the one ahead is known.
    Record,
    /// Writes the link of the triangle outside it.
    Link,
    /// Writes the record of the first entry.
    Close,
}

/// The steps; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct CommitSteps {
    pub clock: Signal<In, Clock>,
    /// Reset drops the ring.
    pub reset: Signal<In, Bit>,
    pub head: Signal<In, RingHead>,
    /// The inner triangle that the entry on the head may need is not there yet.
    pub awaits_id: Signal<In, Bit>,
    /// The entry ahead takes an id that is not that of the triangle behind it.
    pub changes_id: Signal<In, Bit>,
    /// The entry on the head is taken at this edge, if there is one.
    pub takes: Signal<Out, Bit>,
    /// It is the first of its ring; or the entry ahead becomes the current one.
    pub loads: Signal<Out, Bit>,
    pub advances: Signal<Out, Bit>,
    /// The current entry is the first, before the last one's id is known; or the last.
    pub opens: Signal<Out, Bit>,
    pub is_last: Signal<Out, Bit>,
    /// What is written at this edge, if anything is: a link, or the last record of the ring.
    pub is_link: Signal<Out, Bit>,
    pub is_close: Signal<Out, Bit>,
    /// A ring is being written.
    pub is_at_work: Signal<Out, Bit>,
    state: DFF<CommitState>,
    /// The state is one that takes an entry, unless it must wait for an inner triangle.
    wants: DFF<Bit>,
    current_is_last: DFF<Bit>,
    /// The triangle outside the current entry must learn its id.
    needs_link: DFF<Bit>,
    current_opens: DFF<Bit>,
    /// The ring closes after the link.
    closes: DFF<Bit>,
    closing: Signal<Local, Bit>,
    waits: Signal<Local, Bit>,
    begins: Signal<Local, Bit>,
    goes_on: Signal<Local, Bit>,
}

impl Logic for CommitSteps {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, wants, current_is_last, needs_link, current_opens, closes);
        self.closing.next = self.state.q.val() == CommitState::Close;
        self.waits.next = self.head.val().shares & self.awaits_id.val();
        self.begins.next = ((self.state.q.val() == CommitState::Idle) | self.closing.val()) & self.head.val().valid;
        self.goes_on.next = (self.state.q.val() == CommitState::Record)
            & (self.current_is_last.q.val() | (self.head.val().valid & (!self.waits.val())));
        self.takes.next = self.wants.q.val() & (!self.waits.val());
        self.loads.next = self.begins.val();
        self.advances.next = self.goes_on.val();
        self.opens.next = self.current_opens.q.val();
        self.is_last.next = self.current_is_last.q.val();
        self.is_link.next = self.state.q.val() == CommitState::Link;
        self.is_close.next = self.closing.val();
        self.is_at_work.next = self.state.q.val() != CommitState::Idle;

        if self.goes_on.val() {
            self.current_opens.d.next = false;
            self.closes.d.next = self.current_is_last.q.val();
            self.current_is_last.d.next = (!self.current_is_last.q.val()) & self.head.val().is_last;
            self.needs_link.d.next = self.changes_id.val();
        }
        if self.begins.val() {
            self.current_is_last.d.next = false;
            self.current_opens.d.next = true;
            self.needs_link.d.next = false;
        }
        match self.state.q.val() {
            CommitState::Record => {
                if self.goes_on.val() {
                    self.wants.d.next = self.current_is_last.q.val() | (!self.head.val().is_last);
                    if self.current_is_last.q.val() {
                        self.state.d.next = CommitState::Close;
                    }
                    if self.needs_link.q.val() {
                        self.state.d.next = CommitState::Link;
                        self.wants.d.next = false;
                    }
                }
            }
            CommitState::Link => {
                self.state.d.next = CommitState::Record;
                self.wants.d.next = self.closes.q.val() | (!self.current_is_last.q.val());
                if self.closes.q.val() {
                    self.state.d.next = CommitState::Close;
                }
            }
            _ => {
                self.state.d.next = CommitState::Idle;
                self.wants.d.next = true;
                if self.begins.val() {
                    self.state.d.next = CommitState::Record;
                }
            }
        }
        if self.reset.val() {
            self.state.d.next = CommitState::Idle;
            self.wants.d.next = true;
        }
    }
}
