//! Gives each job to an engine. A job is the words from a `Clear` up to the next one, also those of a batch.
//!
//! 1. A `Clear` goes to the next engine in turn that owes no answer and has not said `Stuck`; if all engines have said
//!    so, to one that owes no answer. It waits while there is none. All other words follow the `Clear` before them;
//!    words before the first `Clear` go to engine 0.
//! 2. A word of zeros in place of a command is dropped.
//! 3. `command_ready` depends on registers only and does not wait for `command_valid`.
//! 4. The engine for the next `Clear` is chosen a clock ahead. In that clock no word goes, so no engine gets a command
//!    between the choice and the `Clear`.
//!
//! Latency: 1 clock from a word taken to its push. A word can be taken in every second clock, as fast as an engine
//! takes points.

use super::engine_choice::EngineChoice;
use super::types::{EngineFlags, RoutedWord};
use super::word_place::WordPlace;
use crate::commands::types::Word;
use crate::commands::CommandSink;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct JobRouter {
    pub clock: Signal<In, Clock>,
    /// After a reset the router holds no word, and the next one is a command for engine 0.
    pub reset: Signal<In, Bit>,
    pub command: CommandSink,
    /// The engine owes no answer; the engine has said `Stuck`, or is not there; its queue has room for a word.
    pub free: Signal<In, EngineFlags>,
    pub stuck: Signal<In, EngineFlags>,
    pub room: Signal<In, EngineFlags>,
    /// The engine that takes `routed` at this edge, if there is one.
    pub push: Signal<Out, EngineFlags>,
    pub routed: Signal<Out, RoutedWord>,
    /// The router holds a word, or awaits one of a command that has begun.
    pub is_busy: Signal<Out, Bit>,
    word: DFF<Word>,
    is_held: DFF<Bit>,
    /// The engine of the present job.
    current: DFF<Bits<2>>,
    choice: EngineChoice,
    place: WordPlace,
    drops: Signal<Local, Bit>,
    has_room: Signal<Local, Bit>,
    can_go: Signal<Local, Bit>,
    goes: Signal<Local, Bit>,
    engine: Signal<Local, Bits<2>>,
    number0: Signal<Local, Bits<2>>,
    number1: Signal<Local, Bits<2>>,
    number2: Signal<Local, Bits<2>>,
    number3: Signal<Local, Bits<2>>,
}

impl Logic for JobRouter {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, word, is_held, current);
        clock!(self, clock, choice, place);
        self.number0.next = 0.into();
        self.number1.next = 1.into();
        self.number2.next = 2.into();
        self.number3.next = 3.into();
        self.command.ready.next = !self.is_held.q.val();
        if self.command.valid.val() & (!self.is_held.q.val()) {
            self.is_held.d.next = true;
            self.word.d.next = self.command.data.val();
        }
        self.choice.reset.next = self.reset.val();
        self.choice.current.next = self.current.q.val();
        self.choice.free.next = self.free.val();
        self.choice.stuck.next = self.stuck.val();
        self.place.reset.next = self.reset.val();
        self.place.word.next = self.word.q.val();
        self.is_busy.next = self.is_held.q.val() | (!self.place.begins.val());

        match self.current.q.val().index() {
            0 => {
                self.has_room.next = self.room.val().engine0;
            }
            1 => {
                self.has_room.next = self.room.val().engine1;
            }
            2 => {
                self.has_room.next = self.room.val().engine2;
            }
            _ => {
                self.has_room.next = self.room.val().engine3;
            }
        }
        // The queue of an engine that owes no answer is empty, so a `Clear` needs no look at it.
        self.engine.next = self.current.q.val();
        self.can_go.next = self.has_room.val();
        if self.place.is_clear.val() {
            self.engine.next = self.choice.target.val();
            self.can_go.next = self.choice.has_target.val();
        }
        self.drops.next = self.is_held.q.val() & self.place.is_padding.val();
        self.goes.next = self.is_held.q.val() & self.can_go.val() & (!self.place.is_padding.val());
        self.place.passes.next = self.goes.val();
        self.routed.next.word = self.word.q.val();
        self.routed.next.begins = self.place.begins.val();
        self.push.next.engine0 = self.goes.val() & (self.engine.val() == self.number0.val());
        self.push.next.engine1 = self.goes.val() & (self.engine.val() == self.number1.val());
        self.push.next.engine2 = self.goes.val() & (self.engine.val() == self.number2.val());
        self.push.next.engine3 = self.goes.val() & (self.engine.val() == self.number3.val());
        if self.goes.val() | self.drops.val() {
            self.is_held.d.next = false;
        }
        if self.goes.val() {
            self.current.d.next = self.engine.val();
        }
        if self.reset.val() {
            self.is_held.d.next = false;
            self.current.d.next = self.number0.val();
        }
    }
}
