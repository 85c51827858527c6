//! The insertion engine: points in, triangle records kept, one insertion at a time.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset forgets everything but the memories, and sweeps the locks |
//! | `infinite`, `ring`, `last_id` | in | 15, 7, 15 | parameters, constants |
//! | `clears` | in | 1 | forget the mesh at this edge; only while quiet |
//! | `point_valid`, `point_id`, `point`, `takes_point` | in, out | 1, 15, 32, 1 | the point that waits, taken when the engine is idle |
//! | `vertex_enable` | in | 1 | `point` goes into the vertex memory at this edge |
//! | `read`, `read_id`, `read_done`, `v0..n2`, `was_set` | in, out | | read-out of a record; only while quiet |
//! | `seeded`, `collinear`, `records` | out | 1, 1, 15 | state of the mesh |
//! | `is_quiet`, `sweeps` | out | 1 | nothing is at work; the locks are being swept |
//! | `write` | out | Write | the write port of the triangle memory |
//! | `seeds` ... `flip`, `cavity_triangles` | out | 1, 7 | events at this edge, for the counters |
//!
//! ```text
//!                   +---------------------- bundles <------------------------+
//!                   v                                                       |
//! points -> Context +-> VisitPipeline -> completion -> Cavity -> ring       | split
//!              ^                             |   |        +-> Commit -> WritePort -> memory
//!              +------ walk ---------------- +   +-> Solo ----------------^
//!                                            +-> Release -> locks
//! ```
//! Latency: see the blocks.

use super::{Cavity, Commit, Context, Release, Solo, VisitPipeline, Write, WritePort};
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

/// The engine; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct InsertionEngine {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Forgets everything but the memories.
    pub reset: Signal<In, Bit>,
    /// The infinite vertex.
    pub infinite: Signal<In, Bits<15>>,
    /// Entries of a boundary list.
    pub ring: Signal<In, Bits<7>>,
    /// The highest record id.
    pub last_id: Signal<In, Bits<15>>,
    /// Forget the mesh.
    pub clears: Signal<In, Bit>,
    /// A point waits.
    pub point_valid: Signal<In, Bit>,
    /// Its vertex id.
    pub point_id: Signal<In, Bits<15>>,
    /// Its coordinates.
    pub point: Signal<In, Bits<32>>,
    /// Write it into the vertex memory.
    pub vertex_enable: Signal<In, Bit>,
    /// A read-out wants a record.
    pub read: Signal<In, Bit>,
    /// The record.
    pub read_id: Signal<In, Bits<15>>,
    /// The waiting point is taken.
    pub takes_point: Signal<Out, Bit>,
    /// The first triangle stands.
    pub seeded: Signal<Out, Bit>,
    /// The first three points are collinear.
    pub collinear: Signal<Out, Bit>,
    /// Records of the mesh.
    pub records: Signal<Out, Bits<15>>,
    /// No point waits or is at work, and no lock is held.
    pub is_quiet: Signal<Out, Bit>,
    /// The lock memory is being cleared after reset.
    pub sweeps: Signal<Out, Bit>,
    /// The record read stands on the columns.
    pub read_done: Signal<Out, Bit>,
    /// Column read.
    pub v0: Signal<Out, Bits<15>>,
    /// Column read.
    pub v1: Signal<Out, Bits<15>>,
    /// Column read.
    pub v2: Signal<Out, Bits<15>>,
    /// Column read.
    pub n0: Signal<Out, Bits<15>>,
    /// Column read.
    pub n1: Signal<Out, Bits<15>>,
    /// Column read.
    pub n2: Signal<Out, Bits<15>>,
    /// Lock bit read.
    pub was_set: Signal<Out, Bit>,
    /// The write port of the triangle memory.
    pub write: Signal<Out, Write>,
    /// Event: the first triangle is finished.
    pub seeds: Signal<Out, Bit>,
    /// Event: a commit is finished.
    pub commit_ends: Signal<Out, Bit>,
    /// Event: an insertion alone is finished.
    pub solo_ends: Signal<Out, Bit>,
    /// Event: a duplicate is found.
    pub duplicate: Signal<Out, Bit>,
    /// Event: a visit of a walk.
    pub walk_visit: Signal<Out, Bit>,
    /// Event: a conflict test.
    pub test: Signal<Out, Bit>,
    /// Event: a list has overflowed.
    pub drained: Signal<Out, Bit>,
    /// Event: a flip.
    pub flip: Signal<Out, Bit>,
    /// Triangles that the commit replaces.
    pub cavity_triangles: Signal<Out, Bits<7>>,
    insertion: Context,
    pipeline: VisitPipeline,
    cavity: Cavity,
    commit: Commit,
    solo: Solo,
    lock_release: Release,
    write_port: WritePort,
    two: Signal<Local, Bits<7>>,
}

impl InsertionEngine {
    /// The engine of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        Self {
            pipeline: VisitPipeline::new(config),
            cavity: Cavity::new(config),
            lock_release: Release::new(config),
            ..Self::default()
        }
    }
}

