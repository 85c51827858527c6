//! An engine with the queue of its command words, and the number of answers that it owes.
//!
//! 1. `is_free` is low from the edge at which the first word of a command is pushed until the last word of its answer
//!    is taken. It depends on registers only.

use super::command_queue::CommandQueue;
use super::types::{OfferedBeat, RoutedWord};
use crate::commands::CommandSource;
use crate::engine::Write;
use crate::prelude::*;
use crate::top::Core;
use incircle_protocol::{Config, ConfigError, ENGINE_QUEUE_WORDS};

#[derive(LogicBlock, Default)]
pub struct EngineSlot {
    pub clock: Signal<In, Clock>,
    /// A reset of the engine, its queue and its debts.
    pub reset: Signal<In, Bit>,
    /// Take `routed` at this edge; allowed only while `has_room` is high.
    pub push: Signal<In, Bit>,
    pub routed: Signal<In, RoutedWord>,
    pub has_room: Signal<Out, Bit>,
    /// The engine owes no answer.
    pub is_free: Signal<Out, Bit>,
    /// The engine offers words of an answer; they are taken at an edge at which `takes` is high too.
    pub offers: Signal<Out, Bit>,
    pub beat: Signal<Out, OfferedBeat>,
    pub takes: Signal<In, Bit>,
    /// The write port of the triangle memory, for simulation.
    pub write: Signal<Out, Write>,
    core: Core,
    queue: CommandQueue,
    owed: DFF<Bits<9>>,
    begins: Signal<Local, Bit>,
    ends: Signal<Local, Bit>,
    one: Signal<Local, Bits<9>>,
}

// Beside the commands in the queue, one may be at work and one be answered.
const _: () = assert!(ENGINE_QUEUE_WORDS + 2 < 1 << 9, "9 bits hold the number of answers that an engine may owe");

impl EngineSlot {
    /// The slot of the engine of this number on a chip of a configuration.
    ///
    /// # Errors
    /// If a parameter is out of range; the error says which one and what is possible.
    pub fn new(config: Config, engine: u8) -> Result<Self, ConfigError> {
        Ok(Self { core: Core::numbered(config, engine)?, ..Self::default() })
    }
}

impl Logic for EngineSlot {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, owed);
        clock!(self, clock, core, queue);
        self.one.next = 1.into();
        self.core.reset.next = self.reset.val();
        self.queue.reset.next = self.reset.val();
        self.queue.push.next = self.push.val();
        self.queue.word.next = self.routed.val().word;
        self.has_room.next = self.queue.has_room.val();
        CommandSource::join(&mut self.queue.command, &mut self.core.command);
        self.offers.next = self.core.response.valid.val();
        self.beat.next.data = self.core.response.data.val();
        self.beat.next.both = self.core.response.both.val();
        self.beat.next.last = self.core.response.last.val();
        self.core.response.ready.next = self.takes.val();
        self.write.next = self.core.write.val();

        self.is_free.next = !self.owed.q.val().any();
        self.begins.next = self.push.val() & self.routed.val().begins;
        self.ends.next = self.core.response.valid.val() & self.core.response.last.val() & self.takes.val();
        if self.begins.val() & (!self.ends.val()) {
            self.owed.d.next = self.owed.q.val() + self.one.val();
        }
        if self.ends.val() & (!self.begins.val()) {
            self.owed.d.next = self.owed.q.val() - self.one.val();
        }
        if self.reset.val() {
            self.owed.d.next = 0.into();
        }
    }
}
