//! Counts the records of the mesh twice: new ids as they are taken, and the records that are written. Ids in between
//! belong to records that no walk may trust yet.
//!
//! 1. The new ids of a ring count as written when its last record has passed the write port and stands
//!    in the memory (L7).
//! 2. At most one of `takes`, `ends`, `solo_inserts`, `seeds`, `clears` is high at a time. The last three come only
//!    while all new ids are written, when `fresh` and `records` are equal.
//! 3. The ends of two rings are three clocks apart or more.
//!
//! Latency: 1 clock to `fresh`; 3 clocks from `ends` to `records`.
//!
//! The first triangle, then a ring that takes two ids:
//! ```text
//! seeds           ___/^^\__________________________
//! takes           ____________/^^^^^\______________
//! ends            _____________________/^^\________
//! fresh             0  0  4  4  4  5  6  6  6  6  6
//! records           0  0  4  4  4  4  4  4  4  4  6
//! ```

use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct FreshIds {
    pub clock: Signal<In, Clock>,
    /// Reset forgets all records.
    pub reset: Signal<In, Bit>,
    /// A ring takes the next new id.
    pub takes: Signal<In, Bit>,
    /// The last write of a ring is requested.
    pub ends: Signal<In, Bit>,
    /// A solo insertion has written two new records.
    pub solo_inserts: Signal<In, Bit>,
    /// A first triangle and its ghost triangles are written, four records.
    pub seeds: Signal<In, Bit>,
    /// The mesh is cleared, with all its records.
    pub clears: Signal<In, Bit>,
    /// The next new id.
    pub fresh: Signal<Out, Bits<15>>,
    /// Records from this id on are not written yet.
    pub records: Signal<Out, Bits<15>>,
    /// In a core with deletions: the id after the next new one.
    pub fresh_after: Vec<Signal<Out, Bits<15>>>,
    taken: DFF<Bits<15>>,
    written: DFF<Bits<15>>,
    /// The value that `written` takes once the ring that has ended is in the memory.
    ended: DFF<Bits<15>>,
    /// A ring ended one clock ago, and two clocks ago.
    ended_before_1: DFF<Bit>,
    ended_before_2: DFF<Bit>,
    step: Signal<Local, Bits<15>>,
    raised: Signal<Local, Bits<15>>,
    none: Signal<Local, Bits<15>>,
    one: Signal<Local, Bits<15>>,
    two: Signal<Local, Bits<15>>,
    seed_records: Signal<Local, Bits<15>>,
}

impl FreshIds {
    /// The ids of a core with deletions.
    pub fn with_deletions() -> Self {
        Self { fresh_after: vec![Signal::default()], ..Self::default() }
    }
}

impl Logic for FreshIds {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, taken, written, ended, ended_before_1, ended_before_2);
        self.none.next = 0.into();
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.seed_records.next = 4.into();
        self.fresh.next = self.taken.q.val();
        self.records.next = self.written.q.val();
        for i in 0..self.fresh_after.len() {
            self.fresh_after[i].next = self.taken.q.val() + self.one.val();
        }

        // The sum is made before `takes` is known, which comes late.
        self.step.next = self.one.val();
        if self.solo_inserts.val() {
            self.step.next = self.two.val();
        }
        if self.seeds.val() {
            self.step.next = self.seed_records.val();
        }
        self.raised.next = self.taken.q.val() + self.step.val();
        if self.takes.val() | self.solo_inserts.val() | self.seeds.val() {
            self.taken.d.next = self.raised.val();
        }

        // L7: the ids count once their records are in the memory. The write port takes one clock, the memory another.
        self.ended_before_1.d.next = self.ends.val();
        self.ended_before_2.d.next = self.ended_before_1.q.val();
        if self.ends.val() {
            self.ended.d.next = self.taken.q.val();
        }
        if self.ended_before_2.q.val() {
            self.written.d.next = self.ended.q.val();
        }
        if self.solo_inserts.val() | self.seeds.val() {
            self.written.d.next = self.raised.val();
        }
        if self.clears.val() | self.reset.val() {
            self.taken.d.next = self.none.val();
            self.written.d.next = self.none.val();
        }
        if self.reset.val() {
            self.ended_before_1.d.next = false;
            self.ended_before_2.d.next = false;
        }
    }
}