impl Logic for InsertionEngine {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, insertion, pipeline, cavity, commit, solo, lock_release, write_port);
        self.two.next = 2.into();
        self.insertion.reset.next = self.reset.val();
        self.pipeline.reset.next = self.reset.val();
        self.cavity.reset.next = self.reset.val();
        self.commit.reset.next = self.reset.val();
        self.solo.reset.next = self.reset.val();
        self.lock_release.reset.next = self.reset.val();
        self.write_port.reset.next = self.reset.val();

        // What the link sees.
        self.takes_point.next = self.insertion.takes_point.val();
        self.seeded.next = self.insertion.seeded.val();
        self.collinear.next = self.insertion.collinear.val();
        self.records.next = self.insertion.records.val();
        self.is_quiet.next =
            self.insertion.is_idle.val() & (!self.point_valid.val()) & (!self.lock_release.is_busy.val());
        self.sweeps.next = self.lock_release.sweeps.val();
        self.read_done.next = self.pipeline.read_done.val();
        self.v0.next = self.pipeline.v0.val();
        self.v1.next = self.pipeline.v1.val();
        self.v2.next = self.pipeline.v2.val();
        self.n0.next = self.pipeline.n0.val();
        self.n1.next = self.pipeline.n1.val();
        self.n2.next = self.pipeline.n2.val();
        self.was_set.next = self.pipeline.was_set.val();
        self.write.next = self.write_port.write.val();
        self.seeds.next = self.insertion.seeds.val();
        self.commit_ends.next = self.commit.ends.val();
        self.solo_ends.next = self.solo.ends.val();
        self.duplicate.next = self.insertion.duplicate.val();
        self.walk_visit.next = self.insertion.walk_visit.val();
        self.test.next = self.solo.tests.val()
            | (self.pipeline.done.val() & self.pipeline.token.val().rotates & self.pipeline.token.val().locks);
        self.drained.next = self.insertion.drained.val();
        self.flip.next = self.solo.flips.val();
        self.cavity_triangles.next = self.cavity.count.val() - self.two.val();

        // The visits.
        self.pipeline.infinite.next = self.infinite.val();
        self.pipeline.push.next = self.insertion.push.val();
        self.pipeline.bundle.next = self.insertion.bundle.val();
        self.pipeline.p.next = self.insertion.position.val();
        self.pipeline.read.next = self.read.val();
        self.pipeline.read_id.next = self.read_id.val();
        self.pipeline.write.next = self.write_port.write.val();
        self.pipeline.vertex_id.next = self.point_id.val();
        self.pipeline.vertex_position.next = self.point.val();
        self.pipeline.vertex_enable.next = self.vertex_enable.val();
        self.pipeline.clear_id.next = self.lock_release.clear_id.val();
        self.pipeline.clear_enable.next = self.lock_release.clear_enable.val();

        // The context.
        self.insertion.infinite.next = self.infinite.val();
        self.insertion.clears.next = self.clears.val();
        self.insertion.point_valid.next = self.point_valid.val();
        self.insertion.point_id.next = self.point_id.val();
        self.insertion.point.next = self.point.val();
        self.insertion.done.next = self.pipeline.done.val();
        self.insertion.token.next = self.pipeline.token.val();
        self.insertion.turned.next = self.pipeline.turned.val();
        self.insertion.verdict.next = self.pipeline.verdict.val();
        self.insertion.split.next = self.cavity.split.val();
        self.insertion.split_bundle.next = self.cavity.split_bundle.val();
        self.insertion.overflows.next = self.cavity.overflows.val();
        self.insertion.nothing_is_out.next = self.cavity.nothing_is_out.val();
        self.insertion.commit_ends.next = self.commit.ends.val();
        self.insertion.takes_fresh.next = self.commit.takes_fresh.val();
        self.insertion.solo_push.next = self.solo.push.val();
        self.insertion.solo_bundle.next = self.solo.bundle.val();
        self.insertion.solo_ends.next = self.solo.ends.val();
        self.insertion.locks_are_held.next = self.lock_release.is_busy.val();

        // The cavity, the commit, the insertion alone, the locks.
        self.cavity.ring.next = self.ring.val();
        self.cavity.is_root.next = self.insertion.is_root.val();
        self.cavity.is_cavity.next = self.insertion.is_cavity.val();
        self.cavity.is_drain.next = self.insertion.is_drain.val();
        self.cavity.root_visits.next = self.insertion.root_visits.val();
        self.cavity.done.next = self.pipeline.done.val();
        self.cavity.token.next = self.pipeline.token.val();
        self.cavity.turned.next = self.pipeline.turned.val();
        self.cavity.verdict.next = self.pipeline.verdict.val();
        self.cavity.entry_pointer.next = self.commit.entry_pointer.val();
        self.cavity.inner_pointer.next = self.commit.inner_pointer.val();
        self.commit.starts.next = self.insertion.is_commit.val();
        self.commit.p.next = self.insertion.p.val();
        self.commit.records.next = self.insertion.records.val();
        self.commit.inner_count.next = self.cavity.inner_count.val();
        self.commit.entry.next = self.cavity.entry.val();
        self.commit.inner_id.next = self.cavity.inner_id.val();
        self.solo.starts.next = self.insertion.is_solo.val() & (!self.lock_release.is_busy.val());
        self.solo.p.next = self.insertion.p.val();
        self.solo.records.next = self.insertion.records.val();
        self.solo.root_id.next = self.insertion.root_id.val();
        self.solo.root.next = self.insertion.root.val();
        self.solo.done.next = self.pipeline.done.val();
        self.solo.token.next = self.pipeline.token.val();
        self.solo.turned.next = self.pipeline.turned.val();
        self.solo.verdict.next = self.pipeline.verdict.val();
        self.lock_release.last_id.next = self.last_id.val();
        self.lock_release.takes_locks.next = self.insertion.is_cavity.val() | self.insertion.is_drain.val();
        self.lock_release.done.next = self.pipeline.done.val();
        self.lock_release.token.next = self.pipeline.token.val();
        self.lock_release.turned.next = self.pipeline.turned.val();
        self.lock_release.starts.next = self.commit.ends.val() | self.insertion.drained.val();
        self.write_port.commit.next = self.commit.write.val();
        self.write_port.solo.next = self.solo.write.val();
        self.write_port.seed.next = self.insertion.write.val();
    }
}
