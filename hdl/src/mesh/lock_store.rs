//! The locks of the triangle records, each with its holder, the context of the attempt that took the lock.
//!
//! 1. A visit with `takes` that finds the lock clear sets the lock for its context. A visit that finds the lock set
//!    does not change it, and `foreign` says whether another context holds it. The holder of each lock is
//!    stored for that (L9).
//! 2. A lock that is cleared at the edge at which a visit wants it ends up clear, and counts as foreign to that visit,
//!    whoever held it: `LockMemory` cannot both clear and set a lock at one edge.
//! 3. `was_set` is arbitrary if the visit meets a clear of the same lock. `took` and `foreign` are low without `takes`.
//! 4. Visits may come at every clock, also to the same lock: each sees the effects of the visits before it.
//! 5. Only the low `id_bits` of an id and the low `context_bits` of a context count.
//!
//! Latency: 3 clocks to `took` and `foreign`, 2 to `was_set`. Visits from the next edge on see a lock that is taken or
//! cleared at an edge. No logic stands between the memories and the first register behind them, so the holder is
//! written only in clock 3, when the visit knows that it took the lock. Up to three later visits have read the holder
//! by then, or read it at that edge, and are told instead: clock 1 compares each visit with the three before it, and
//! clock 2 settles what follows.
//!
//! Context 3 takes lock 5, context 4 wants it, context 3 comes again; context 4 wants it while it is cleared,
//! and then takes it:
//! ```text
//! id                5  5  5  .  5  5  .  .  .
//! context_id        3  4  3  .  4  4  .  .  .
//! takes           /^^^^^^^^\__/^^^^^\________
//! clear_enable    ____________/^^\___________
//! took              .______/^^\___________/^^
//! foreign           ._________/^^\_____/^^\__
//! ```

use crate::engine::types::LockClear;
use crate::leaf::{BlockMemory, LockMemory, Parameter};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct LockStore {
    pub clock: Signal<In, Clock>,
    /// Id of the record whose lock the visit meets, in clock 0.
    pub id: Signal<In, Bits<15>>,
    /// Context of the visit, in clock 0.
    pub context_id: Signal<In, Bits<5>>,
    /// The visit wants the lock, in clock 0.
    pub takes: Signal<In, Bit>,
    /// The visit took the lock, which was clear before; in clock 3.
    pub took: Signal<Out, Bit>,
    /// The visit wanted the lock, but another context holds it or it was just being cleared; in clock 3.
    pub foreign: Signal<Out, Bit>,
    /// The lock was set before the visit, in clock 2.
    pub was_set: Signal<Out, Bit>,
    /// A lock to clear at this edge.
    pub clear: Signal<In, LockClear>,
    locks: LockMemory<15>,
    holders: BlockMemory<15, 5>,
    lock: Signal<Local, Bits<15>>,
    cleared: Signal<Local, Bits<15>>,
    kept_context: Signal<Local, Bits<5>>,
    meets_clear: Signal<Local, Bit>,
    /// The id and the context of the visits in clocks 1 to 4.
    id1: DFF<Bits<15>>,
    id2: DFF<Bits<15>>,
    id3: DFF<Bits<15>>,
    id4: DFF<Bits<15>>,
    context1: DFF<Bits<5>>,
    context2: DFF<Bits<5>>,
    context3: DFF<Bits<5>>,
    context4: DFF<Bits<5>>,
    /// The visit wants a lock that is not being cleared (`takes`), or one that is (`met_clear`).
    takes1: DFF<Bit>,
    takes2: DFF<Bit>,
    takes3: DFF<Bit>,
    met_clear1: DFF<Bit>,
    met_clear2: DFF<Bit>,
    met_clear3: DFF<Bit>,
    /// The visit in clock 2 has the lock, or the context, of the first, second or third visit before it.
    is_lock_before1: DFF<Bit>,
    is_lock_before2: DFF<Bit>,
    is_lock_before3: DFF<Bit>,
    is_context_before1: DFF<Bit>,
    is_context_before2: DFF<Bit>,
    is_context_before3: DFF<Bit>,
    /// The lock and the holder that the memories gave the visit in clock 3.
    found_set: DFF<Bit>,
    found_holder: DFF<Bits<5>>,
    /// One of the three visits before took the lock; if so, whether the latest of them has the same context.
    is_told: DFF<Bit>,
    told_is_own: DFF<Bit>,
    /// The visits in clocks 4 and 5 took their locks.
    took4: DFF<Bit>,
    took5: DFF<Bit>,
    takes_lock: Signal<Local, Bit>,
    was_taken1: Signal<Local, Bit>,
    was_taken2: Signal<Local, Bit>,
    was_taken3: Signal<Local, Bit>,
    holder_is_own: Signal<Local, Bit>,
    kept_id_bits: Parameter<Bits<15>>,
    kept_context_bits: Parameter<Bits<5>>,
}

impl LockStore {
    /// Number of clocks from a visit to `was_set`.
    pub const READ_LATENCY: usize = LockMemory::<15>::LATENCY;
    /// Number of clocks from a visit to `took` and `foreign`.
    pub const LATENCY: usize = Self::READ_LATENCY + 1;

