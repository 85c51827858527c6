//! From complete rings to written stars and released locks.
//!
//! 1. The locks of a ring are released when its last write is on the way to the memory. The write arrives before the
//!    first of the locks is clear (L4).
//! 2. Locks are logged a clock after they come, because the log lies far from the logic that finds them. The job that
//!    comes with the last of the locks reads the log two clocks later at the earliest.

use super::commit::Commit;
use super::fresh_ids::FreshIds;
use super::kept_ids::KeptIds;
use super::release::Release;
use super::ring_reader::RingReader;
use crate::engine::types::{
    Arrival, CommitJob, CommitRequest, Committed, EntryWrite, InnerWrite, KeptWrite, LockClear, LockWrite, Moving,
    ReleaseJob, ReleaseRequest, Released, SoloProgress, SoloStart, Start, TriangleId, VertexId, Visit, Write,
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
    /// In a core with deletions: a hole requests a write in the next clock, so a commit requests none (`holds`); the
    /// last write of a deletion is requested; a solo insertion starts or is at work, and its two ids; ids that were
    /// kept are in use again; and the ports of [`KeptIds`] of these names.
    pub holds: Vec<Signal<In, Bit>>,
    pub start: Vec<Signal<In, Start>>,
    pub owns: Vec<Signal<In, Bit>>,
    pub moving: Vec<Signal<In, Moving>>,
    pub visit: Vec<Signal<In, Visit>>,
    pub vertex: Vec<Signal<In, VertexId>>,
    pub is_duplicate: Vec<Signal<In, Bit>>,
    pub owned: Vec<Signal<Out, Bit>>,
    pub moved: Vec<Signal<In, Arrival>>,
    pub late_point: Vec<Signal<Out, Arrival>>,
    pub kept: Vec<Signal<In, KeptWrite>>,
    pub erases: Vec<Signal<In, Bit>>,
    pub erased: Vec<Signal<In, ReleaseRequest>>,
    pub solo_start: Vec<Signal<In, SoloStart>>,
    pub solo: Vec<Signal<In, SoloProgress>>,
    pub solo_first: Vec<Signal<Out, TriangleId>>,
    pub solo_second: Vec<Signal<Out, TriangleId>>,
    pub returns: Vec<Signal<Out, Bit>>,
    kept_ids: Vec<KeptIds>,
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

    /// The commits of a core with deletions.
    pub fn with_deletions(config: Config) -> Self {
        Self {
            star: Commit::with_deletions(config),
            ids: FreshIds::with_deletions(),
            holds: vec![Signal::default()],
            start: vec![Signal::default()],
            owns: vec![Signal::default()],
            moving: vec![Signal::default()],
            visit: vec![Signal::default()],
            vertex: vec![Signal::default()],
            is_duplicate: vec![Signal::default()],
            owned: vec![Signal::default()],
            moved: vec![Signal::default()],
            late_point: vec![Signal::default()],
            kept: vec![Signal::default()],
            erases: vec![Signal::default()],
            erased: vec![Signal::default()],
            solo_start: vec![Signal::default()],
            solo: vec![Signal::default()],
            solo_first: vec![Signal::default()],
            solo_second: vec![Signal::default()],
            returns: vec![Signal::default()],
            kept_ids: vec![KeptIds::new(config)],
            ..Self::new(config)
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

        // A vertex that comes back takes the two ids that were kept for it, and no new ones.
        for i in 0..self.kept_ids.len() {
            self.kept_ids[i].clock.next = self.clock.val();
            self.star.holds[i].next = self.holds[i].val();
            self.kept_ids[i].start.next = self.start[i].val();
            self.kept_ids[i].owns.next = self.owns[i].val();
            self.kept_ids[i].moving.next = self.moving[i].val();
            self.kept_ids[i].visit.next = self.visit[i].val();
            self.kept_ids[i].vertex.next = self.vertex[i].val();
            self.kept_ids[i].is_duplicate.next = self.is_duplicate[i].val();
            self.owned[i].next = self.kept_ids[i].owned.val();
            self.kept_ids[i].moved.next = self.moved[i].val();
            self.late_point[i].next = self.kept_ids[i].late_point.val();
            self.kept_ids[i].kept.next = self.kept[i].val();
            self.kept_ids[i].commit.next = self.commit.val();
            self.kept_ids[i].job.next = self.rings.head_job.val();
            self.kept_ids[i].loads.next = self.star.loads[i].val();
            self.kept_ids[i].takes.next = self.star.takes_fresh.val();
            self.kept_ids[i].solo_start.next = self.solo_start[i].val();
            self.kept_ids[i].solo.next = self.solo[i].val();
            self.solo_first[i].next = self.ids.fresh.val();
            self.solo_second[i].next = self.ids.fresh_after[i].val();
            if self.kept_ids[i].owned.val() {
                self.solo_first[i].next = self.kept_ids[i].solo_first.val();
                self.solo_second[i].next = self.kept_ids[i].solo_second.val();
                self.ids.solo_inserts.next = false;
            }
            self.returns[i].next = (self.star.committed.val().valid & self.kept_ids[i].has_ids.val())
                | (self.solo_inserts.val() & self.kept_ids[i].owned.val());
            if self.kept_ids[i].has_ids.val() {
                self.star.fresh.next = self.kept_ids[i].id.val();
                self.ids.takes.next = false;
            }
            if self.erases[i].val() {
                self.locks.commit.next = self.erased[i].val();
            }
        }
    }
}
