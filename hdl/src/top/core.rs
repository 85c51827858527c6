//! The core: command stream in, answer stream out, one insertion engine between them.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | one clock; synchronous reset, active high |
//! | `command_valid`, `command_ready`, `command_data` | in, out, in | 1, 1, 32 | the command stream |
//! | `response_valid`, `response_ready`, `response_data` | out, in, out | 1, 1, 32 | the answer stream |
//! | `write` | out | Write | the write port of the triangle memory, for simulation |
//!
//! 1. All outputs are functions of registers.
//! 2. After reset the lock memory is swept, a clock for each record; until then `command_ready` is low.
//!
//! ```text
//! commands -> CommandPort -> Context -> VisitPipeline -> Cavity, Solo -> Commit -> WritePort
//! answers  <- Responder <--------------------+                 Release <-+
//! ```
//! Latency: see the blocks.

use crate::engine::{
    Cavity, Commit, Context, Counters, Release, Solo, VisitPipeline, Write, WritePort,
};
use crate::link::{AnswerWords, CommandPort, Responder};
use incircle_protocol::{infinite_vertex, triangle_capacity, Config, ConfigError};
use rust_hdl_core::prelude::*;

/// The core; see the top of this file.
#[derive(LogicBlock)]
pub struct Core {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Synchronous reset.
    pub reset: Signal<In, Bit>,
    /// A command word is offered.
    pub command_valid: Signal<In, Bit>,
    /// It is taken.
    pub command_ready: Signal<Out, Bit>,
    /// The word.
    pub command_data: Signal<In, Bits<32>>,
    /// An answer word is offered.
    pub response_valid: Signal<Out, Bit>,
    /// It is taken.
    pub response_ready: Signal<In, Bit>,
    /// The word.
    pub response_data: Signal<Out, Bits<32>>,
    /// The write port of the triangle memory.
    pub write: Signal<Out, Write>,
    command_port: CommandPort,
    answer_words: AnswerWords,
    responder: Responder,
    insertion: Context,
    pipeline: VisitPipeline,
    cavity: Cavity,
    commit: Commit,
    solo: Solo,
    lock_release: Release,
    write_port: WritePort,
    counters: Counters,
    is_quiet: Signal<Local, Bit>,
    cavity_triangles: Signal<Local, Bits<7>>,
    two: Signal<Local, Bits<7>>,
    infinite: Constant<Bits<15>>,
    capacity: Constant<Bits<15>>,
    ring: Constant<Bits<7>>,
    last_id: Constant<Bits<15>>,
}

impl Core {
    /// The core of a configuration.
    ///
    /// # Errors
    /// If a parameter is out of range; the error says which and what is possible.
    pub fn new(config: Config) -> Result<Self, ConfigError> {
        let config = config.check()?;
        Ok(Self {
            clock: Signal::default(),
            reset: Signal::default(),
            command_valid: Signal::default(),
            command_ready: Signal::default(),
            command_data: Signal::default(),
            response_valid: Signal::default(),
            response_ready: Signal::default(),
            response_data: Signal::default(),
            write: Signal::default(),
            command_port: CommandPort::default(),
            answer_words: AnswerWords::default(),
            responder: Responder::default(),
            insertion: Context::default(),
            pipeline: VisitPipeline::new(config),
            cavity: Cavity::new(config),
            commit: Commit::default(),
            solo: Solo::default(),
            lock_release: Release::new(config),
            write_port: WritePort::default(),
            counters: Counters::default(),
            is_quiet: Signal::default(),
            cavity_triangles: Signal::default(),
            two: Signal::default(),
            infinite: Constant::new(u64::from(infinite_vertex(config.points)).into()),
            capacity: Constant::new(u64::from(config.points).into()),
            ring: Constant::new(u64::from(config.ring).into()),
            last_id: Constant::new(u64::from(triangle_capacity(config.points) - 1).into()),
        })
    }
}

impl Logic for Core {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(
            self,
            clock,
            command_port,
            responder,
            insertion,
            pipeline,
            cavity,
            commit,
            solo,
            lock_release
        );
        clock!(self, clock, write_port, counters);
        self.two.next = 2.into();
        self.command_port.reset.next = self.reset.val();
        self.responder.reset.next = self.reset.val();
        self.insertion.reset.next = self.reset.val();
        self.pipeline.reset.next = self.reset.val();
        self.cavity.reset.next = self.reset.val();
        self.commit.reset.next = self.reset.val();
        self.solo.reset.next = self.reset.val();
        self.lock_release.reset.next = self.reset.val();
        self.write_port.reset.next = self.reset.val();
        self.counters.reset.next = self.reset.val();

        // The command stream.
        self.command_port.capacity.next = self.capacity.val();
        self.command_port.command_valid.next = self.command_valid.val();
        self.command_port.command_data.next = self.command_data.val();
        self.command_ready.next = self.command_port.command_ready.val();
        self.command_port.sweeps.next = self.lock_release.sweeps.val();
        self.command_port.seeded.next = self.insertion.seeded.val();
        self.command_port.collinear.next = self.insertion.collinear.val();
        self.is_quiet.next = self.insertion.is_idle.val()
            & (!self.command_port.point_valid.val())
            & (!self.lock_release.is_busy.val());
        self.command_port.is_quiet.next = self.is_quiet.val();
        self.command_port.takes_point.next = self.insertion.takes_point.val();
        self.command_port.responder_is_idle.next = self.responder.is_idle.val();
        self.command_port.answer_ends.next = self.responder.ends.val();
        self.command_port.answer_is_taken.next = self.responder.is_taken.val();

