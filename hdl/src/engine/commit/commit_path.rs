//! From finished rings to written stars and released locks.
//!
//! 1. The locks of a ring are released when its last record is on its way to the memory: it is there before the first lock is
//!    clear (L4).
//! 2. Locks are logged a clock after they come: the log lies far from the logic that finds them. The job that comes with the last of
//!    them is not read from until two clocks later.
//!
//! Latency: see the blocks.

use super::commit::Commit;
use super::release::Release;
use super::ring_reader::RingReader;
use crate::engine::types::{CommitJob, Entry, ReleaseJob, Write};
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Rings to stars; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct CommitPath {
    /// Reset drops all rings; clear forgets the records.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// The highest record id, a constant.
    pub last_id: Signal<In, Bits<15>>,
    /// The context of the next twelve.
    pub owner: Signal<In, Bits<5>>,
    /// A final edge of the boundary.
    pub entry_enable: Signal<In, Bit>,
    pub entry_place: Signal<In, Bits<6>>,
    pub entry: Signal<In, Entry>,
    /// An inner triangle.
    pub inner_enable: Signal<In, Bit>,
    pub inner_place: Signal<In, Bits<6>>,
    pub inner_id: Signal<In, Bits<15>>,
    /// A lock for the log.
    pub lock_enable: Signal<In, Bit>,
    pub lock_place: Signal<In, Bits<7>>,
    pub lock_id: Signal<In, Bits<15>>,
    /// A ring is finished; a failed attempt's locks.
    pub commit_enable: Signal<In, Bit>,
    pub commit_job: Signal<In, CommitJob>,
    pub release_enable: Signal<In, Bit>,
    pub release_job: Signal<In, ReleaseJob>,
    /// The first four records, two more records are written by others.
    pub seeds: Signal<In, Bit>,
    pub solo_inserts: Signal<In, Bit>,
    /// A record or a link.
    pub write: Signal<Out, Write>,
    /// A ring is written; which; a record of its star.
    pub ends: Signal<Out, Bit>,
    pub job: Signal<Out, CommitJob>,
    pub hint: Signal<Out, Bits<15>>,
    /// Records from this id on are not written yet; the next new id.
    pub records: Signal<Out, Bits<15>>,
    pub fresh: Signal<Out, Bits<15>>,
    /// A ring is being written.
    pub is_at_work: Signal<Out, Bit>,
    /// A lock to clear.
    pub clear_enable: Signal<Out, Bit>,
    pub clear_id: Signal<Out, Bits<15>>,
    /// The last lock of a context is cleared.
    pub released: Signal<Out, Bit>,
    pub released_owner: Signal<Out, Bits<5>>,
    /// The lock memory is being cleared after reset.
    pub sweeps: Signal<Out, Bit>,
    rings: RingReader,
    commit: Commit,
    lock_release: Release,
    list_owner: DFF<Bits<5>>,
    lock_comes: DFF<Bit>,
    lock_at: DFF<Bits<7>>,
    lock: DFF<Bits<15>>,
}

impl CommitPath {
    /// The path of a configuration.
    pub fn new(config: Config) -> Self {
        Self {
            rings: RingReader::new(config),
            commit: Commit::new(config),
            lock_release: Release::new(config),
            ..Self::default()
        }
    }
}

impl Logic for CommitPath {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, list_owner);
        dff_setup!(self, clock, lock_comes, lock_at, lock);
        clock!(self, clock, rings, commit, lock_release);
        self.list_owner.d.next = self.owner.val();
        self.lock_comes.d.next = self.lock_enable.val();
        self.lock_at.d.next = self.lock_place.val();
        self.lock.d.next = self.lock_id.val();
        self.rings.reset.next = self.reset.val();
        self.commit.reset.next = self.reset.val();
        self.lock_release.reset.next = self.reset.val();

        // Entry by entry into the ring reader, whole rings out of it.
        self.rings.entry_enable.next = self.entry_enable.val();
        self.rings.entry_owner.next = self.owner.val();
        self.rings.entry_place.next = self.entry_place.val();
        self.rings.entry.next = self.entry.val();
        self.rings.job_enable.next = self.commit_enable.val();
        self.rings.job.next = self.commit_job.val();
        self.rings.takes.next = self.commit.takes.val();

        // The star.
        self.commit.clears.next = self.clears.val();
        self.commit.seeds.next = self.seeds.val();
        self.commit.solo_inserts.next = self.solo_inserts.val();
        self.commit.inner_enable.next = self.inner_enable.val();
        self.commit.inner_owner.next = self.owner.val();
        self.commit.inner_place.next = self.inner_place.val();
        self.commit.inner_id.next = self.inner_id.val();
        self.commit.head_valid.next = self.rings.head_valid.val();
        self.commit.head.next = self.rings.head.val();
        self.commit.head_is_last.next = self.rings.head_is_last.val();
        self.commit.head_shares.next = self.rings.head_shares.val();
        self.commit.head_job.next = self.rings.head_job.val();
        self.write.next = self.commit.write.val();
        self.ends.next = self.commit.ends.val();
        self.job.next = self.commit.job.val();
        self.hint.next = self.commit.hint.val();
        self.records.next = self.commit.records.val();
        self.fresh.next = self.commit.fresh.val();
        self.is_at_work.next = self.commit.is_at_work.val();

        // The locks.
        self.lock_release.last_id.next = self.last_id.val();
        self.lock_release.lock_enable.next = self.lock_comes.q.val();
        self.lock_release.lock_owner.next = self.list_owner.q.val();
        self.lock_release.lock_place.next = self.lock_at.q.val();
        self.lock_release.lock_id.next = self.lock.q.val();
        // L4: a ring's locks are due at its last write, not when the ring is finished.
        self.lock_release.commit_enable.next = self.commit.ends.val();
        self.lock_release.commit_job.next.owner = self.commit.job.val().owner;
        self.lock_release.commit_job.next.locks = self.commit.job.val().locks;
        self.lock_release.failure_enable.next = self.release_enable.val();
        self.lock_release.failure_job.next = self.release_job.val();
        self.clear_enable.next = self.lock_release.clear_enable.val();
        self.clear_id.next = self.lock_release.clear_id.val();
        self.released.next = self.lock_release.released.val();
        self.released_owner.next = self.lock_release.released_owner.val();
        self.sweeps.next = self.lock_release.sweeps.val();
    }
}
