//! The insertion engine: points in, triangle records kept, many insertions in flight on one pipeline.
//!
//! ```text
//!                 +------------------- visits, one to three a push -----------------------------+
//!                 v                                                                            |
//! points -> VisitPipeline -> completion -> Insertions: Dispatcher (who starts) -- Attempts (what follows) -- CommitPath
//!                 ^               |                                                                 |      |
//!                 |               +-> Seeder (the first triangle), Solo (alone) -> WritePort <------+      | locks
//!                 +---------------------------------------------------------------------+  <--------------+
//! ```
//! Latency: see the blocks.

use super::insertions::Insertions;
use super::seed::Seeder;
use super::solo::Solo;
use super::types::{Deal, Events, Write};
use super::visit::{PushPort, VisitPipeline};
use super::write::WritePort;
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

/// The engine; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct InsertionEngine {
    /// Reset forgets everything but the memories, and sweeps the locks.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// Parameters, constants.
    pub infinite: Signal<In, Bits<15>>,
    pub ring: Signal<In, Bits<7>>,
    pub last_id: Signal<In, Bits<15>>,
    pub all: Signal<In, Bits<24>>,
    pub patience: Signal<In, Bits<22>>,
    /// Contexts that work, and which points are theirs; changes only with `clears`.
    pub deal: Signal<In, Deal>,
    /// Forget the mesh at this edge; only while quiet.
    pub clears: Signal<In, Bit>,
    /// A point is stored at this edge; points that have come.
    pub came: Signal<In, Bit>,
    pub came_id: Signal<In, Bits<15>>,
    pub point: Signal<In, Bits<32>>,
    pub arrived: Signal<In, Bits<15>>,
    pub read: Signal<In, Bit>,
    pub read_id: Signal<In, Bits<15>>,
    /// The time.
    pub now: Signal<In, Bits<22>>,
    pub read_done: Signal<Out, Bit>,
    pub v0: Signal<Out, Bits<15>>,
    pub v1: Signal<Out, Bits<15>>,
    pub v2: Signal<Out, Bits<15>>,
    /// Column read.
    pub n0: Signal<Out, Bits<15>>,
    /// Column read.
    pub n1: Signal<Out, Bits<15>>,
    /// Column read.
    pub n2: Signal<Out, Bits<15>>,
    pub was_set: Signal<Out, Bit>,
    /// State of the mesh, see `Seeder`.
    pub start_is_open: Signal<Out, Bit>,
    pub collinear: Signal<Out, Bit>,
    pub records: Signal<Out, Bits<15>>,
    /// Every point is finished; nothing is finished any more; locks are being swept.
    pub is_quiet: Signal<Out, Bit>,
    pub stuck: Signal<Out, Bit>,
    pub sweeps: Signal<Out, Bit>,
    /// The write port of the triangle memory.
    pub write: Signal<Out, Write>,
    /// What happens at this edge, for the counters.
    pub events: Signal<Out, Events>,
    insertions: Insertions,
    pipeline: VisitPipeline,
    solo: Solo,
    seeder: Seeder,
    push_port: PushPort,
    write_port: WritePort,
}

impl InsertionEngine {
    /// The engine of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        Self { insertions: Insertions::new(config), pipeline: VisitPipeline::new(config), ..Self::default() }
    }
}

