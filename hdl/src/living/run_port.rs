//! Takes the words of a run: the number of its items, and the items, which it deals to the contexts in turn.
//!
//! 1. Item `i` belongs to context `i mod k`, where `k` is the number of contexts that work.
//! 2. A run without a mesh to ask, or with more items than the length of its answer can count, is refused: its words are
//!    taken, and then its answer is the status alone.
//! 3. The head of an answer goes out when the number of items is known, or when the words of a refused run are over. The
//!    run ends when its answer has been taken.
//! 4. `command_ready` depends on registers only and does not wait for `command_valid`.
//!
//! Latency: 2 clocks from the number of items to `head`. An item is dealt in the clock after it was taken, so an item
//! can be taken every second clock.
//!
//! A run of two items, of which the first has to wait a clock:
//! ```text
//! begins          /^^\_____________________________
//! command_valid   ___/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
//! command_ready   ___/^^\__/^^\_____/^^\___________
//! head            _________/^^\____________________
//! dealt           ____________/^^^^^\__/^^\________
//! dealt.context     .  .  .  .  0  0  .  1  .  .  .
//! taken           _______________/^^\__/^^\________
//! is_over         /^^^^^^^^\_________________/^^^^^
//! is_active       ___/^^^^^^^^^^^^^^^^^^^^^^^^^^\__
//! ```

use super::types::{DealtItem, Item, ItemNumber, Launch, RunHead};
use crate::commands::types::Word;
use crate::commands::CommandSink;
use crate::engine::types::ContextId;
use crate::prelude::*;
use incircle_protocol::{RunKind, Status};

/// The meaning of the next word, or the event that the port awaits.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum RunState {
    /// No run is under way.
    Idle,
    /// The next word is the number of items.
    Count,
    /// The number of items is looked at.
    Judge,
    /// The next word is an item.
    Items,
    /// The next word is an item of a run that is refused.
    Refused,
    /// The answer has to be given and taken.
    Settle,
}

#[derive(LogicBlock, Default)]
pub struct RunPort {
    pub clock: Signal<In, Clock>,
    /// A reset ends the run.
    pub reset: Signal<In, Bit>,
    /// A run begins: its opcode is taken at this edge. Only while no run is under way.
    pub begins: Signal<In, Bit>,
    pub opcode: Signal<In, Bits<8>>,
    /// The low half of the header: engine and tag. And the number of contexts that work. Neither changes in a run.
    pub signature: Signal<In, Bits<16>>,
    pub contexts: Signal<In, ContextId>,
    /// There is a mesh to ask.
    pub has_mesh: Signal<In, Bit>,
    pub command: CommandSink,
    /// The item on offer to the contexts, and whether it is taken at this edge.
    pub dealt: Signal<Out, DealtItem>,
    pub taken: Signal<In, Bit>,
    pub head: Signal<Out, RunHead>,
    /// The last word of the answer has been taken; from the clock after `head`.
    pub is_over: Signal<In, Bit>,
    /// A run is under way.
    pub is_active: Signal<Out, Bit>,
    state: DFF<RunState>,
    code: DFF<Bits<8>>,
    count: DFF<Word>,
    left: DFF<Word>,
    some_are_left: DFF<Bit>,
    status: DFF<Bits<3>>,
    answers: DFF<Bit>,
    holds: DFF<Bit>,
    held: DFF<Launch>,
    turn: DFF<ContextId>,
    number: DFF<ItemNumber>,
    item: Signal<Local, Item>,
    takes_item: Signal<Local, Bit>,
    passes_item: Signal<Local, Bit>,
    is_last: Signal<Local, Bit>,
    is_refused: Signal<Local, Bit>,
    is_too_long: Signal<Local, Bit>,
    top: Signal<Local, Word>,
    after_turn: Signal<Local, ContextId>,
    wide_status: Signal<Local, Word>,
    shifted_status: Signal<Local, Word>,
    wide_code: Signal<Local, Word>,
    shifted_code: Signal<Local, Word>,
    one: Signal<Local, Word>,
    one_turn: Signal<Local, ContextId>,
    one_number: Signal<Local, ItemNumber>,
    two: Signal<Local, Word>,
    top_shift: Signal<Local, Word>,
    status_shift: Signal<Local, Word>,
    code_shift: Signal<Local, Word>,
}

// The kernel holds the numbers as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    RunKind::Locate.part_words() == 4 && Status::BadRange as u8 == 2 && Status::NoMesh as u8 == 7,
    "the numbers of this block follow the protocol"
);

