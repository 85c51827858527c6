//! From complete rings to written stars and released locks.
//!
//! 1. The locks of a ring are released when its last write is on the way to the memory. The write arrives before the
//!    first of the locks is clear (L4).
//! 2. Locks are logged a clock after they come, because the log lies far from the logic that finds them. The job that
//!    comes with the last of the locks reads the log two clocks later at the earliest.

use super::commit::Commit;
use super::fresh_ids::FreshIds;
use super::release::Release;
use super::ring_reader::RingReader;
use crate::engine::types::{
    CommitJob, CommitRequest, Committed, EntryWrite, InnerWrite, LockClear, LockWrite, ReleaseJob, ReleaseRequest,
    Released, TriangleId, Write,
};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct CommitPath {
    pub clock: Signal<In, Clock>,
    /// Reset drops all rings; clear forgets the records.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// The highest record id, a constant.
    pub last_id: Signal<In, TriangleId>,
    /// Additions to the lists of a context: a final entry, an inner record, a lock.
    pub entry: Signal<In, EntryWrite>,
    pub inner: Signal<In, InnerWrite>,
    pub lock: Signal<In, LockWrite>,
    /// A ring is complete; or the locks of an attempt that ended without a commit are due.
    pub commit: Signal<In, CommitRequest>,
    pub releases: Signal<In, ReleaseRequest>,
    /// The seeder has written four new records, or a solo insertion two; only while no commit is at work.
    pub seeds: Signal<In, Bit>,
    pub solo_inserts: Signal<In, Bit>,
    /// A record or a link.
    pub write: Signal<Out, Write>,
    /// The last write of a ring is requested at this edge.
    pub committed: Signal<Out, Committed>,
    /// Records from `records` on are not written yet; `fresh` is the next new id.
    pub records: Signal<Out, TriangleId>,
    pub fresh: Signal<Out, TriangleId>,
    /// A ring is being written.
    pub is_at_work: Signal<Out, Bit>,
    /// A lock to clear at this edge; with the last lock of a context also `released`.
    pub clear: Signal<Out, LockClear>,
    pub released: Signal<Out, Released>,
    /// The lock memory is being cleared after reset.
    pub sweeps: Signal<Out, Bit>,
    rings: RingReader,
    star: Commit,
    ids: FreshIds,
    locks: Release,
    logged: DFF<LockWrite>,
    job: Signal<Local, CommitJob>,
    written_locks: Signal<Local, ReleaseJob>,
}

impl CommitPath {
    pub fn new(config: Config) -> Self {
        Self {
            rings: RingReader::new(config),
            star: Commit::new(config),
            locks: Release::new(config),
            ..Self::default()
        }
    }
}

impl Logic for CommitPath {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, logged);
        clock!(self, clock, rings, star, ids, locks);
        self.rings.reset.next = self.reset.val();
        self.star.reset.next = self.reset.val();
        self.ids.reset.next = self.reset.val();
        self.locks.reset.next = self.reset.val();

        self.rings.entry.next = self.entry.val();
        self.rings.commit.next = self.commit.val();
        self.rings.takes.next = self.star.takes.val();

        self.star.inner.next = self.inner.val();
        self.star.head.next = self.rings.head.val();
        self.star.head_job.next = self.rings.head_job.val();
        self.star.fresh.next = self.ids.fresh.val();
        self.write.next = self.star.write.val();
        self.committed.next = self.star.committed.val();
        self.is_at_work.next = self.star.is_at_work.val();

        self.ids.takes.next = self.star.takes_fresh.val();
        self.ids.ends.next = self.star.committed.val().valid;
        self.ids.solo_inserts.next = self.solo_inserts.val();
        self.ids.seeds.next = self.seeds.val();
        self.ids.clears.next = self.clears.val();
        self.records.next = self.ids.records.val();
        self.fresh.next = self.ids.fresh.val();

        // L4: the locks of a ring are due at its last write, not when the ring is complete. A lock released earlier
        // would let another context read a record that is only half replaced.
        self.logged.d.next = self.lock.val();
        self.job.next = self.star.committed.val().job;
        self.written_locks.next.context = self.job.val().context;
        self.written_locks.next.locks = self.job.val().locks;
        self.locks.last_id.next = self.last_id.val();
        self.locks.lock.next = self.logged.q.val();
        self.locks.commit.next.valid = self.star.committed.val().valid;
        self.locks.commit.next.job = self.written_locks.val();
        self.locks.failure.next = self.releases.val();
        self.clear.next = self.locks.clear.val();
        self.released.next = self.locks.released.val();
        self.sweeps.next = self.locks.sweeps.val();
    }
}
