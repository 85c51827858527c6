//! The core of a mesh that stands: as [`Core`], and it also does runs of `Locate`, `Interpolate`, `Nearest`,
//! `InsertAs`, `Delete` and `Move`.
//!
//! ```text
//! commands -> RunGate --> Core ------- completed visits --+
//! answers  <-    |  ^       ^                             |
//!                |  |       +--------- visits --------+   |
//!                |  +------- answers ------------ Questions
//!                +---------- runs ------------------->
//! ```

use super::core::Core;
use crate::commands::{AnswerSink, AnswerSource, CommandSink, CommandSource};
use crate::engine::{Completion, Write};
use crate::living::types::Standing;
use crate::living::{Questions, RunGate};
use crate::prelude::*;
use incircle_protocol::{Config, ConfigError, CORE_RUNS, FEATURES_SHIFT, FEATURE_SHORT_IDS, MAX_DELETE_RING, MIN_RING};

#[derive(LogicBlock, Default)]
pub struct LivingCore {
    /// Clock and reset as those of [`Core`].
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub command: CommandSink,
    pub response: AnswerSource,
    /// The write port of the triangle memory, for simulation.
    pub write: Signal<Out, Write>,
    gate: RunGate,
    core: Core,
    questions: Questions,
    standing: Signal<Local, Standing>,
    completion: Signal<Local, Completion>,
    wide_engine: Signal<Local, Bits<16>>,
    shifted_engine: Signal<Local, Bits<16>>,
    wide_tag: Signal<Local, Bits<16>>,
    engine_shift: Signal<Local, Bits<16>>,
}

// The kernel holds the features as a literal, because rust-hdl allows no constants there. A changed protocol fails
// here.
const _: () = assert!(
    (FEATURE_SHORT_IDS | CORE_RUNS) << FEATURES_SHIFT == 0x00fe_0000,
    "the identity of this core follows the protocol"
);

impl LivingCore {
    /// The core of a configuration of one engine.
    ///
    /// # Errors
    /// If a parameter is out of range, there are several engines, or the boundary list is too long for deletions; the
    /// error says what is possible.
    pub fn new(config: Config) -> Result<Self, ConfigError> {
        if !(MIN_RING..=MAX_DELETE_RING).contains(&config.ring) {
            return Err(ConfigError::RingForDeletions(config.ring));
        }
        let config = config.check()?;
        if config.engines != 1 {
            return Err(ConfigError::EnginesForQuestions(config.engines));
        }
        Ok(Self { core: Core::with_runs(config)?, questions: Questions::new(config), ..Self::default() })
    }
}

impl Logic for LivingCore {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, core, questions);
        self.engine_shift.next = 8.into();
        self.core.features[0].next = 0x00fe_0000.into();
        self.core.reset.next = self.reset.val();
        self.questions.reset.next = self.reset.val();
        CommandSink::link(&mut self.command, &mut self.gate.command);
        AnswerSource::link(&mut self.response, &mut self.gate.response);
        CommandSource::join(&mut self.gate.core_command, &mut self.core.command);
        AnswerSink::join(&mut self.gate.core_response, &mut self.core.response);
        CommandSource::join(&mut self.gate.run_command, &mut self.questions.command);
        AnswerSink::join(&mut self.gate.run_response, &mut self.questions.response);
        self.write.next = self.core.write.val();

        self.standing.next = self.core.standing[0].val();
        self.gate.standing.next = self.standing.val();
        self.gate.is_active.next = self.questions.is_active.val();
        self.questions.begins.next = self.gate.begins.val();
        self.questions.opcode.next = self.gate.opcode.val();
        self.questions.clears.next = self.standing.val().clears;
        self.questions.contexts.next = self.standing.val().contexts;
        self.questions.has_mesh.next = self.standing.val().has_mesh;
        self.wide_engine.next = bit_cast::<16, 8>(self.standing.val().engine);
        self.shifted_engine.next = self.wide_engine.val() << self.engine_shift.val();
        self.wide_tag.next = bit_cast::<16, 8>(self.standing.val().tag);
        self.questions.signature.next = self.shifted_engine.val() | self.wide_tag.val();

        self.completion.next = self.core.completed[0].val();
        self.questions.completion.next = self.completion.val();
        self.questions.completion.next.done = self.completion.val().done & self.questions.asks.val();
        self.questions.sides.next = self.core.sides[0].val();
        self.questions.nearest.next = self.core.nearest[0].val();
        self.core.question_runs[0].next = self.questions.asks.val();
        self.questions.capacity.next = self.core.most[0].val();
        self.questions.arrived.next = self.core.arrived[0].val();
        self.questions.arrival.next = self.core.arrival[0].val();
        self.questions.events.next = self.core.changes[0].val();
        self.core.change_runs[0].next = self.questions.changes_mesh.val();
        self.core.has_changed[0].next = self.questions.has_changed.val();
        self.core.is_pending[0].next = self.questions.is_pending.val();
        self.core.point_waits[0].next = self.questions.point_waits.val();
        self.core.raises[0].next = self.questions.raises.val();
        self.core.raised[0].next = self.questions.raised.val();
        self.core.launches[0].next = self.questions.start.val().valid;
        self.core.launch[0].next = self.questions.start.val();
        self.core.launch_context[0].next = self.questions.start.val().context;
        self.core.launch_vertex[0].next = self.questions.start.val().id;
        self.core.launch_stores[0].next = self.questions.stored.val().came;
        self.core.launch_arrival[0].next = self.questions.stored.val();
        self.core.question_asks[0].next = self.questions.push.val().valid;
        self.core.question[0].next = self.questions.push.val().bundle;
        self.core.question_place[0].next = self.questions.position.val();
        self.core.launch_owns[0].next = self.questions.owns.val();
        self.core.deletes[0].next = self.questions.deletes.val();
        self.core.moving[0].next = self.questions.moving.val();
        self.core.wanted[0].next = self.questions.wanted.val();
        self.questions.fetches.next = self.core.fetches[0].val();
        self.questions.fetched.next = self.core.fetched[0].val();
    }
}
