//! The locks of the triangle records, each with the context that holds it.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock` | in | 1 | everything happens at its rising edge |
//! | `id` | in | 15 | the lock that a visit comes to, in clock 0 |
//! | `owner` | in | 5 | the visit's context, in clock 0 |
//! | `takes` | in | 1 | the visit wants the lock, in clock 0 |
//! | `took` | out | 1 | it has it now, and had it not before, in clock 2 |
//! | `foreign` | out | 1 | it wants it, but another context holds it or it was just being cleared, in clock 2 |
//! | `was_set` | out | 1 | the lock was set before the visit, in clock 2 |
//! | `clear_id`, `clear_enable` | in | 15, 1 | a lock to clear at this edge |
//!
//! 1. A visit with `takes` that finds the lock clear sets it for its context. One that finds it set leaves it alone: `foreign` says
//!    whether it is that of another context.
//! 2. A lock that is cleared at the edge at which a visit wants it is cleared, and counts as foreign to that visit, whoever had it:
//!    `LockMemory` could not do both.
//! 3. `was_set` is arbitrary where a visit meets a clear of the same lock, and `took` and `foreign` are low without `takes`.
//! 4. Visits may come at every clock, and to the same lock: each sees what those before it did.
//! 5. Only the low `id_bits` of an id and the low `context_bits` of a context count.
//!
//! Latency: 2 clocks. A lock taken or cleared at an edge is seen by visits from the next edge on. The owner is written two edges
//! later, when the visit knows that it took the lock; until then a visit that comes after it compares itself with it.
//!
//! Context 3 takes lock 5, context 4 wants it, context 3 comes again; context 4 wants it while it is cleared, and then gets it:
//! ```text
//! id                5  5  5  .  5  5  .  .
//! owner             3  4  3  .  4  4  .  .
//! takes           /^^^^^^^^\__/^^^^^\_____
//! clear_enable    ____________/^^\________
//! took              .___/^^\___________/^^
//! foreign           .______/^^\_____/^^\__
//! ```

use crate::leaf::{BlockMemory, LockMemory};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Locks and their owners; see the top of this file.
#[derive(LogicBlock)]
pub struct LockStore {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// The lock that a visit comes to.
    pub id: Signal<In, Bits<15>>,
    /// The visit's context.
    pub owner: Signal<In, Bits<5>>,
    /// The visit wants the lock.
    pub takes: Signal<In, Bit>,
    /// It took it.
    pub took: Signal<Out, Bit>,
    /// Another context has it, or it was being cleared.
    pub foreign: Signal<Out, Bit>,
    /// The lock before the visit.
    pub was_set: Signal<Out, Bit>,
    /// Lock to clear.
    pub clear_id: Signal<In, Bits<15>>,
    /// Clear it.
    pub clear_enable: Signal<In, Bit>,
    locks: LockMemory<15>,
    owners: BlockMemory<15, 5>,
    lock: Signal<Local, Bits<15>>,
    cleared: Signal<Local, Bits<15>>,
    visitor: Signal<Local, Bits<5>>,
    meets_clear: Signal<Local, Bit>,
    /// The visit in clocks 1 to 3.
    id1: DFF<Bits<15>>,
    id2: DFF<Bits<15>>,
    id3: DFF<Bits<15>>,
    owner1: DFF<Bits<5>>,
    owner2: DFF<Bits<5>>,
    owner3: DFF<Bits<5>>,
    takes1: DFF<Bit>,
    takes2: DFF<Bit>,
    met_clear1: DFF<Bit>,
    met_clear2: DFF<Bit>,
    took3: DFF<Bit>,
    took4: DFF<Bit>,
    /// The visit in clock 2 has the lock, or the context, of the one before it, or of that before this.
    is_lock_before: DFF<Bit>,
    is_lock_second_before: DFF<Bit>,
    is_owner_before: DFF<Bit>,
    is_owner_second_before: DFF<Bit>,
    takes_free_lock: Signal<Local, Bit>,
    holder_is_owner: Signal<Local, Bit>,
    kept_id_bits: Constant<Bits<15>>,
    kept_owner_bits: Constant<Bits<5>>,
}

impl LockStore {
    /// Clocks from a visit to what it finds.
    pub const LATENCY: usize = LockMemory::<15>::LATENCY;

