//! Takes the words of a run: the number of its items, and the items, which it deals to the contexts in turn.
//!
//! 1. Item `i` belongs to context `i mod k`, where `k` is the number of contexts that work.
//! 2. A run without a mesh to ask, or with more items than the length of its answer can count, is refused: its words
//!    are taken, and then its answer is the status alone.
//! 3. The head of an answer goes out when the number of items is known, or when the words of a refused run are over.
//!    The run ends when its answer has been taken and, after changes, all locks are released.
//! 4. An item of an `InsertAs` or a `Move` has two words, its vertex and its point; all others have one.
//! 5. `command_ready` depends on registers only and does not wait for `command_valid`.
//!
//! Latency: 2 clocks from the number of items to `head`. An item is dealt in the clock after it was taken, so an item
//! can be taken every second clock. An `InsertAs` or a `Move` needs at least 7 clocks an item: for its two words, and
//! for the look at its vertex.
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

use super::item_dealer::ItemDealer;
use super::run_answer::RunAnswer;
use super::types::{DealtItem, RunHead};
use crate::commands::types::Word;
use crate::commands::CommandSink;
use crate::engine::types::ContextId;
use crate::prelude::*;
use incircle_protocol::{Opcode, Status};

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
    /// The low half of the header, which has engine and tag, and the number of contexts that work. Both stay in a run.
    pub signature: Signal<In, Bits<16>>,
    pub contexts: Signal<In, ContextId>,
    /// There is a mesh to ask.
    pub has_mesh: Signal<In, Bit>,
    pub command: CommandSink,
    /// The item on offer to the contexts, and whether it is taken at this edge.
    pub dealt: Signal<Out, DealtItem>,
    pub taken: Signal<In, Bit>,
    /// A run of questions is under way; a run of changes is; that run is a `Delete`, or a `Move`. The vertex of the
    /// item on offer.
    pub is_question: Signal<Out, Bit>,
    pub is_change: Signal<Out, Bit>,
    pub is_delete: Signal<Out, Bit>,
    pub is_move: Signal<Out, Bit>,
    pub vertex: Signal<Out, Word>,
    pub head: Signal<Out, RunHead>,
    /// The last word of the answer has been taken and, after changes, all locks are released; from the clock after
    /// `head`.
    pub is_over: Signal<In, Bit>,
    /// A run is under way; and the run under way, or the last one, is a `Nearest`.
    pub is_active: Signal<Out, Bit>,
    pub is_nearest: Signal<Out, Bit>,
    dealer: ItemDealer,
    answer: RunAnswer,
    state: DFF<RunState>,
    code: DFF<Bits<8>>,
    /// The run under way, and its kind: in registers beside `state` and `code`, because many long paths begin here.
    active: DFF<Bit>,
    asks: DFF<Bit>,
    changes: DFF<Bit>,
    deletes: DFF<Bit>,
    moves: DFF<Bit>,
    has_two_words: DFF<Bit>,
    count: DFF<Word>,
    left: DFF<Word>,
    some_are_left: DFF<Bit>,
    status: DFF<Bits<3>>,
    answers: DFF<Bit>,
    /// The first word of an item of two has come.
    vertex_came: DFF<Bit>,
    is_vertex: Signal<Local, Bit>,
    starts_insert: Signal<Local, Bit>,
    starts_delete: Signal<Local, Bit>,
    starts_move: Signal<Local, Bit>,
    starts_change: Signal<Local, Bit>,
    ends: Signal<Local, Bit>,
    insert_code: Signal<Local, Bits<8>>,
    delete_code: Signal<Local, Bits<8>>,
    move_code: Signal<Local, Bits<8>>,
    starts: Signal<Local, Bit>,
    awaits_item: Signal<Local, Bit>,
    passes_item: Signal<Local, Bit>,
    takes_word: Signal<Local, Bit>,
    one: Signal<Local, Word>,
}

// The kernel holds the numbers as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    Status::BadRange as u8 == 2
        && Status::NoMesh as u8 == 7
        && Opcode::InsertAs as u8 == 11
        && Opcode::Delete as u8 == 12
        && Opcode::Move as u8 == 13,
    "the numbers of this block follow the protocol"
);

