//! Reads finished boundary rings in their order, an entry a clock, one ring after the other without a pause.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset forgets all rings |
//! | `entry_enable`, `entry_owner`, `entry_place`, `entry` | in | 1, 5, 6, Entry | an entry of a context becomes final |
//! | `job_enable`, `job` | in | 1, CommitJob | a ring is finished |
//! | `head_valid`, `head` | out | 1, Entry | the next entry; its `after` is 0 |
//! | `head_is_last` | out | 1 | it ends its ring |
//! | `head_job` | out | CommitJob | its ring |
//! | `takes` | in | 1 | the head is taken at this edge |
//!
//! 1. A ring starts at entry 0 and follows `after` until that is 0. It has three entries or more.
//! 2. All its entries are final when `job_enable` comes, or become so at the same edge; none is written again until the last one
//!    has been taken.
//! 3. `takes` only while `head_valid`. Without it the head is held.
//! 4. Three stages, the pointer, the array of the list memory and its output register, move together: when the head is free or
//!    taken.
//! 5. A context has one ring here at a time.
//!
//! Latency: 4 clocks from `job_enable` to `head_valid` if no ring is before it.
//!
//! Two rings of three, of contexts 1 and 0, whose entries stand in the order 0, 2, 1 with `a` = 10, 12, 11 and 20, 22, 21:
//! ```text
//! entry_enable    ___/^^^^^^^^^^^^^^^^^\__________________________
//! entry_place       .  0  1  2  0  1  2  .  .  .  .  .  .  .  .  .
//! job_enable      _________/^^\_____/^^\__________________________
//! head_valid      _____________________/^^^^^^^^^^^^^^^^^^^^\_____
//! head.a            .  .  .  .  .  .  . 10 12 12 11 20 22 21  .  .
//! head_is_last    ______________________________/^^\_____/^^\_____
//! head_job.owner    .  .  .  .  .  .  .  1  1  1  1  0  0  0  .  .
//! takes           _____________________/^^\__/^^^^^^^^^^^^^^\_____
//! ```

use super::{CommitJob, Entry, JobQueue, RingList, COMMIT_JOB_BITS};
use crate::leaf::Unpack;
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The reader of rings; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct RingReader {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Forgets all rings.
    pub reset: Signal<In, Bit>,
    /// An entry becomes final.
    pub entry_enable: Signal<In, Bit>,
    /// Its context.
    pub entry_owner: Signal<In, Bits<5>>,
    /// Its place.
    pub entry_place: Signal<In, Bits<6>>,
    /// It.
    pub entry: Signal<In, Entry>,
    /// A ring is finished.
    pub job_enable: Signal<In, Bit>,
    /// The ring.
    pub job: Signal<In, CommitJob>,
    /// The head is taken.
    pub takes: Signal<In, Bit>,
    /// There is an entry.
    pub head_valid: Signal<Out, Bit>,
    /// The entry.
    pub head: Signal<Out, Entry>,
    /// It ends its ring.
    pub head_is_last: Signal<Out, Bit>,
    /// Its ring.
    pub head_job: Signal<Out, CommitJob>,
    rings: JobQueue<COMMIT_JOB_BITS>,
    oldest: Unpack<CommitJob, COMMIT_JOB_BITS>,
    job_bits: Signal<Local, Bits<COMMIT_JOB_BITS>>,
    list: RingList,
    /// The ring that the pointer is in.
    ring: DFF<CommitJob>,
    pointer_valid: DFF<Bit>,
    pointer_is_first: DFF<Bit>,
    pointer: DFF<Bits<6>>,
    array_valid: DFF<Bit>,
    array_is_first: DFF<Bit>,
    array_is_last: DFF<Bit>,
    output_valid: DFF<Bit>,
    output_is_last: DFF<Bit>,
    /// The ring of the head. The pointer leaves it two entries earlier, and its first entry three; so one register holds it.
    output_ring: DFF<CommitJob>,
    moves: Signal<Local, Bit>,
    is_last: Signal<Local, Bit>,
    ring_is_through: Signal<Local, Bit>,
    first_place: Signal<Local, Bits<6>>,
}

impl RingReader {
    /// The reader of a configuration.
    pub fn new(config: Config) -> Self {
        Self { rings: JobQueue::new(super::context_bits(config)), list: RingList::new(config), ..Self::default() }
    }
}

impl Logic for RingReader {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, ring, pointer_valid, pointer_is_first, pointer);
        dff_setup!(self, clock, array_valid, array_is_first, array_is_last, output_valid, output_is_last, output_ring);
        clock!(self, clock, rings, list);
        self.first_place.next = 0.into();
        self.head_valid.next = self.output_valid.q.val();
        self.head.next = self.list.head.val();
        self.head_is_last.next = self.output_is_last.q.val();
        self.head_job.next = self.output_ring.q.val();
        self.moves.next = (!self.output_valid.q.val()) | self.takes.val();

        // The list.
        self.list.enable.next = self.entry_enable.val();
        self.list.owner.next = self.entry_owner.val();
        self.list.place.next = self.entry_place.val();
        self.list.entry.next = self.entry.val();
        self.list.reader.next = self.ring.q.val().owner;
        self.list.read_place.next = self.pointer.q.val();
        self.list.moves.next = self.moves.val();
        self.is_last.next = self.list.after.val() == self.first_place.val();

        // The pointer follows its ring, then the next ring's first entry.
        self.ring_is_through.next = (!self.pointer_valid.q.val()) | self.is_last.val();
        self.job_bits.next = self.job.val().into();
        self.rings.reset.next = self.reset.val();
        self.rings.enable.next = self.job_enable.val();
        self.rings.job.next = self.job_bits.val();
        self.rings.takes.next = self.moves.val() & self.ring_is_through.val();
        self.oldest.bits.next = self.rings.head.val();
        if self.moves.val() {
            self.pointer_is_first.d.next = self.ring_is_through.val();
            if self.ring_is_through.val() {
                self.pointer_valid.d.next = self.rings.waits.val();
                self.pointer.d.next = self.first_place.val();
                self.ring.d.next = self.oldest.value.val();
            } else {
                self.pointer.d.next = self.list.after.val();
            }
            self.array_valid.d.next = self.pointer_valid.q.val();
            self.array_is_first.d.next = self.pointer_is_first.q.val();
            self.array_is_last.d.next = self.is_last.val();
            self.output_valid.d.next = self.array_valid.q.val();
            self.output_is_last.d.next = self.array_is_last.q.val();
            if self.array_is_first.q.val() {
                self.output_ring.d.next = self.ring.q.val();
            }
        }
        if self.reset.val() {
            self.pointer_valid.d.next = false;
            self.array_valid.d.next = false;
            self.output_valid.d.next = false;
        }
    }
}
