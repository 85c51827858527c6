//! Two engines between one command stream and one answer stream.
//!
//! 1. The streams are those of a core. The commands from a `Clear` up to the next one go to one engine, and the answers
//!    of different engines come in any order, each of them whole.
//! 2. `is_busy` is high while a word of a command is held or an answer is owed, and depends on registers only.

use super::answer_collector::AnswerCollector;
use super::engine_slot::EngineSlot;
use super::job_router::JobRouter;
use crate::commands::{AnswerSource, CommandSink};
use crate::engine::Write;
use crate::prelude::*;
use incircle_protocol::{Config, ConfigError};

#[derive(LogicBlock, Default)]
pub struct Dual {
    /// One clock, and a synchronous reset, active high, as a core has them.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub command: CommandSink,
    pub response: AnswerSource,
    pub is_busy: Signal<Out, Bit>,
    /// The write port of the triangle memory of each engine, for simulation.
    pub write0: Signal<Out, Write>,
    pub write1: Signal<Out, Write>,
    router: JobRouter,
    collector: AnswerCollector,
    slot0: EngineSlot,
    slot1: EngineSlot,
    all_are_free: Signal<Local, Bit>,
}

impl Dual {
    /// The engines of a configuration, which must have 2 of them.
    ///
    /// # Errors
    /// If a parameter is out of range; the error says which one and what is possible.
    pub fn new(config: Config) -> Result<Self, ConfigError> {
        Ok(Self { slot0: EngineSlot::new(config, 0)?, slot1: EngineSlot::new(config, 1)?, ..Self::default() })
    }
}

impl Logic for Dual {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, router, collector, slot0, slot1);
        self.router.reset.next = self.reset.val();
        self.collector.reset.next = self.reset.val();
        CommandSink::link(&mut self.command, &mut self.router.command);
        AnswerSource::link(&mut self.response, &mut self.collector.response);

        self.slot0.reset.next = self.reset.val();
        self.slot0.push.next = self.router.push.val().engine0;
        self.slot0.routed.next = self.router.routed.val();
        self.router.free.next.engine0 = self.slot0.is_free.val();
        self.router.room.next.engine0 = self.slot0.has_room.val();
        self.router.stuck.next.engine0 = self.collector.stuck.val().engine0;
        self.collector.offers.next.engine0 = self.slot0.offers.val();
        self.collector.beat0.next = self.slot0.beat.val();
        self.slot0.takes.next = self.collector.takes.val().engine0;
        self.write0.next = self.slot0.write.val();

        self.slot1.reset.next = self.reset.val();
        self.slot1.push.next = self.router.push.val().engine1;
        self.slot1.routed.next = self.router.routed.val();
        self.router.free.next.engine1 = self.slot1.is_free.val();
        self.router.room.next.engine1 = self.slot1.has_room.val();
        self.router.stuck.next.engine1 = self.collector.stuck.val().engine1;
        self.collector.offers.next.engine1 = self.slot1.offers.val();
        self.collector.beat1.next = self.slot1.beat.val();
        self.slot1.takes.next = self.collector.takes.val().engine1;
        self.write1.next = self.slot1.write.val();

        // No job goes to an engine that is not there, because it is never free and counts as stuck.
        self.router.free.next.engine2 = false;
        self.router.room.next.engine2 = false;
        self.router.stuck.next.engine2 = true;
        self.collector.offers.next.engine2 = false;
        self.collector.beat2.next.data = 0.into();
        self.collector.beat2.next.both = false;
        self.collector.beat2.next.last = false;
        self.router.free.next.engine3 = false;
        self.router.room.next.engine3 = false;
        self.router.stuck.next.engine3 = true;
        self.collector.offers.next.engine3 = false;
        self.collector.beat3.next.data = 0.into();
        self.collector.beat3.next.both = false;
        self.collector.beat3.next.last = false;

        self.all_are_free.next = self.slot0.is_free.val() & self.slot1.is_free.val();
        self.is_busy.next = self.router.is_busy.val() | (!self.all_are_free.val());
    }
}
