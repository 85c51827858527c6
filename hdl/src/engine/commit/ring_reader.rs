//! Reads complete rings in the order of their entries, an entry a clock, one ring after another. A list in memory takes
//! several clocks to follow, so the reader works ahead of the commit.
//!
//! 1. A ring starts at entry 0, follows `after` until that is 0, and has three entries or more.
//! 2. All entries of a ring are final when `commit` comes, or become so at the same edge. None is written again until
//!    the last one has been taken.
//! 3. The head is held until `takes`.
//! 4. Five stages move together when the head is free or taken: the pointer, the array of the list memory, its output
//!    register, a register away from it, and the head. So the entries of a ring follow each other without a gap.
//! 5. All decisions about an entry are made on its way to the head, and the head is a function of registers. The last
//!    entry of a ring is known only when it is in the array. So the pointer runs one place too far, and one place
//!    between two rings stays empty. The commit writes the end of a ring in that clock and needs no entry.
//! 6. A context has one ring here at a time.
//!
//! Latency: 6 clocks from `commit` to `head` if no ring is before it.
//!
//! Two rings of three, of contexts 1 and 0. Their entries stand in the order 0, 2, 1 and have the first vertices 10,
//! 12, 11 and 20, 22, 21. The first two entries of each ring lie along one cavity record:
//! ```text
//! entry_enable      ___/^^^^^^^^^^^^^^^^^\_____________________________
//! entry_place         .  0  1  2  0  1  2  .  .  .  .  .  .  .  .  .  .
//! job_enable        _________/^^\_____/^^\_____________________________
//! head_valid        ___________________________/^^^^^^^^^^^\__/^^^^^^^^
//! head.first_vertex   .  .  .  .  .  .  .  .  . 10 12 12 11  . 20 22 21
//! head_is_last      ____________________________________/^^\________/^^
//! head_shares       ______________________________/^^^^^\________/^^\__
//! head_job.context    .  .  .  .  .  .  .  .  .  1  .  .  .  .  0  .  .
//! takes             ___________________________/^^\__/^^^^^\__/^^^^^^^^
//! ```

use super::job_queue::JobQueue;
use super::ring_list::RingList;
use crate::engine::types::{
    context_bits, CommitJob, CommitRequest, ContextSet, Entry, EntryWrite, RingEntry, RingHead, TriangleId,
    COMMIT_JOB_BITS,
};
use crate::leaf::Unpack;
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct RingReader {
    pub clock: Signal<In, Clock>,
    /// Reset forgets all rings.
    pub reset: Signal<In, Bit>,
    /// An entry of a context becomes final.
    pub entry: Signal<In, EntryWrite>,
    /// A ring is complete.
    pub commit: Signal<In, CommitRequest>,
    /// The next entry, whose `after` is 0; and the job of its ring, which counts with the first entry.
    pub head: Signal<Out, RingHead>,
    pub head_job: Signal<Out, CommitJob>,
    /// The head is taken at this edge, if there is one.
    pub takes: Signal<In, Bit>,
    rings: JobQueue<COMMIT_JOB_BITS>,
    oldest: Unpack<CommitJob, COMMIT_JOB_BITS>,
    job: Signal<Local, CommitJob>,
    job_bits: Signal<Local, Bits<COMMIT_JOB_BITS>>,
    list: RingList,
    /// The ring that the pointer is in, and its context as a bit.
    ring: DFF<CommitJob>,
    ring_bit: DFF<ContextSet>,
    pointer_valid: DFF<Bit>,
    pointer_is_first: DFF<Bit>,
    pointer: DFF<RingEntry>,
    array_valid: DFF<Bit>,
    array_is_first: DFF<Bit>,
    array_is_last: DFF<Bit>,
    output_valid: DFF<Bit>,
    output_is_first: DFF<Bit>,
    output_is_last: DFF<Bit>,
    /// The ring of the entry in the output register. The pointer is still in that ring when its first entry comes
    /// there. That entry is on the head before one of the next ring can follow, two entries behind.
    output_ring: DFF<CommitJob>,
    arrival_valid: DFF<Bit>,
    arrival_is_first: DFF<Bit>,
    arrival_is_last: DFF<Bit>,
    arrival: DFF<Entry>,
    entry_valid: DFF<Bit>,
    entry_is_last: DFF<Bit>,
    entry_shares: DFF<Bit>,
    /// The head, with which the next entry is compared.
    last_entry: DFF<Entry>,
    /// The cavity record behind the first entry of the ring.
    first_cavity_record: DFF<TriangleId>,
    moves: Signal<Local, Bit>,
    ring_is_through: Signal<Local, Bit>,
    /// The pointer is at an entry, not past the last one.
    pointer_counts: Signal<Local, Bit>,
    shares_with_last: Signal<Local, Bit>,
    shares_with_first: Signal<Local, Bit>,
    first_place: Signal<Local, RingEntry>,
    first_bit: Signal<Local, ContextSet>,
    wide_context: Signal<Local, ContextSet>,
    oldest_bit: Signal<Local, ContextSet>,
}