        // The answer stream.
        self.answer_words.opcode.next = self.command_port.opcode.val();
        self.answer_words.first.next = self.command_port.first.val();
        self.answer_words.count.next = self.command_port.count.val();
        self.answer_words.capacity.next = self.capacity.val();
        self.answer_words.ring.next = self.ring.val();
        self.answer_words.collinear.next = self.insertion.collinear.val();
        self.answer_words.arrived.next = self.command_port.arrived.val();
        self.answer_words.refused.next = self.command_port.refused.val();
        self.answer_words.insertions.next = self.counters.insertions.val();
        self.answer_words.duplicates.next = self.counters.duplicates.val();
        self.answer_words.records.next = self.insertion.records.val();
        self.answer_words.index.next = self.responder.index.val();
        self.answer_words.counter.next = self.counters.value.val();
        self.responder.answers.next = self.command_port.answers.val();
        self.responder.first.next = self.command_port.first.val();
        self.responder.header.next = self.answer_words.header.val();
        self.responder.length.next = self.answer_words.length.val();
        self.responder.word.next = self.answer_words.word.val();
        self.responder.is_read.next = self.answer_words.is_read.val();
        self.responder.read_done.next = self.pipeline.read_done.val();
        self.responder.v0.next = self.pipeline.v0.val();
        self.responder.v1.next = self.pipeline.v1.val();
        self.responder.v2.next = self.pipeline.v2.val();
        self.responder.n0.next = self.pipeline.n0.val();
        self.responder.n1.next = self.pipeline.n1.val();
        self.responder.n2.next = self.pipeline.n2.val();
        self.responder.was_set.next = self.pipeline.was_set.val();
        self.responder.response_ready.next = self.response_ready.val();
        self.response_valid.next = self.responder.response_valid.val();
        self.response_data.next = self.responder.response_data.val();

        // The visits.
        self.pipeline.infinite.next = self.infinite.val();
        self.pipeline.push.next = self.insertion.push.val();
        self.pipeline.bundle.next = self.insertion.bundle.val();
        self.pipeline.p.next = self.insertion.position.val();
        self.pipeline.read.next = self.responder.read.val();
        self.pipeline.read_id.next = self.responder.read_id.val();
        self.pipeline.write.next = self.write_port.write.val();
        self.pipeline.vertex_id.next = self.command_port.point_id.val();
        self.pipeline.vertex_position.next = self.command_port.point.val();
        self.pipeline.vertex_enable.next = self.command_port.vertex_enable.val();
        self.pipeline.clear_id.next = self.lock_release.clear_id.val();
        self.pipeline.clear_enable.next = self.lock_release.clear_enable.val();

        // The context.
        self.insertion.infinite.next = self.infinite.val();
        self.insertion.clears.next = self.command_port.clears.val();
        self.insertion.point_valid.next = self.command_port.point_valid.val();
        self.insertion.point_id.next = self.command_port.point_id.val();
        self.insertion.point.next = self.command_port.point.val();
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
        self.lock_release.takes_locks.next =
            self.insertion.is_cavity.val() | self.insertion.is_drain.val();
        self.lock_release.done.next = self.pipeline.done.val();
        self.lock_release.token.next = self.pipeline.token.val();
        self.lock_release.turned.next = self.pipeline.turned.val();
        self.lock_release.starts.next = self.commit.ends.val() | self.insertion.drained.val();
        self.write_port.commit.next = self.commit.write.val();
        self.write_port.solo.next = self.solo.write.val();
        self.write_port.seed.next = self.insertion.write.val();
        self.write.next = self.write_port.write.val();

        // The counters.
        self.cavity_triangles.next = self.cavity.count.val() - self.two.val();
        self.counters.clears.next = self.command_port.clears.val();
        self.counters.inserting.next = self.command_port.inserting.val();
        self.counters.waiting.next = self.command_port.inserting.val()
            & self.command_port.awaits_point.val()
            & self.is_quiet.val();
        self.counters.reading.next = self.command_port.reading.val();
        self.counters.seeds.next = self.insertion.seeds.val();
        self.counters.commit_ends.next = self.commit.ends.val();
        self.counters.solo_ends.next = self.solo.ends.val();
        self.counters.duplicate.next = self.insertion.duplicate.val();
        self.counters.walk_visit.next = self.insertion.walk_visit.val();
        self.counters.test.next = self.solo.tests.val()
            | (self.pipeline.done.val()
                & self.pipeline.token.val().rotates
                & self.pipeline.token.val().locks);
        self.counters.drained.next = self.insertion.drained.val();
        self.counters.flip.next = self.solo.flips.val();
        self.counters.cavity_triangles.next = self.cavity_triangles.val();
        self.counters.refused.next = self.command_port.refused.val();
        self.counters.select.next = self.responder.index.val();
    }
}
