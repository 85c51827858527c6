//! Deals the items of a run to the contexts in turn.
//!
//! 1. Item `i` of a run belongs to context `i mod k`, where `k` is the number of contexts that work, and has the number
//!    `i` modulo 2^24.
//! 2. A word comes only while the block holds no item (`holds`). The block then offers the item until it is taken.
//! 3. An item of two words has its vertex in the first one, which the block keeps (`takes_vertex`).
//!
//! Latency: an item is on offer in the clock after its word, so a word can come every second clock.

use super::types::{DealtItem, Item, ItemNumber, Launch};
use crate::commands::types::Word;
use crate::engine::types::ContextId;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct ItemDealer {
    pub clock: Signal<In, Clock>,
    /// Reset drops the item.
    pub reset: Signal<In, Bit>,
    /// A run begins: its first item is item 0, for context 0.
    pub starts: Signal<In, Bit>,
    /// Number of contexts that work.
    pub contexts: Signal<In, ContextId>,
    /// The word of an item comes at this edge.
    pub takes: Signal<In, Bit>,
    pub word: Signal<In, Word>,
    /// The word is the vertex of an item, whose point follows; and the vertex of the item on offer, or of the last one.
    pub takes_vertex: Signal<In, Bit>,
    pub vertex: Signal<Out, Word>,
    pub holds: Signal<Out, Bit>,
    /// The item on offer, and whether it is taken at this edge.
    pub dealt: Signal<Out, DealtItem>,
    pub taken: Signal<In, Bit>,
    is_held: DFF<Bit>,
    held: DFF<Launch>,
    turn: DFF<ContextId>,
    number: DFF<ItemNumber>,
    kept_vertex: DFF<Word>,
    item: Signal<Local, Item>,
    after_turn: Signal<Local, ContextId>,
    one_turn: Signal<Local, ContextId>,
    one_number: Signal<Local, ItemNumber>,
}

impl Logic for ItemDealer {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_held, held, turn, number, kept_vertex);
        self.one_turn.next = 1.into();
        self.one_number.next = 1.into();
        self.holds.next = self.is_held.q.val();
        self.dealt.next.valid = self.is_held.q.val();
        self.dealt.next.context = self.held.q.val().context;
        self.dealt.next.item = self.held.q.val().item;
        self.item.next.number = self.number.q.val();
        self.item.next.place = self.word.val();
        self.item.next.vertex = self.kept_vertex.q.val().get_bits::<15>(0);
        self.item.next.owns = false;
        self.item.next.target = self.word.val();
        self.vertex.next = self.kept_vertex.q.val();
        if self.takes_vertex.val() {
            self.kept_vertex.d.next = self.word.val();
        }
        self.after_turn.next = self.turn.q.val() + self.one_turn.val();
        if self.taken.val() {
            self.is_held.d.next = false;
        }
        if self.takes.val() {
            self.is_held.d.next = true;
            self.held.d.next.context = self.turn.q.val();
            self.held.d.next.item = self.item.val();
            self.number.d.next = self.number.q.val() + self.one_number.val();
            self.turn.d.next = self.after_turn.val();
            if self.after_turn.val() == self.contexts.val() {
                self.turn.d.next = 0.into();
            }
        }
        if self.starts.val() {
            self.turn.d.next = 0.into();
            self.number.d.next = 0.into();
        }
        if self.reset.val() {
            self.is_held.d.next = false;
        }
    }
}
