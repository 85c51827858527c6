//! The steps of a commit: which entry of the ring is taken in which clock, and what is written.
//!
//! 1. An entry is taken as soon as it is on the head, unless its record must wait for the id of an inner record.
//! 2. The link of the outside record is written between two records, if that record must learn a new id.
//! 3. The record of the first entry is written last, because it needs the id of the last one.
//! 4. While `holds` is set, nothing is taken or written, and the state stays.
//!
//! Latency: 1 clock; `takes` is a function of registers and `awaits_id`.

use crate::engine::types::RingHead;
use crate::prelude::*;

/// The state of the commit.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum CommitState {
    /// No ring is being written.
    Idle,
    /// The record of the current entry is written, once the id of the next one is known.
    Record,
    /// The link of the outside record is written.
    Link,
    /// The record of the first entry is written.
    Close,
}

#[derive(LogicBlock, Default)]
pub struct CommitSteps {
    pub clock: Signal<In, Clock>,
    /// Reset drops the ring.
    pub reset: Signal<In, Bit>,
    /// The next entry of the ring reader.
    pub head: Signal<In, RingHead>,
    /// The entry on the head may need the id of an inner record that is not there yet.
    pub awaits_id: Signal<In, Bit>,
    /// The entry ahead takes another id than that of the cavity record behind it.
    pub changes_id: Signal<In, Bit>,
    /// The entry on the head is taken at this edge, if there is one.
    pub takes: Signal<Out, Bit>,
    /// The first entry of a ring is loaded; or the entry ahead becomes the current one (`advances`).
    pub loads: Signal<Out, Bit>,
    pub advances: Signal<Out, Bit>,
    /// The current entry is the first one, before the id of the last is known; or it is the last one (`is_last`).
    pub opens: Signal<Out, Bit>,
    pub is_last: Signal<Out, Bit>,
    /// A link is written at this edge; or the last record of the ring is (`is_close`).
    pub is_link: Signal<Out, Bit>,
    pub is_close: Signal<Out, Bit>,
    /// A ring is being written.
    pub is_at_work: Signal<Out, Bit>,
    /// In a core with deletions: the write port is taken at the next edge.
    pub holds: Vec<Signal<In, Bit>>,
    state: DFF<CommitState>,
    /// The state takes an entry, unless it must wait for the id of an inner record. A register of its
    /// own keeps `takes` short.
    wants: DFF<Bit>,
    current_is_last: DFF<Bit>,
    /// The record outside the current entry must learn the new id.
    needs_link: DFF<Bit>,
    current_opens: DFF<Bit>,
    /// The ring closes after the link.
    closes: DFF<Bit>,
    closing: Signal<Local, Bit>,
    waits: Signal<Local, Bit>,
    begins: Signal<Local, Bit>,
    goes_on: Signal<Local, Bit>,
}

impl CommitSteps {
    /// The steps of a core with deletions.
    pub fn with_deletions() -> Self {
        Self { holds: vec![Signal::default()], ..Self::default() }
    }
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
        for i in 0..self.holds.len() {
            if self.holds[i].val() {
                self.takes.next = false;
                self.loads.next = false;
                self.advances.next = false;
                self.is_link.next = false;
                self.is_close.next = false;
                self.state.d.next = self.state.q.val();
                self.wants.d.next = self.wants.q.val();
                self.current_is_last.d.next = self.current_is_last.q.val();
                self.needs_link.d.next = self.needs_link.q.val();
                self.current_opens.d.next = self.current_opens.q.val();
                self.closes.d.next = self.closes.q.val();
            }
        }
        if self.reset.val() {
            self.state.d.next = CommitState::Idle;
            self.wants.d.next = true;
        }
    }
}
