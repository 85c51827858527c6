//! Releases the locks of attempts that are over, one a clock. After reset, clears the whole lock memory. The memory
//! clears one lock in each clock, so the locks of each attempt are logged and wait here.
//!
//! 1. Locks of rings go before locks of aborted attempts. Among equals, those that came first go first.
//! 2. A context has one job at a time, of at least one lock. Its log is complete when the job comes or at the same
//!    edge, and is not written again before `released`.
//! 3. While a job is due, a lock is cleared in every clock: there is no pause between jobs.
//! 4. No job is due while the memory is swept, because no visit is made then.
//!
//! Latency: 5 clocks from the job to its first `clear` if the block is idle; the sweep takes one clock for each record.
//!
//! A sweep of four records; then two aborted attempts, of contexts 1 and 0, and a ring of context 3,
//! which overtakes the second:
//! ```text
//! reset            /^^\_______________________________________________
//! sweeps           ___/^^^^^^^^^^^\___________________________________
//! lock_enable      _________/^^^^^^^^\__/^^\__________________________
//! lock_id            .  .  . 27 28 26  . 25  .  .  .  .  .  .  .  .  .
//! failure_enable   __________________/^^^^^\__________________________
//! commit_enable    ________________________/^^\_______________________
//! clear_enable     ______/^^^^^^^^^^^\______________/^^^^^^^^^^^\_____
//! clear_id           .  .  0  1  2  3  .  .  .  .  . 27 28 26 25  .  .
//! released         ____________________________________/^^^^^^^^\_____
//! released_context   .  .  .  .  .  .  .  .  .  .  .  .  1  3  0  .  .
//! ```

use super::job_queue::JobQueue;
use crate::engine::attempt::ContextAddress;
use crate::engine::types::{
    context_bits, ring_bits, ContextId, LockClear, LockCount, LockWrite, ReleaseJob, ReleaseRequest, Released,
    TriangleId, LOG_ADDRESS_BITS, LOG_BITS, RELEASE_JOB_BITS, TRIANGLE_BITS,
};
use crate::leaf::{BlockMemory, Unpack};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct Release {
    pub clock: Signal<In, Clock>,
    /// Reset forgets all jobs and starts the sweep.
    pub reset: Signal<In, Bit>,
    /// The highest record id, a constant.
    pub last_id: Signal<In, TriangleId>,
    /// A lock joins the log of a context.
    pub lock: Signal<In, LockWrite>,
    /// The last record of a ring is written: its locks are due (L4).
    pub commit: Signal<In, ReleaseRequest>,
    /// An attempt has ended without a commit, and all its visits have completed: its locks are due (L1).
    pub failure: Signal<In, ReleaseRequest>,
    /// The lock memory is being cleared after reset.
    pub sweeps: Signal<Out, Bit>,
    /// A lock to clear at this edge; with the last lock of its context also `released`.
    pub clear: Signal<Out, LockClear>,
    pub released: Signal<Out, Released>,
    commits: JobQueue<RELEASE_JOB_BITS>,
    failures: JobQueue<RELEASE_JOB_BITS>,
    commit_job: Signal<Local, ReleaseJob>,
    failure_job: Signal<Local, ReleaseJob>,
    commit_bits: Signal<Local, Bits<RELEASE_JOB_BITS>>,
    failure_bits: Signal<Local, Bits<RELEASE_JOB_BITS>>,
    /// The job that comes next.
    upcoming: Unpack<ReleaseJob, RELEASE_JOB_BITS>,
    log: BlockMemory<LOG_ADDRESS_BITS, TRIANGLE_BITS>,
    write_at: ContextAddress<LOG_BITS, LOG_ADDRESS_BITS>,
    read_at: ContextAddress<LOG_BITS, LOG_ADDRESS_BITS>,
    /// The job at work, and its next place in the log.
    works: DFF<Bit>,
    at_work: DFF<ReleaseJob>,
    place: DFF<LockCount>,
    /// The next lock of the job is the last one, or the one before that.
    one_is_left: DFF<Bit>,
    two_are_left: DFF<Bit>,
    left: DFF<LockCount>,
    /// A lock in the array of the log's memory, and one in its output register.
    array_valid: DFF<Bit>,
    array_is_last: DFF<Bit>,
    array_context: DFF<ContextId>,
    output_valid: DFF<Bit>,
    output_is_last: DFF<Bit>,
    output_context: DFF<ContextId>,
    /// The lock that is cleared in this clock; during the sweep `cleared` counts up.
    clears: DFF<Bit>,
    cleared: DFF<TriangleId>,
    is_last: DFF<Bit>,
    cleared_context: DFF<ContextId>,
    sweeping: DFF<Bit>,
    takes: Signal<Local, Bit>,
    fetches_last: Signal<Local, Bit>,
    after_place: Signal<Local, LockCount>,
    after_cleared: Signal<Local, TriangleId>,
    first_place: Signal<Local, LockCount>,
    one_place: Signal<Local, LockCount>,
    two_places: Signal<Local, LockCount>,
    three_places: Signal<Local, LockCount>,
    one: Signal<Local, TriangleId>,
    before_first: Signal<Local, TriangleId>,
    before_last: Signal<Local, TriangleId>,
}