impl RingReader {
    pub fn new(config: Config) -> Self {
        Self { rings: JobQueue::new(context_bits(config)), list: RingList::new(config), ..Self::default() }
    }
}

impl Logic for RingReader {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, ring, ring_bit, pointer_valid, pointer_is_first, pointer, array_valid, array_is_first);
        dff_setup!(self, clock, array_is_last, output_valid, output_is_first, output_is_last, output_ring);
        dff_setup!(self, clock, arrival_valid, arrival_is_first, arrival_is_last, arrival);
        dff_setup!(self, clock, entry_valid, entry_is_last, entry_shares, last_entry, first_cavity_record);
        clock!(self, clock, rings, list);
        self.first_place.next = 0.into();
        self.head.next.valid = self.entry_valid.q.val();
        self.head.next.entry = self.last_entry.q.val();
        self.head.next.is_last = self.entry_is_last.q.val();
        self.head.next.shares = self.entry_shares.q.val();
        self.head_job.next = self.output_ring.q.val();
        self.moves.next = (!self.entry_valid.q.val()) | self.takes.val();

        self.list.entry.next = self.entry.val();
        self.list.reader.next = self.ring.q.val().context;
        self.list.reader_bit.next = self.ring_bit.q.val();
        self.list.read_place.next = self.pointer.q.val();
        self.list.moves.next = self.moves.val();

        // The last entry of a ring leads to place 0 again, where the next ring begins.
        self.ring_is_through.next = (!self.pointer_valid.q.val()) | self.array_is_last.q.val();
        self.pointer_counts.next = self.pointer_valid.q.val() & (!self.array_is_last.q.val());
        self.job.next = self.commit.val().job;
        self.job_bits.next = self.job.val().into();
        self.rings.reset.next = self.reset.val();
        self.rings.enable.next = self.commit.val().valid;
        self.rings.job.next = self.job_bits.val();
        self.rings.takes.next = self.moves.val() & self.ring_is_through.val();
        self.oldest.bits.next = self.rings.head.val();
        self.first_bit.next = 1.into();
        self.wide_context.next = bit_cast::<24, 5>(self.oldest.value.val().context);
        self.oldest_bit.next = self.first_bit.val() << self.wide_context.val();
        self.shares_with_last.next = self.arrival.q.val().cavity_record == self.last_entry.q.val().cavity_record;
        self.shares_with_first.next = self.arrival.q.val().cavity_record == self.first_cavity_record.q.val();
        if self.moves.val() {
            self.pointer_is_first.d.next = self.ring_is_through.val();
            if self.ring_is_through.val() {
                self.pointer_valid.d.next = self.rings.waits.val();
                self.ring.d.next = self.oldest.value.val();
                self.ring_bit.d.next = self.oldest_bit.val();
            }
            self.pointer.d.next = self.first_place.val();
            if self.pointer_counts.val() {
                self.pointer.d.next = self.list.after.val();
            }
            self.array_valid.d.next = self.pointer_counts.val();
            self.array_is_first.d.next = self.pointer_is_first.q.val();
            self.array_is_last.d.next = self.list.is_last.val() & self.pointer_counts.val();
            self.output_valid.d.next = self.array_valid.q.val();
            self.output_is_first.d.next = self.array_is_first.q.val();
            self.output_is_last.d.next = self.array_is_last.q.val();
            if self.array_is_first.q.val() {
                self.output_ring.d.next = self.ring.q.val();
            }
            self.arrival_valid.d.next = self.output_valid.q.val();
            self.arrival_is_first.d.next = self.output_is_first.q.val();
            self.arrival_is_last.d.next = self.output_is_last.q.val();
            self.arrival.d.next = self.list.read.val();
            self.entry_valid.d.next = self.arrival_valid.q.val();
            self.entry_is_last.d.next = self.arrival_is_last.q.val();
            self.entry_shares.d.next =
                (!self.arrival_is_first.q.val()) & (self.shares_with_last.val() | self.shares_with_first.val());
            self.last_entry.d.next = self.arrival.q.val();
            if self.arrival_is_first.q.val() {
                self.first_cavity_record.d.next = self.arrival.q.val().cavity_record;
            }
        }
        if self.reset.val() {
            self.pointer_valid.d.next = false;
            self.array_valid.d.next = false;
            self.output_valid.d.next = false;
            self.arrival_valid.d.next = false;
            self.entry_valid.d.next = false;
        }
    }
}
