//! Directs the words of runs to the questions and all other words to the rest of the core, and merges the answers.
//!
//! 1. A run begins with an opcode word of `Locate` (8), `Interpolate` (9), `Nearest` (10) or `InsertAs` (11). The core
//!    does not see that word, nor any other word up to the end of the run.
//! 2. If both sides have a beat on offer, that of the core goes first. It is the last beat of an answer, because a run
//!    begins only when the core awaits its next command.
//!
//! Latency: none, the block is combinational.

use super::types::Standing;
use crate::commands::{AnswerSink, AnswerSource, CommandSink, CommandSource};
use crate::prelude::*;
use incircle_protocol::Opcode;

#[derive(LogicBlock, Default)]
pub struct RunGate {
    /// The streams of the core.
    pub command: CommandSink,
    pub response: AnswerSource,
    /// The state of the rest of the core, and whether a run is under way.
    pub standing: Signal<In, Standing>,
    pub is_active: Signal<In, Bit>,
    /// A run begins with the word on offer, and the opcode of that word.
    pub begins: Signal<Out, Bit>,
    pub opcode: Signal<Out, Bits<8>>,
    /// The streams of the rest of the core, and those of a run.
    pub core_command: CommandSource,
    pub core_response: AnswerSink,
    pub run_command: CommandSource,
    pub run_response: AnswerSink,
    gives_run: Signal<Local, Bit>,
    code: Signal<Local, Bits<8>>,
    locate_code: Signal<Local, Bits<8>>,
    interpolate_code: Signal<Local, Bits<8>>,
    nearest_code: Signal<Local, Bits<8>>,
    insert_code: Signal<Local, Bits<8>>,
    delete_code: Signal<Local, Bits<8>>,
    move_code: Signal<Local, Bits<8>>,
}

// The kernel holds the opcodes as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    Opcode::Locate as u8 == 8
        && Opcode::Interpolate as u8 == 9
        && Opcode::Nearest as u8 == 10
        && Opcode::InsertAs as u8 == 11
        && Opcode::Delete as u8 == 12
        && Opcode::Move as u8 == 13,
    "the opcodes of this block follow the protocol"
);

impl Logic for RunGate {
    #[hdl_gen]
    fn update(&mut self) {
        self.locate_code.next = 8.into();
        self.interpolate_code.next = 9.into();
        self.nearest_code.next = 10.into();
        self.insert_code.next = 11.into();
        self.delete_code.next = 12.into();
        self.move_code.next = 13.into();
        self.code.next = self.command.data.val().get_bits::<8>(24);
        self.opcode.next = self.code.val();
        self.begins.next = self.command.valid.val()
            & self.standing.val().awaits_command
            & (!self.is_active.val())
            & ((self.code.val() == self.locate_code.val())
                | (self.code.val() == self.interpolate_code.val())
                | (self.code.val() == self.nearest_code.val())
                | (self.code.val() == self.insert_code.val())
                | (self.code.val() == self.delete_code.val())
                | (self.code.val() == self.move_code.val()));
        self.core_command.data.next = self.command.data.val();
        self.core_command.valid.next = self.command.valid.val() & (!self.is_active.val()) & (!self.begins.val());
        self.run_command.data.next = self.command.data.val();
        self.run_command.valid.next = self.command.valid.val() & self.is_active.val();
        self.command.ready.next = self.core_command.ready.val();
        if self.is_active.val() {
            self.command.ready.next = self.run_command.ready.val();
        }

        self.response.valid.next = self.core_response.valid.val() | self.run_response.valid.val();
        self.response.data.next = self.core_response.data.val();
        self.response.both.next = self.core_response.both.val();
        self.response.last.next = self.core_response.last.val();
        self.gives_run.next = self.run_response.valid.val() & (!self.core_response.valid.val());
        if self.gives_run.val() {
            self.response.data.next = self.run_response.data.val();
            self.response.both.next = self.run_response.both.val();
            self.response.last.next = self.run_response.last.val();
        }
        self.core_response.ready.next = self.response.ready.val();
        self.run_response.ready.next = self.response.ready.val() & (!self.core_response.valid.val());
    }
}
