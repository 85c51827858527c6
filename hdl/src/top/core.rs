//! The core: one insertion engine between a command stream and an answer stream.
//!
//! 1. All outputs depend on registers only.
//! 2. After a reset the core clears the lock memory, one record a clock, and the histogram of latencies at the same
//!    time; `command_ready` is low until both are clear.
//!
//! ```text
//! commands -> CommandPort --- points ---> InsertionEngine
//! answers  <- Responder <---- records -------+   |
//!                 +--- AnswerHead, AnswerWords <- Counters, Latencies <- events
//! ```

use crate::commands::{AnswerHead, AnswerSource, AnswerWords, CommandPort, CommandSink, LivingTally, Responder};
use crate::engine::{
    Arrival, Bundle, ChangeEvents, Completion, ContextId, Counters, InsertionEngine, Latencies, Moving, NearVerdict,
    Position, Start, VertexId, Write,
};
use crate::leaf::Parameter;
use crate::living::types::Standing;
use crate::living::StandingView;
use crate::predicate::{Point, Sides};
use incircle_protocol::{infinite_vertex, patience, triangle_capacity, Config, ConfigError};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct Core {
    /// One clock, and a synchronous reset, active high, which lasts four clocks or more at power-up and one or more
    /// in a running core.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub command: CommandSink,
    pub response: AnswerSource,
    /// The write port of the triangle memory, for simulation.
    pub write: Signal<Out, Write>,
    /// In a core with runs: the word of the identity with the features.
    pub features: Vec<Signal<In, Bits<32>>>,
    /// In a core that answers questions: the ports of the engine for them, and what they must know of the core.
    pub question_runs: Vec<Signal<In, Bit>>,
    pub question_asks: Vec<Signal<In, Bit>>,
    pub question: Vec<Signal<In, Bundle>>,
    pub question_place: Vec<Signal<In, Position>>,
    pub completed: Vec<Signal<Out, Completion>>,
    pub sides: Vec<Signal<Out, Sides>>,
    pub nearest: Vec<Signal<Out, NearVerdict>>,
    pub standing: Vec<Signal<Out, Standing>>,
    /// For runs of changes: as the ports of the engine of these names; the point of an `Insert` that comes, the number
    /// of ids in use, and the ports of [`CommandPort`] for them; the capacity.
    pub launches: Vec<Signal<In, Bit>>,
    pub launch: Vec<Signal<In, Start>>,
    pub launch_stores: Vec<Signal<In, Bit>>,
    pub launch_arrival: Vec<Signal<In, Arrival>>,
    pub launch_context: Vec<Signal<In, ContextId>>,
    pub launch_vertex: Vec<Signal<In, VertexId>>,
    pub has_changed: Vec<Signal<In, Bit>>,
    pub is_pending: Vec<Signal<In, Bit>>,
    pub change_runs: Vec<Signal<In, Bit>>,
    pub changes: Vec<Signal<Out, ChangeEvents>>,
    pub arrival: Vec<Signal<Out, Arrival>>,
    pub arrived: Vec<Signal<Out, VertexId>>,
    pub most: Vec<Signal<Out, VertexId>>,
    pub point_waits: Vec<Signal<In, Bit>>,
    pub raises: Vec<Signal<In, Bit>>,
    pub raised: Vec<Signal<In, VertexId>>,
    /// For deletions and moves: as the ports of the engine of these names.
    pub launch_owns: Vec<Signal<In, Bit>>,
    pub deletes: Vec<Signal<In, Bit>>,
    pub moving: Vec<Signal<In, Moving>>,
    pub wanted: Vec<Signal<In, VertexId>>,
    pub fetches: Vec<Signal<Out, Bit>>,
    pub fetched: Vec<Signal<Out, Point>>,
    tally: Vec<LivingTally>,
    command_port: CommandPort,
    answer_head: AnswerHead,
    answer_words: AnswerWords,
    responder: Responder,
    engine: InsertionEngine,
    counters: Counters,
    latencies: Latencies,
    infinite: Parameter<Bits<15>>,
    capacity: Parameter<Bits<15>>,
    ring_capacity: Parameter<Bits<7>>,
    last_id: Parameter<Bits<15>>,
    contexts: Parameter<Bits<5>>,
    engines: Parameter<Bits<8>>,
    engine_number: Parameter<Bits<8>>,
    all_contexts: Parameter<Bits<24>>,
    patience: Parameter<Bits<22>>,
    sweeps: Signal<Local, Bit>,
    view: Vec<StandingView>,
}

impl Core {
    /// The first engine of a configuration, which is the core if it has no other.
    ///
    /// # Errors
    /// If a parameter is out of range; the error says which one and what is possible.
    pub fn new(config: Config) -> Result<Self, ConfigError> {
        Self::numbered(config, 0)
    }