impl Logic for RunPort {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, code, count, left, some_are_left, status, answers);
        dff_setup!(self, clock, holds, held, turn, number);
        self.one.next = 1.into();
        self.one_turn.next = 1.into();
        self.one_number.next = 1.into();
        self.two.next = 2.into();
        self.top_shift.next = 30.into();
        self.status_shift.next = 16.into();
        self.code_shift.next = 24.into();

        self.takes_item.next = (self.state.q.val() == RunState::Items)
            & self.some_are_left.q.val()
            & (!self.holds.q.val())
            & self.command.valid.val();
        self.passes_item.next =
            (self.state.q.val() == RunState::Refused) & self.some_are_left.q.val() & self.command.valid.val();
        self.command.ready.next = (self.state.q.val() == RunState::Count)
            | ((self.state.q.val() == RunState::Items) & self.some_are_left.q.val() & (!self.holds.q.val()))
            | ((self.state.q.val() == RunState::Refused) & self.some_are_left.q.val());
        self.is_active.next = self.state.q.val() != RunState::Idle;

        // An item on its way to its context.
        self.item.next.number = self.number.q.val();
        self.item.next.place = self.command.data.val();
        self.dealt.next.valid = self.holds.q.val();
        self.dealt.next.context = self.held.q.val().context;
        self.dealt.next.item = self.held.q.val().item;
        self.after_turn.next = self.turn.q.val() + self.one_turn.val();
        if self.taken.val() {
            self.holds.d.next = false;
        }
        if self.takes_item.val() {
            self.holds.d.next = true;
            self.held.d.next.context = self.turn.q.val();
            self.held.d.next.item = self.item.val();
            self.number.d.next = self.number.q.val() + self.one_number.val();
            self.turn.d.next = self.after_turn.val();
            if self.after_turn.val() == self.contexts.val() {
                self.turn.d.next = 0.into();
            }
        }
        self.is_last.next = self.left.q.val() == self.one.val();
        if self.takes_item.val() | self.passes_item.val() {
            self.left.d.next = self.left.q.val() - self.one.val();
            self.some_are_left.d.next = !self.is_last.val();
        }

        // The head: of a run that is refused, the status alone.
        self.wide_code.next = bit_cast::<32, 8>(self.code.q.val());
        self.shifted_code.next = self.wide_code.val() << self.code_shift.val();
        self.wide_status.next = bit_cast::<32, 3>(self.status.q.val());
        self.shifted_status.next = self.wide_status.val() << self.status_shift.val();
        self.is_refused.next = self.status.q.val().any();
        self.head.next.valid = self.answers.q.val();
        self.head.next.header =
            self.shifted_code.val() | self.shifted_status.val() | bit_cast::<32, 16>(self.signature.val());
        self.head.next.length = self.count.q.val() << self.two.val();
        self.head.next.parts = self.count.q.val();
        if self.is_refused.val() {
            self.head.next.length = 0.into();
            self.head.next.parts = 0.into();
        }
        self.top.next = self.count.q.val() >> self.top_shift.val();
        self.is_too_long.next = self.top.val().any();

        self.answers.d.next = false;
        match self.state.q.val() {
            RunState::Idle => {
                if self.begins.val() {
                    self.code.d.next = self.opcode.val();
                    self.turn.d.next = 0.into();
                    self.number.d.next = 0.into();
                    self.state.d.next = RunState::Count;
                }
            }
            RunState::Count => {
                if self.command.valid.val() {
                    self.count.d.next = self.command.data.val();
                    self.left.d.next = self.command.data.val();
                    self.some_are_left.d.next = self.command.data.val().any();
                    self.state.d.next = RunState::Judge;
                }
            }
            RunState::Judge => {
                self.status.d.next = 0.into();
                if self.is_too_long.val() {
                    self.status.d.next = 2.into();
                }
                if !self.has_mesh.val() {
                    self.status.d.next = 7.into();
                }
                if self.is_too_long.val() | (!self.has_mesh.val()) {
                    self.state.d.next = RunState::Refused;
                } else {
                    self.answers.d.next = true;
                    self.state.d.next = RunState::Items;
                }
            }
            RunState::Items => {
                if (!self.some_are_left.q.val()) & (!self.holds.q.val()) & (!self.answers.q.val()) {
                    self.state.d.next = RunState::Settle;
                }
            }
            RunState::Refused => {
                if !self.some_are_left.q.val() {
                    self.answers.d.next = true;
                    self.state.d.next = RunState::Settle;
                }
            }
            RunState::Settle => {
                if self.is_over.val() & (!self.answers.q.val()) {
                    self.state.d.next = RunState::Idle;
                }
            }
            _ => {
                self.state.d.next = RunState::Idle;
            }
        }
        if self.reset.val() {
            self.state.d.next = RunState::Idle;
            self.answers.d.next = false;
            self.holds.d.next = false;
        }
    }
}