impl Release {
    /// Builds the log of a configuration: an attempt takes at most `2 * ring - 2` locks.
    pub fn new(config: Config) -> Self {
        let bits = ring_bits(config) + 1;
        Self {
            commits: JobQueue::new(context_bits(config)),
            failures: JobQueue::new(context_bits(config)),
            log: BlockMemory::new(context_bits(config) + bits, TRIANGLE_BITS),
            write_at: ContextAddress::new(bits),
            read_at: ContextAddress::new(bits),
            ..Self::default()
        }
    }
}

impl Logic for Release {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, one_is_left, two_are_left, left);
        dff_setup!(self, clock, works, at_work, place, array_valid, array_is_last, array_context);
        dff_setup!(
            self,
            clock,
            output_valid,
            output_is_last,
            output_context,
            clears,
            cleared,
            is_last,
            cleared_context,
            sweeping
        );
        clock!(self, clock, commits, failures, log);
        self.one.next = 1.into();
        self.one_place.next = 1.into();
        self.first_place.next = 0.into();
        self.before_first.next = 0x7fff.into();
        self.sweeps.next = self.sweeping.q.val();
        self.clear.next.valid = self.clears.q.val();
        self.clear.next.id = self.cleared.q.val();
        self.released.next.valid = self.is_last.q.val();
        self.released.next.context = self.cleared_context.q.val();

        self.write_at.context_id.next = self.lock.val().context;
        self.write_at.place.next = self.lock.val().place;
        self.log.write_address.next = self.write_at.address.val();
        self.log.write_data.next = self.lock.val().id;
        self.log.write_enable.next = self.lock.val().valid;
        self.read_at.context_id.next = self.at_work.q.val().context;
        self.read_at.place.next = self.place.q.val();
        self.log.read_address.next = self.read_at.address.val();

        // The next job is taken together with the last lock of the job at work, so that no clock is lost between jobs.
        self.after_place.next = self.place.q.val() + self.one_place.val();
        self.fetches_last.next = self.works.q.val() & self.one_is_left.q.val();
        self.takes.next = (!self.works.q.val()) | self.fetches_last.val();
        self.commit_job.next = self.commit.val().job;
        self.commit_bits.next = self.commit_job.val().into();
        self.commits.reset.next = self.reset.val();
        self.commits.enable.next = self.commit.val().valid;
        self.commits.job.next = self.commit_bits.val();
        self.commits.takes.next = self.takes.val();
        self.failure_job.next = self.failure.val().job;
        self.failure_bits.next = self.failure_job.val().into();
        self.failures.reset.next = self.reset.val();
        self.failures.enable.next = self.failure.val().valid;
        self.failures.job.next = self.failure_bits.val();
        self.failures.takes.next = self.takes.val() & (!self.commits.waits.val());
        self.upcoming.bits.next = self.failures.head.val();
        if self.commits.waits.val() {
            self.upcoming.bits.next = self.commits.head.val();
        }
        // The locks left are counted down, so that the last one is known ahead without a comparison behind the sum.
        self.three_places.next = 3.into();
        self.two_places.next = 2.into();
        self.place.d.next = self.after_place.val();
        self.left.d.next = self.left.q.val() - self.one_place.val();
        self.one_is_left.d.next = self.two_are_left.q.val();
        self.two_are_left.d.next = self.left.q.val() == self.three_places.val();
        if self.takes.val() {
            self.works.d.next = self.commits.waits.val() | self.failures.waits.val();
            self.at_work.d.next = self.upcoming.value.val();
            self.place.d.next = self.first_place.val();
            self.left.d.next = self.upcoming.value.val().locks;
            self.one_is_left.d.next = self.upcoming.value.val().locks == self.one_place.val();
            self.two_are_left.d.next = self.upcoming.value.val().locks == self.two_places.val();
        }

        self.array_valid.d.next = self.works.q.val();
        self.array_is_last.d.next = self.fetches_last.val();
        self.array_context.d.next = self.at_work.q.val().context;
        self.output_valid.d.next = self.array_valid.q.val();
        self.output_is_last.d.next = self.array_is_last.q.val();
        self.output_context.d.next = self.array_context.q.val();
        self.clears.d.next = self.output_valid.q.val() | self.sweeping.q.val();
        self.cleared.d.next = self.log.read_data.val();
        self.is_last.d.next = self.output_is_last.q.val();
        self.cleared_context.d.next = self.output_context.q.val();

        self.after_cleared.next = self.cleared.q.val() + self.one.val();
        self.before_last.next = self.last_id.val() - self.one.val();
        if self.sweeping.q.val() {
            self.cleared.d.next = self.after_cleared.val();
            self.sweeping.d.next = self.cleared.q.val() != self.before_last.val();
        }
        if self.reset.val() {
            self.works.d.next = false;
            self.array_valid.d.next = false;
            self.array_is_last.d.next = false;
            self.output_valid.d.next = false;
            self.output_is_last.d.next = false;
            self.clears.d.next = false;
            self.cleared.d.next = self.before_first.val();
            self.is_last.d.next = false;
            self.sweeping.d.next = true;
        }
    }
}