    /// The engine of this number on a chip of a configuration.
    ///
    /// # Errors
    /// If a parameter is out of range; the error says which one and what is possible.
    pub fn numbered(config: Config, engine: u8) -> Result<Self, ConfigError> {
        let config = config.check()?;
        Ok(Self {
            engine: InsertionEngine::new(config),
            infinite: Parameter::new(u64::from(infinite_vertex(config.points)).into()),
            capacity: Parameter::new(u64::from(config.points).into()),
            ring_capacity: Parameter::new(u64::from(config.ring).into()),
            last_id: Parameter::new(u64::from(triangle_capacity(config.points) - 1).into()),
            contexts: Parameter::new(u64::from(config.contexts).into()),
            engines: Parameter::new(u64::from(config.engines).into()),
            engine_number: Parameter::new(u64::from(engine).into()),
            all_contexts: Parameter::new(((1u64 << config.contexts) - 1).into()),
            patience: Parameter::new(u64::from(patience(config.points)).into()),
            ..Self::default()
        })
    }
}

impl Core {
    /// The parts of the core that [`LivingCore`](super::LivingCore) puts questions around.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_runs(config: Config) -> Result<Self, ConfigError> {
        Ok(Self {
            engine: InsertionEngine::with_runs(config.check()?),
            command_port: CommandPort::with_runs(),
            answer_words: AnswerWords::with_features(),
            features: vec![Signal::default()],
            question_runs: vec![Signal::default()],
            question_asks: vec![Signal::default()],
            question: vec![Signal::default()],
            question_place: vec![Signal::default()],
            completed: vec![Signal::default()],
            sides: vec![Signal::default()],
            nearest: vec![Signal::default()],
            standing: vec![Signal::default()],
            launches: vec![Signal::default()],
            launch: vec![Signal::default()],
            launch_stores: vec![Signal::default()],
            launch_arrival: vec![Signal::default()],
            launch_context: vec![Signal::default()],
            launch_vertex: vec![Signal::default()],
            has_changed: vec![Signal::default()],
            is_pending: vec![Signal::default()],
            change_runs: vec![Signal::default()],
            changes: vec![Signal::default()],
            arrival: vec![Signal::default()],
            arrived: vec![Signal::default()],
            most: vec![Signal::default()],
            point_waits: vec![Signal::default()],
            raises: vec![Signal::default()],
            raised: vec![Signal::default()],
            responder: Responder::with_deletions(),
            launch_owns: vec![Signal::default()],
            deletes: vec![Signal::default()],
            moving: vec![Signal::default()],
            wanted: vec![Signal::default()],
            fetches: vec![Signal::default()],
            fetched: vec![Signal::default()],
            tally: vec![LivingTally::default()],
            view: vec![StandingView::default()],
            ..Self::new(config)?
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
        self.sweeps.next = self.engine.state.val().sweeps | self.latencies.sweeps.val();

        self.command_port.capacity.next = self.capacity.val();
        self.command_port.built.next = self.contexts.val();
        CommandSink::link(&mut self.command, &mut self.command_port.command);
        self.command_port.sweeps.next = self.sweeps.val();
        self.command_port.engine.next = self.engine.state.val();
        self.command_port.answer.next = self.responder.progress.val();

        self.answer_head.request.next = self.command_port.request.val();
        self.answer_head.clearing.next = self.command_port.clearing.val();
        self.answer_head.engine.next = self.engine_number.val();
        self.answer_head.records.next = self.engine.state.val().records;
        self.answer_head.collinear.next = self.engine.state.val().collinear;
        self.answer_head.stuck.next = self.engine.state.val().stuck;
        self.answer_head.some_refused.next = self.command_port.tally.val().some_refused;
        self.answer_words.opcode.next = self.command_port.request.val().opcode;
        self.answer_words.tally.next = self.command_port.tally.val();
        self.answer_words.capacity.next = self.capacity.val();
        self.answer_words.contexts.next = self.contexts.val();
        self.answer_words.engines.next = self.engines.val();
        self.answer_words.ring_capacity.next = self.ring_capacity.val();
        self.answer_words.records.next = self.engine.state.val().records;
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
        self.responder.read_done.next = self.engine.read_out.val().valid;
        self.responder.record.next = self.engine.read_out.val().record;
        AnswerSource::link(&mut self.response, &mut self.responder.response);

        self.engine.limits.next.infinite = self.infinite.val();
        self.engine.limits.next.ring_capacity = self.ring_capacity.val();
        self.engine.limits.next.last_id = self.last_id.val();
        self.engine.limits.next.built_contexts = self.all_contexts.val();
        self.engine.limits.next.patience = self.patience.val();
        self.engine.deal.next = self.command_port.deal.val();
        self.engine.clears.next = self.command_port.clearing.val().clears;
        self.engine.arrival.next = self.command_port.arrival.val();
        self.engine.arrived.next = self.command_port.tally.val().arrived;
        self.engine.read.next.valid = self.responder.read.val();
        self.engine.read.next.id = self.responder.read_id.val();
        self.engine.now.next = self.counters.now.val();
        self.write.next = self.engine.write.val();

        // A clock counts as waiting only if the host is to blame: the command still awaits a point, and the insertion
        // engine has nothing to do.
        self.counters.clears.next = self.command_port.clearing.val().clears;
        self.counters.inserting.next = self.command_port.activity.val().inserting;
        self.counters.waiting.next = self.command_port.activity.val().inserting
            & self.command_port.activity.val().awaits_point
            & self.engine.state.val().is_quiet;
        self.counters.reading.next = self.command_port.activity.val().reading;
        self.counters.events.next = self.engine.events.val();
        self.counters.refused.next = self.command_port.tally.val().refused;
        self.counters.select.next = self.responder.index_ahead.val().get_bits::<5>(0);
        self.latencies.clears.next = self.command_port.clearing.val().clears;
        self.latencies.comes.next = self.counters.latency_comes.val();
        self.latencies.latency.next = self.counters.latency.val();
        self.latencies.select.next = self.responder.index.val();

        for i in 0..self.view.len() {
            self.answer_words.own_features[i].next = self.features[i].val();
            self.engine.question_runs[i].next = self.question_runs[i].val();
            self.engine.question_asks[i].next = self.question_asks[i].val();
            self.engine.question[i].next = self.question[i].val();
            self.engine.question_place[i].next = self.question_place[i].val();
            self.completed[i].next = self.engine.completed[i].val();
            self.sides[i].next = self.engine.sides[i].val();
            self.nearest[i].next = self.engine.nearest[i].val();
            self.view[i].awaits_command.next = self.command_port.awaits_command[i].val();
            self.view[i].clearing.next = self.command_port.clearing.val();
            self.view[i].deal.next = self.command_port.deal.val();
            self.view[i].state.next = self.engine.state.val();
            self.view[i].engine.next = self.engine_number.val();
            self.standing[i].next = self.view[i].standing.val();
            self.engine.launches[i].next = self.launches[i].val();
            self.engine.launch[i].next = self.launch[i].val();
            self.engine.launch_stores[i].next = self.launch_stores[i].val();
            self.engine.launch_arrival[i].next = self.launch_arrival[i].val();
            self.engine.launch_context[i].next = self.launch_context[i].val();
            self.engine.launch_vertex[i].next = self.launch_vertex[i].val();
            self.engine.has_changed[i].next = self.has_changed[i].val();
            self.engine.is_pending[i].next = self.is_pending[i].val();
            self.engine.change_runs[i].next = self.change_runs[i].val();
            self.changes[i].next = self.engine.changes[i].val();
            self.arrival[i].next = self.command_port.arrival.val();
            self.arrived[i].next = self.command_port.tally.val().arrived;
            self.most[i].next = self.capacity.val();
            self.command_port.point_waits[i].next = self.point_waits[i].val();
            self.command_port.raises[i].next = self.raises[i].val();
            self.command_port.raised[i].next = self.raised[i].val();
            self.engine.launch_owns[i].next = self.launch_owns[i].val();
            self.engine.deletes[i].next = self.deletes[i].val();
            self.engine.moving[i].next = self.moving[i].val();
            self.engine.wanted[i].next = self.wanted[i].val();
            self.fetches[i].next = self.engine.fetches[i].val();
            self.fetched[i].next = self.engine.fetched[i].val();

            // Free records and deleted vertices are left out of the counts.
            self.responder.infinite[i].next = self.infinite.val();
            self.tally[i].clock.next = self.clock.val();
            self.tally[i].reset.next = self.reset.val();
            self.tally[i].clears.next = self.command_port.clearing.val().clears;
            self.tally[i].deletes.next = self.engine.erases[i].val();
            self.tally[i].returns.next = self.engine.returns[i].val();
            self.tally[i].records.next = self.engine.state.val().records;
            self.tally[i].insertions.next = self.counters.insertions.val();
            self.tally[i].opcode.next = self.command_port.request.val().opcode;
            self.answer_head.records.next = self.tally[i].bound.val();
            self.answer_words.records.next = self.tally[i].living.val();
            self.answer_words.insertions.next = self.tally[i].vertices.val();
        }
    }
}