    /// A store of `2^id_bits` locks for `2^context_bits` contexts.
    ///
    /// # Panics
    /// If `id_bits` is not in `1..=15` or `context_bits` not in `1..=5`.
    pub fn new(id_bits: usize, context_bits: usize) -> Self {
        Self {
            clock: Signal::default(),
            id: Signal::default(),
            owner: Signal::default(),
            takes: Signal::default(),
            took: Signal::default(),
            foreign: Signal::default(),
            was_set: Signal::default(),
            clear_id: Signal::default(),
            clear_enable: Signal::default(),
            locks: LockMemory::new(id_bits),
            owners: BlockMemory::new(id_bits, context_bits),
            lock: Signal::default(),
            cleared: Signal::default(),
            visitor: Signal::default(),
            meets_clear: Signal::default(),
            id1: DFF::default(),
            id2: DFF::default(),
            id3: DFF::default(),
            owner1: DFF::default(),
            owner2: DFF::default(),
            owner3: DFF::default(),
            takes1: DFF::default(),
            takes2: DFF::default(),
            met_clear1: DFF::default(),
            met_clear2: DFF::default(),
            took3: DFF::default(),
            took4: DFF::default(),
            is_lock_before: DFF::default(),
            is_lock_second_before: DFF::default(),
            is_owner_before: DFF::default(),
            is_owner_second_before: DFF::default(),
            takes_free_lock: Signal::default(),
            holder_is_owner: Signal::default(),
            kept_id_bits: Constant::new(Bits::<15>::mask() >> (15 - id_bits) as u64),
            kept_owner_bits: Constant::new(Bits::<5>::mask() >> (5 - context_bits) as u64),
        }
    }
}

impl Default for LockStore {
    fn default() -> Self {
        Self::new(15, 5)
    }
}

impl Logic for LockStore {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, id1, id2, id3, owner1, owner2, owner3, takes1, takes2, met_clear1, met_clear2);
        dff_setup!(self, clock, took3, took4, is_lock_before, is_lock_second_before);
        dff_setup!(self, clock, is_owner_before, is_owner_second_before);
        clock!(self, clock, locks, owners);
        self.lock.next = self.id.val() & self.kept_id_bits.val();
        self.cleared.next = self.clear_id.val() & self.kept_id_bits.val();
        self.visitor.next = self.owner.val() & self.kept_owner_bits.val();

        // Clock 0: test and set, unless the lock is being cleared.
        self.meets_clear.next = self.clear_enable.val() & (self.lock.val() == self.cleared.val());
        self.locks.test_address.next = self.lock.val();
        self.locks.test_set.next = self.takes.val() & (!self.meets_clear.val());
        self.locks.clear_address.next = self.cleared.val();
        self.locks.clear_enable.next = self.clear_enable.val();
        self.owners.read_address.next = self.lock.val();
        self.id1.d.next = self.lock.val();
        self.owner1.d.next = self.visitor.val();
        self.takes1.d.next = self.takes.val();
        self.met_clear1.d.next = self.meets_clear.val();

        // Clock 1: is it the lock, or the context, of one of the two visits before?
        self.id2.d.next = self.id1.q.val();
        self.owner2.d.next = self.owner1.q.val();
        self.takes2.d.next = self.takes1.q.val();
        self.met_clear2.d.next = self.met_clear1.q.val();
        self.is_lock_before.d.next = self.id1.q.val() == self.id2.q.val();
        self.is_lock_second_before.d.next = self.id1.q.val() == self.id3.q.val();
        self.is_owner_before.d.next = self.owner1.q.val() == self.owner2.q.val();
        self.is_owner_second_before.d.next = self.owner1.q.val() == self.owner3.q.val();

        // Clock 2: the holder is the latest visit that took the lock; the memory does not know yet of the two before this one.
        self.takes_free_lock.next = self.takes2.q.val() & (!self.met_clear2.q.val()) & (!self.locks.was_set.val());
        self.holder_is_owner.next = self.owners.read_data.val() == self.owner2.q.val();
        if self.is_lock_second_before.q.val() & self.took4.q.val() {
            self.holder_is_owner.next = self.is_owner_second_before.q.val();
        }
        if self.is_lock_before.q.val() & self.took3.q.val() {
            self.holder_is_owner.next = self.is_owner_before.q.val();
        }
        self.took.next = self.takes_free_lock.val();
        self.foreign.next = self.takes2.q.val()
            & (self.met_clear2.q.val() | (self.locks.was_set.val() & (!self.holder_is_owner.val())));
        self.was_set.next = self.locks.was_set.val();
        self.owners.write_address.next = self.id2.q.val();
        self.owners.write_data.next = self.owner2.q.val();
        self.owners.write_enable.next = self.takes_free_lock.val();
        self.id3.d.next = self.id2.q.val();
        self.owner3.d.next = self.owner2.q.val();
        self.took3.d.next = self.takes_free_lock.val();
        self.took4.d.next = self.took3.q.val();
    }
}
