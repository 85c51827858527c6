//! The core: command stream in, answer stream out, one insertion engine between them.
//!
//! 1. All outputs are functions of registers.
//! 2. After reset the lock memory is swept, a clock for each record, and the histogram of latencies beside it; until then
//!    `command_ready` is low.
//!
//! ```text
//! commands -> CommandPort --- points ---> InsertionEngine
//! answers  <- Responder <---- records -------+   |
//!                 +--- AnswerHead, AnswerWords <- Counters, Latencies <- events
//! ```
//! Latency: see the blocks.

use crate::engine::{Counters, InsertionEngine, Latencies, Write};
use crate::link::types::EngineState;
use crate::link::{AnswerHead, AnswerSource, AnswerWords, CommandPort, CommandSink, Responder};
use crate::mesh::Record;
use incircle_protocol::{infinite_vertex, patience, triangle_capacity, Config, ConfigError};
use rust_hdl_core::prelude::*;

/// The core; see the top of this file.
#[derive(LogicBlock)]
pub struct Core {
    /// One clock; synchronous reset, active high.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub command: CommandSink,
    pub response: AnswerSource,
    /// The write port of the triangle memory, for simulation.
    pub write: Signal<Out, Write>,
    command_port: CommandPort,
    answer_head: AnswerHead,
    answer_words: AnswerWords,
    responder: Responder,
    engine: InsertionEngine,
    counters: Counters,
    latencies: Latencies,
    infinite: Constant<Bits<15>>,
    capacity: Constant<Bits<15>>,
    ring: Constant<Bits<7>>,
    last_id: Constant<Bits<15>>,
    contexts: Constant<Bits<5>>,
    all_contexts: Constant<Bits<24>>,
    patience: Constant<Bits<22>>,
    sweeps: Signal<Local, Bit>,
    engine_state: Signal<Local, EngineState>,
    record: Signal<Local, Record>,
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
            command: CommandSink::default(),
            response: AnswerSource::default(),
            write: Signal::default(),
            command_port: CommandPort::default(),
            answer_head: AnswerHead::default(),
            answer_words: AnswerWords::default(),
            responder: Responder::default(),
            engine: InsertionEngine::new(config),
            counters: Counters::default(),
            latencies: Latencies::default(),
            infinite: Constant::new(u64::from(infinite_vertex(config.points)).into()),
            capacity: Constant::new(u64::from(config.points).into()),
            ring: Constant::new(u64::from(config.ring).into()),
            last_id: Constant::new(u64::from(triangle_capacity(config.points) - 1).into()),
            contexts: Constant::new(u64::from(config.contexts).into()),
            all_contexts: Constant::new(((1u64 << config.contexts) - 1).into()),
            patience: Constant::new(u64::from(patience(config.points)).into()),
            sweeps: Signal::default(),
            engine_state: Signal::default(),
            record: Signal::default(),
        })
    }
}