impl Logic for RunPort {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, active, asks, changes, deletes, moves, has_two_words);
        dff_setup!(self, clock, state, code, count, left, some_are_left, status, answers, vertex_came);
        clock!(self, clock, dealer);
        self.one.next = 1.into();
        self.insert_code.next = 11.into();
        self.delete_code.next = 12.into();
        self.move_code.next = 13.into();
        self.is_delete.next = self.deletes.q.val();
        self.is_move.next = self.moves.q.val();
        self.is_question.next = self.asks.q.val();
        self.is_change.next = self.changes.q.val();
        self.is_vertex.next = self.has_two_words.q.val() & (!self.vertex_came.q.val());
        self.is_active.next = self.active.q.val();
        self.is_nearest.next = self.code.q.val().get_bit(1) & (!self.code.q.val().get_bit(0));
        self.starts.next = self.begins.val() & (self.state.q.val() == RunState::Idle);
        self.awaits_item.next =
            (self.state.q.val() == RunState::Items) & self.some_are_left.q.val() & (!self.dealer.holds.val());
        self.passes_item.next = (self.state.q.val() == RunState::Refused) & self.some_are_left.q.val();
        self.command.ready.next =
            (self.state.q.val() == RunState::Count) | self.awaits_item.val() | self.passes_item.val();
        self.takes_word.next = self.command.valid.val() & (self.awaits_item.val() | self.passes_item.val());
        if self.takes_word.val() {
            self.vertex_came.d.next = self.is_vertex.val();
        }
        if self.takes_word.val() & (!self.is_vertex.val()) {
            self.left.d.next = self.left.q.val() - self.one.val();
            self.some_are_left.d.next = self.left.q.val() != self.one.val();
        }
        self.dealer.reset.next = self.reset.val();
        self.dealer.starts.next = self.starts.val();
        self.dealer.contexts.next = self.contexts.val();
        self.dealer.takes.next = self.awaits_item.val() & self.command.valid.val() & (!self.is_vertex.val());
        // The item of a `Delete` is its vertex alone.
        self.dealer.takes_vertex.next = self.takes_word.val() & (self.is_vertex.val() | self.deletes.q.val());
        self.vertex.next = self.dealer.vertex.val();
        self.dealer.word.next = self.command.data.val();
        self.dealer.taken.next = self.taken.val();
        self.dealt.next = self.dealer.dealt.val();

        self.answer.code.next = self.code.q.val();
        self.answer.count.next = self.count.q.val();
        self.answer.status.next = self.status.q.val();
        self.answer.signature.next = self.signature.val();
        self.answer.gives.next = self.answers.q.val();
        self.head.next = self.answer.head.val();

        self.starts_insert.next = self.opcode.val() == self.insert_code.val();
        self.starts_delete.next = self.opcode.val() == self.delete_code.val();
        self.starts_move.next = self.opcode.val() == self.move_code.val();
        self.starts_change.next = self.starts_insert.val() | self.starts_delete.val() | self.starts_move.val();
        self.ends.next = false;
        self.answers.d.next = false;
        match self.state.q.val() {
            RunState::Idle => {
                self.vertex_came.d.next = false;
                if self.starts.val() {
                    self.code.d.next = self.opcode.val();
                    self.deletes.d.next = self.starts_delete.val();
                    self.moves.d.next = self.starts_move.val();
                    self.has_two_words.d.next = self.starts_insert.val() | self.starts_move.val();
                    self.changes.d.next = self.starts_change.val();
                    self.asks.d.next = !self.starts_change.val();
                    self.active.d.next = true;
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
                if self.answer.is_too_long.val() {
                    self.status.d.next = 2.into();
                }
                if !self.has_mesh.val() {
                    self.status.d.next = 7.into();
                }
                if self.answer.is_too_long.val() | (!self.has_mesh.val()) {
                    self.state.d.next = RunState::Refused;
                } else {
                    self.answers.d.next = true;
                    self.state.d.next = RunState::Items;
                }
            }
            RunState::Items => {
                if (!self.some_are_left.q.val()) & (!self.dealer.holds.val()) & (!self.answers.q.val()) {
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
                    self.ends.next = true;
                    self.state.d.next = RunState::Idle;
                }
            }
            _ => {
                self.ends.next = true;
                self.state.d.next = RunState::Idle;
            }
        }
        if self.ends.val() | self.reset.val() {
            self.active.d.next = false;
            self.asks.d.next = false;
            self.changes.d.next = false;
            self.deletes.d.next = false;
            self.moves.d.next = false;
            self.has_two_words.d.next = false;
        }
        if self.reset.val() {
            self.state.d.next = RunState::Idle;
            self.answers.d.next = false;
        }
    }
}
