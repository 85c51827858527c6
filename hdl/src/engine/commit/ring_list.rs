//! The rings of all contexts: entries come as they become final, and are read in the order of their ring.
//!
//! 1. An entry is read two clocks after it becomes final, or later, and is not written again before it leaves.
//! 2. `read` comes from far away and goes into a register before any logic uses it.
//!
//! Latency: none from `read_place` to `after`, so that one entry a clock can be followed; two moves to `read`.
//!
//! Source: the `after` of each entry is in LUTs, the rest in block RAM. A write first goes into a register, where the
//! last entry of a ring is recognised, because a reader has no time for that.

use crate::engine::attempt::ContextAddress;
use crate::engine::types::{
    context_bits, ring_bits, ContextId, ContextSet, Entry, EntryWrite, RingEntry, ENTRY_BITS, ENTRY_WORD_BITS,
    RING_ADDRESS_BITS,
};
use crate::leaf::{BankedMemory, PacedMemory, Unpack};
use crate::prelude::*;
use incircle_protocol::Config;

/// Width in bits of the word that leads on from an entry.
const FOLLOWER_BITS: usize = ENTRY_BITS + 1;

#[derive(LogicBlock, Default)]
pub struct RingList {
    pub clock: Signal<In, Clock>,
    /// A final entry joins the ring of a context.
    pub entry: Signal<In, EntryWrite>,
    /// The entry to read: its context as a number and as a bit, and its place.
    pub reader: Signal<In, ContextId>,
    pub reader_bit: Signal<In, ContextSet>,
    pub read_place: Signal<In, RingEntry>,
    /// The entry is read at this edge, and the one before it comes to the output.
    pub moves: Signal<In, Bit>,
    /// The entry after the one to read, at once; or none follows (`is_last`).
    pub after: Signal<Out, RingEntry>,
    pub is_last: Signal<Out, Bit>,
    /// The entry that was read two moves ago; its `after` is 0.
    pub read: Signal<Out, Entry>,
    written: DFF<EntryWrite>,
    written_entry: Signal<Local, Entry>,
    /// For each entry, lowest bit first: whether it is the last one, and the entry after it.
    followers: BankedMemory<24, 5, ENTRY_BITS, FOLLOWER_BITS>,
    /// Each entry without `after`, which is its last field.
    edges: PacedMemory<RING_ADDRESS_BITS, ENTRY_WORD_BITS>,
    write_at: ContextAddress<ENTRY_BITS, RING_ADDRESS_BITS>,
    read_at: ContextAddress<ENTRY_BITS, RING_ADDRESS_BITS>,
    entry_bits: Signal<Local, Bits<ENTRY_WORD_BITS>>,
    first_place: Signal<Local, RingEntry>,
    wide_after: Signal<Local, Bits<FOLLOWER_BITS>>,
    raised_after: Signal<Local, Bits<FOLLOWER_BITS>>,
    last_bit: Signal<Local, Bits<FOLLOWER_BITS>>,
    one: Signal<Local, Bits<FOLLOWER_BITS>>,
    read_entry: Unpack<Entry, ENTRY_WORD_BITS>,
}

impl RingList {
    pub fn new(config: Config) -> Self {
        let bits = ring_bits(config);
        let address_bits = context_bits(config) + bits;
        Self {
            followers: BankedMemory::new(config.contexts as usize, bits, bits + 1),
            edges: PacedMemory::new(address_bits, ENTRY_WORD_BITS - ENTRY_BITS),
            write_at: ContextAddress::new(bits),
            read_at: ContextAddress::new(bits),
            ..Self::default()
        }
    }
}

impl Logic for RingList {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, written);
        clock!(self, clock, followers, edges);
        self.first_place.next = 0.into();
        self.written.d.next = self.entry.val();
        self.written_entry.next = self.written.q.val().entry;
        self.write_at.context_id.next = self.written.q.val().context;
        self.write_at.place.next = self.written.q.val().place;
        self.entry_bits.next = self.written_entry.val().into();
        self.one.next = 1.into();
        self.wide_after.next = bit_cast::<FOLLOWER_BITS, ENTRY_BITS>(self.written_entry.val().after);
        self.raised_after.next = self.wide_after.val() << self.one.val();
        self.last_bit.next = 0.into();
        if self.written_entry.val().after == self.first_place.val() {
            self.last_bit.next = 1.into();
        }
        self.followers.write_bank.next = self.written.q.val().context;
        self.followers.write_address.next = self.written.q.val().place;
        self.followers.write_data.next = self.raised_after.val() | self.last_bit.val();
        self.followers.write_enable.next = self.written.q.val().valid;
        self.edges.write_address.next = self.write_at.address.val();
        self.edges.write_data.next = self.entry_bits.val();
        self.edges.write_enable.next = self.written.q.val().valid;

        self.read_at.context_id.next = self.reader.val();
        self.read_at.place.next = self.read_place.val();
        self.followers.read_banks.next = self.reader_bit.val();
        self.followers.read_address.next = self.read_place.val();
        self.after.next = self.followers.read_data.val().get_bits::<ENTRY_BITS>(1);
        self.is_last.next = self.followers.read_data.val().get_bit(0);
        self.edges.read_address.next = self.read_at.address.val();
        self.edges.read_enable.next = self.moves.val();
        self.read_entry.bits.next = self.edges.read_data.val();
        self.read.next = self.read_entry.value.val();
    }
}