impl Logic for Core {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, command_port, answer_head, answer_words, responder, engine, counters, latencies);
        self.command_port.reset.next = self.reset.val();
        self.responder.reset.next = self.reset.val();
        self.engine.reset.next = self.reset.val();
        self.counters.reset.next = self.reset.val();
        self.latencies.reset.next = self.reset.val();
        self.sweeps.next = self.engine.sweeps.val() | self.latencies.sweeps.val();

        // The command stream.
        self.command_port.capacity.next = self.capacity.val();
        self.command_port.built.next = self.contexts.val();
        CommandSink::link(&mut self.command, &mut self.command_port.command);
        self.command_port.sweeps.next = self.sweeps.val();
        self.engine_state.next.start_is_open = self.engine.start_is_open.val();
        self.engine_state.next.collinear = self.engine.collinear.val();
        self.engine_state.next.stuck = self.engine.stuck.val();
        self.engine_state.next.is_quiet = self.engine.is_quiet.val();
        self.command_port.engine.next = self.engine_state.val();
        self.command_port.answer.next = self.responder.progress.val();

        // The answer stream.
        self.answer_head.request.next = self.command_port.request.val();
        self.answer_head.is_refused.next = self.command_port.clearing.val().is_refused;
        self.answer_head.records.next = self.engine.records.val();
        self.answer_head.collinear.next = self.engine.collinear.val();
        self.answer_head.stuck.next = self.engine.stuck.val();
        self.answer_head.some_refused.next = self.command_port.tally.val().some_refused;
        self.answer_words.opcode.next = self.command_port.request.val().opcode;
        self.answer_words.tally.next = self.command_port.tally.val();
        self.answer_words.capacity.next = self.capacity.val();
        self.answer_words.contexts.next = self.contexts.val();
        self.answer_words.ring.next = self.ring.val();
        self.answer_words.records.next = self.engine.records.val();
        self.answer_words.insertions.next = self.counters.insertions.val();
        self.answer_words.duplicates.next = self.counters.duplicates.val();
        self.answer_words.index.next = self.responder.index.val();
        self.answer_words.chooses.next = self.responder.chooses.val();
        self.answer_words.counter.next = self.counters.value.val();
        self.answer_words.latency.next = self.latencies.value.val();
        self.responder.answers.next = self.command_port.answers.val();
        self.responder.sweeps.next = self.latencies.sweeps.val();
        self.responder.request.next = self.command_port.request.val();
        self.responder.head.next = self.answer_head.head.val();
        self.responder.word.next = self.answer_words.word.val();
        self.responder.read_done.next = self.engine.read_done.val();
        self.record.next.v0 = self.engine.v0.val();
        self.record.next.v1 = self.engine.v1.val();
        self.record.next.v2 = self.engine.v2.val();
        self.record.next.n0 = self.engine.n0.val();
        self.record.next.n1 = self.engine.n1.val();
        self.record.next.n2 = self.engine.n2.val();
        self.record.next.was_set = self.engine.was_set.val();
        self.responder.record.next = self.record.val();
        AnswerSource::link(&mut self.response, &mut self.responder.response);

        // The engine.
        self.engine.infinite.next = self.infinite.val();
        self.engine.ring.next = self.ring.val();
        self.engine.last_id.next = self.last_id.val();
        self.engine.all.next = self.all_contexts.val();
        self.engine.patience.next = self.patience.val();
        self.engine.deal.next = self.command_port.deal.val();
        self.engine.clears.next = self.command_port.clearing.val().clears;
        self.engine.came.next = self.command_port.arrival.val().came;
        self.engine.came_id.next = self.command_port.arrival.val().id;
        self.engine.point.next = self.command_port.arrival.val().point;
        self.engine.arrived.next = self.command_port.tally.val().arrived;
        self.engine.read.next = self.responder.read.val();
        self.engine.read_id.next = self.responder.read_id.val();
        self.engine.now.next = self.counters.now.val();
        self.write.next = self.engine.write.val();

        // The counters.
        self.counters.clears.next = self.command_port.clearing.val().clears;
        self.counters.inserting.next = self.command_port.activity.val().inserting;
        self.counters.waiting.next = self.command_port.activity.val().inserting
            & self.command_port.activity.val().awaits_point
            & self.engine.is_quiet.val();
        self.counters.reading.next = self.command_port.activity.val().reading;
        self.counters.seeds.next = self.engine.events.val().seeds;
        self.counters.commit_ends.next = self.engine.events.val().commit_ends;
        self.counters.since.next = self.engine.events.val().since;
        self.counters.solo_inserts.next = self.engine.events.val().solo_inserts;
        self.counters.solo_duplicate.next = self.engine.events.val().solo_duplicate;
        self.counters.solo_test.next = self.engine.events.val().solo_test;
        self.counters.flip.next = self.engine.events.val().flip;
        self.counters.duplicate.next = self.engine.events.val().duplicate;
        self.counters.walk_visit.next = self.engine.events.val().walk_visit;
        self.counters.root_visit.next = self.engine.events.val().root_visit;
        self.counters.test.next = self.engine.events.val().test;
        self.counters.revisit.next = self.engine.events.val().revisit;
        self.counters.overflows.next = self.engine.events.val().overflow;
        self.counters.gives_up.next = self.engine.events.val().gives_up;
        self.counters.retries.next = self.engine.events.val().root_retry;
        self.counters.takes_token.next = self.engine.events.val().takes_token;
        self.counters.cavity_ends.next = self.engine.events.val().cavity_ends;
        self.counters.cavity_triangles.next = self.engine.events.val().cavity_triangles;
        self.counters.is_issuing.next = self.engine.events.val().is_issuing;
        self.counters.is_writing.next = self.engine.events.val().is_writing;
        self.counters.is_committing.next = self.engine.events.val().is_committing;
        self.counters.is_releasing.next = self.engine.events.val().is_releasing;
        self.counters.refused.next = self.command_port.tally.val().refused;
        self.counters.select.next = self.responder.index_ahead.val().get_bits::<5>(0);
        self.latencies.clears.next = self.command_port.clearing.val().clears;
        self.latencies.comes.next = self.counters.latency_comes.val();
        self.latencies.latency.next = self.counters.latency.val();
        self.latencies.select.next = self.responder.index.val();
    }
}