    /// A store of `2^id_bits` locks for `2^context_bits` contexts.
    ///
    /// # Panics
    /// If `id_bits` is not in `1..=15` or `context_bits` not in `1..=5`.
    pub fn new(id_bits: usize, context_bits: usize) -> Self {
        Self {
            locks: LockMemory::new(id_bits),
            holders: BlockMemory::new(id_bits, context_bits),
            kept_id_bits: Parameter::new(Bits::<15>::mask() >> (15 - id_bits) as u64),
            kept_context_bits: Parameter::new(Bits::<5>::mask() >> (5 - context_bits) as u64),
            ..Self::default()
        }
    }
}

impl Logic for LockStore {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, id1, id2, id3, id4, context1, context2, context3, context4);
        dff_setup!(self, clock, takes1, takes2, takes3, met_clear1, met_clear2, met_clear3);
        dff_setup!(self, clock, is_lock_before1, is_lock_before2, is_lock_before3);
        dff_setup!(self, clock, is_context_before1, is_context_before2, is_context_before3);
        dff_setup!(self, clock, found_set, found_holder, is_told, told_is_own, took4, took5);
        clock!(self, clock, locks, holders);
        self.lock.next = self.id.val() & self.kept_id_bits.val();
        self.cleared.next = self.clear.val().id & self.kept_id_bits.val();
        self.kept_context.next = self.context_id.val() & self.kept_context_bits.val();

        // Clock 0: a lock that is being cleared is not set, because the memory's two ports must not change one
        // lock at one edge.
        self.meets_clear.next = self.clear.val().valid & (self.lock.val() == self.cleared.val());
        self.locks.test_address.next = self.lock.val();
        self.locks.test_set.next = self.takes.val() & (!self.meets_clear.val());
        self.locks.clear_address.next = self.cleared.val();
        self.locks.clear_enable.next = self.clear.val().valid;
        self.holders.read_address.next = self.lock.val();
        self.id1.d.next = self.lock.val();
        self.context1.d.next = self.kept_context.val();
        self.takes1.d.next = self.locks.test_set.val();
        self.met_clear1.d.next = self.takes.val() & self.meets_clear.val();

        // Clock 1: the three visits before may have taken the same lock, and the memory does not
        // show their contexts yet.
        self.id2.d.next = self.id1.q.val();
        self.context2.d.next = self.context1.q.val();
        self.takes2.d.next = self.takes1.q.val();
        self.met_clear2.d.next = self.met_clear1.q.val();
        self.is_lock_before1.d.next = self.id1.q.val() == self.id2.q.val();
        self.is_lock_before2.d.next = self.id1.q.val() == self.id3.q.val();
        self.is_lock_before3.d.next = self.id1.q.val() == self.id4.q.val();
        self.is_context_before1.d.next = self.context1.q.val() == self.context2.q.val();
        self.is_context_before2.d.next = self.context1.q.val() == self.context3.q.val();
        self.is_context_before3.d.next = self.context1.q.val() == self.context4.q.val();

        // Clock 2: the visits before know better than the memory; of those that took the lock, the latest counts.
        self.id3.d.next = self.id2.q.val();
        self.context3.d.next = self.context2.q.val();
        self.found_set.d.next = self.locks.was_set.val();
        self.found_holder.d.next = self.holders.read_data.val();
        self.takes3.d.next = self.takes2.q.val();
        self.met_clear3.d.next = self.met_clear2.q.val();
        self.was_set.next = self.locks.was_set.val();
        self.takes_lock.next = self.takes3.q.val() & (!self.found_set.q.val());
        self.was_taken1.next = self.is_lock_before1.q.val() & self.takes_lock.val();
        self.was_taken2.next = self.is_lock_before2.q.val() & self.took4.q.val();
        self.was_taken3.next = self.is_lock_before3.q.val() & self.took5.q.val();
        self.is_told.d.next = self.was_taken1.val() | self.was_taken2.val() | self.was_taken3.val();
        self.told_is_own.d.next = self.is_context_before3.q.val();
        if self.was_taken2.val() {
            self.told_is_own.d.next = self.is_context_before2.q.val();
        }
        if self.was_taken1.val() {
            self.told_is_own.d.next = self.is_context_before1.q.val();
        }

        // Clock 3, L9: only a visit that takes the lock writes its context; any other is compared with the holder.
        self.id4.d.next = self.id3.q.val();
        self.context4.d.next = self.context3.q.val();
        self.took4.d.next = self.takes_lock.val();
        self.took5.d.next = self.took4.q.val();
        self.holders.write_address.next = self.id3.q.val();
        self.holders.write_data.next = self.context3.q.val();
        self.holders.write_enable.next = self.takes_lock.val();
        self.holder_is_own.next = self.found_holder.q.val() == self.context3.q.val();
        if self.is_told.q.val() {
            self.holder_is_own.next = self.told_is_own.q.val();
        }
        self.took.next = self.takes_lock.val();
        self.foreign.next =
            self.met_clear3.q.val() | (self.takes3.q.val() & self.found_set.q.val() & (!self.holder_is_own.val()));
    }
}
