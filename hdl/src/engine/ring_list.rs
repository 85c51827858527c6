//! The boundary lists of all contexts: entries as they become final, and a ring's entries in their order.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock` | in | 1 | everything happens at its rising edge |
//! | `enable`, `owner`, `place`, `entry` | in | 1, 5, 6, Entry | an entry of a context becomes final |
//! | `reader`, `read_place` | in | 5, 6 | the entry to read |
//! | `moves` | in | 1 | it is read at this edge, and the one before it comes on the output |
//! | `after` | out | 6 | the entry after it, at once |
//! | `head` | out | Entry | the entry that was read two moves ago; its `after` is 0 |
//!
//! 1. An entry is read after the clock in which it becomes final, and not written again before it has left the output.
//!
//! Latency: none from `read_place` to `after`, so that one entry a clock can be followed; two moves to `head`.
//!
//! Source: what leads on is in LUTs, the rest in block RAM.

use super::{context_bits, ring_bits, ContextAddress, Entry, ENTRY_BITS, ENTRY_WORD_BITS, RING_ADDRESS_BITS};
use crate::leaf::{LutMemory, PacedMemory, Unpack};
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

/// The boundary lists; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct RingList {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// An entry becomes final.
    pub enable: Signal<In, Bit>,
    /// Its context.
    pub owner: Signal<In, Bits<5>>,
    /// Its place.
    pub place: Signal<In, Bits<6>>,
    /// It.
    pub entry: Signal<In, Entry>,
    /// Context of the entry to read.
    pub reader: Signal<In, Bits<5>>,
    /// Its place.
    pub read_place: Signal<In, Bits<6>>,
    /// It is read at this edge.
    pub moves: Signal<In, Bit>,
    /// The entry after it.
    pub after: Signal<Out, Bits<6>>,
    /// The entry two moves before it.
    pub head: Signal<Out, Entry>,
    followers: LutMemory<RING_ADDRESS_BITS, ENTRY_BITS>,
    /// All of an entry but `after`, which is its last field.
    edges: PacedMemory<RING_ADDRESS_BITS, ENTRY_WORD_BITS>,
    write_at: ContextAddress<ENTRY_BITS, RING_ADDRESS_BITS>,
    read_at: ContextAddress<ENTRY_BITS, RING_ADDRESS_BITS>,
    entry_bits: Signal<Local, Bits<ENTRY_WORD_BITS>>,
    read_entry: Unpack<Entry, ENTRY_WORD_BITS>,
}

impl RingList {
    /// The lists of a configuration.
    pub fn new(config: Config) -> Self {
        let bits = ring_bits(config);
        let address_bits = context_bits(config) + bits;
        Self {
            followers: LutMemory::new(address_bits, bits),
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
        clock!(self, clock, followers, edges);
        self.write_at.owner.next = self.owner.val();
        self.write_at.place.next = self.place.val();
        self.entry_bits.next = self.entry.val().into();
        self.followers.write_address.next = self.write_at.address.val();
        self.followers.write_data.next = self.entry.val().after;
        self.followers.write_enable.next = self.enable.val();
        self.edges.write_address.next = self.write_at.address.val();
        self.edges.write_data.next = self.entry_bits.val();
        self.edges.write_enable.next = self.enable.val();

        self.read_at.owner.next = self.reader.val();
        self.read_at.place.next = self.read_place.val();
        self.followers.read_address.next = self.read_at.address.val();
        self.after.next = self.followers.read_data.val();
        self.edges.read_address.next = self.read_at.address.val();
        self.edges.read_enable.next = self.moves.val();
        self.read_entry.bits.next = self.edges.read_data.val();
        self.head.next = self.read_entry.value.val();
    }
}