impl Logic for InsertionEngine {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, insertions, pipeline, solo, seeder, push_port, write_port);
        self.insertions.reset.next = self.reset.val();
        self.pipeline.reset.next = self.reset.val();
        self.solo.reset.next = self.reset.val();
        self.seeder.reset.next = self.reset.val();
        self.push_port.reset.next = self.reset.val();
        self.write_port.reset.next = self.reset.val();
        self.insertions.clears.next = self.clears.val();
        self.seeder.clears.next = self.clears.val();

        // What the link sees.
        self.start_is_open.next = self.seeder.start_is_open.val();
        self.collinear.next = self.seeder.collinear.val();
        self.records.next = self.insertions.records.val();
        self.is_quiet.next = self.insertions.is_quiet.val();
        self.stuck.next = self.insertions.stuck.val();
        self.sweeps.next = self.insertions.sweeps.val();
        self.read_done.next = self.pipeline.read_done.val();
        self.v0.next = self.pipeline.v0.val();
        self.v1.next = self.pipeline.v1.val();
        self.v2.next = self.pipeline.v2.val();
        self.n0.next = self.pipeline.n0.val();
        self.n1.next = self.pipeline.n1.val();
        self.n2.next = self.pipeline.n2.val();
        self.was_set.next = self.pipeline.was_set.val();
        self.write.next = self.write_port.write.val();

        // The visits.
        self.pipeline.infinite.next = self.infinite.val();
        self.pipeline.records.next = self.insertions.records.val();
        self.pipeline.push.next = self.push_port.push.val();
        self.pipeline.bundle.next = self.push_port.bundle.val();
        self.pipeline.position_enable.next = self.insertions.position_enable.val();
        self.pipeline.position_owner.next = self.insertions.position_owner.val();
        self.pipeline.position.next = self.pipeline.fetched.val();
        self.pipeline.read.next = self.read.val();
        self.pipeline.read_id.next = self.read_id.val();
        self.pipeline.write.next = self.write_port.write.val();
        self.pipeline.enables.next = self.write_port.enables.val();
        self.pipeline.vertex_id.next = self.came_id.val();
        self.pipeline.vertex_position.next = self.point.val();
        self.pipeline.vertex_enable.next = self.came.val();
        self.pipeline.fetch_id.next = self.insertions.fetch_id.val();
        self.pipeline.clear_id.next = self.insertions.clear_id.val();
        self.pipeline.clear_enable.next = self.insertions.clear_enable.val();

        // The insertions in flight. No visit is out when an insertion alone starts or ends, so a clock earlier makes no difference.
        self.insertions.ring.next = self.ring.val();
        self.insertions.last_id.next = self.last_id.val();
        self.insertions.all.next = self.all.val();
        self.insertions.patience.next = self.patience.val();
        self.insertions.deal.next = self.deal.val();
        self.insertions.arrived.next = self.arrived.val();
        self.insertions.came.next = self.came.val();
        self.insertions.now.next = self.now.val();
        self.insertions.early_done.next =
            self.pipeline.early_done.val() & (!self.solo.is_at_work.val()) & (!self.reset.val());
        self.insertions.early_token.next = self.pipeline.early_token.val();
        self.insertions.early_turned.next = self.pipeline.early_turned.val();
        self.insertions.token.next = self.pipeline.token.val();
        self.insertions.turned.next = self.pipeline.turned.val();
        self.insertions.verdict.next = self.pipeline.verdict.val();
        self.insertions.seeded.next = self.seeder.seeded.val();
        self.insertions.seeds.next = self.seeder.seeds.val();
        self.insertions.has_no_start.next = self.seeder.has_no_start.val();
        self.insertions.solo_is_at_work.next = self.solo.is_at_work.val();
        self.insertions.solo_ends.next = self.solo.ends.val();
        self.insertions.solo_inserts.next = self.solo.inserts.val();

        // The first triangle, and an insertion alone.
        self.seeder.infinite.next = self.infinite.val();
        self.seeder.deal.next = self.deal.val();
        self.seeder.came.next = self.came.val();
        self.seeder.came_id.next = self.came_id.val();
        self.seeder.arrived.next = self.arrived.val();
        self.seeder.looks.next = self.insertions.looks.val();
        self.seeder.verdict.next = self.pipeline.verdict.val();
        self.solo.starts.next = self.insertions.solo_starts.val();
        self.solo.owner.next = self.insertions.solo_owner.val();
        self.solo.p.next = self.insertions.solo_p.val();
        self.solo.start.next = self.insertions.u.val();
        self.solo.records.next = self.insertions.fresh.val();
        self.solo.done.next = self.pipeline.done.val();
        self.solo.token.next = self.pipeline.token.val();
        self.solo.turned.next = self.pipeline.turned.val();
        self.solo.verdict.next = self.pipeline.verdict.val();

        // Who pushes visits, and who writes.
        self.push_port.asks.next = self.insertions.asks.val();
        self.push_port.may_ask.next = self.insertions.may_ask.val();
        self.push_port.follows.next = self.insertions.follows.val();
        self.push_port.starts.next = self.insertions.starts.val();
        self.push_port.starter.next = self.insertions.starter.val();
        self.push_port.u.next = self.insertions.u.val();
        self.push_port.is_alone.next = self.solo.is_at_work.val();
        self.push_port.solo_asks.next = self.solo.push.val();
        self.push_port.solo.next = self.solo.bundle.val();
        self.write_port.commit.next = self.insertions.write.val();
        self.write_port.solo.next = self.solo.write.val();
        self.write_port.seed.next = self.seeder.write.val();
        self.events.next = self.insertions.events.val();
        self.events.next.solo_test = self.solo.tests.val();
        self.events.next.flip = self.solo.flips.val();
        self.events.next.is_issuing = self.pipeline.is_issuing.val();
        self.events.next.is_writing = self.write_port.write.val().valid;
    }
}
