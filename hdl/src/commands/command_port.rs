//! Takes the words of commands: opcodes, arguments, and points one at a time.
//!
//! 1. `command_ready` depends on registers only and does not wait for `command_valid`.
//! 2. A point is taken when the one before has been stored. The fourth point waits until the core knows whether the
//!    first three span a triangle; in a batch, the point behind the first three of each job waits.
//! 3. A `Clear` with the number 0 asks for all contexts. A `Clear` for more contexts than the core has, or for a number
//!    of jobs that does not divide them, changes nothing, and `clears` stays low.
//! 4. The answer to a `Clear` is due when its numbers are checked and `clears` has ended.
//! 5. A word of zeros in place of a command is taken and ignored.
//!
//! Latency: a point that is taken at an edge is stored at the next one, so a point can be taken every second clock. A
//! refused point is counted at the next edge.
//!
//! An `Insert` of three points into an empty core:
//! ```text
//! sweeps          /^^^^^\_________________________________________
//! command_valid   /^^^^^^^^^^^^^^^^^^^^^^^^^^\____________________
//! command_ready   ______/^^^^^^^^\__/^^\__/^^\____________________
//! came            _______________/^^\__/^^\__/^^\_________________
//! came_id           .  .  .  .  .  0  .  1  .  2  .  .  .  .  .  .
//! is_quiet        /^^^^^^^^^^^^^^\____________________/^^^^^^^^^^^
//! answers         _______________________________________/^^^^^^^^
//! ```

use super::channels::CommandSink;
use super::clear_command::ClearCommand;
use super::command_gate::CommandGate;
use super::point_slot::PointSlot;
use super::types::{Activity, AnswerProgress, Clearing, CommandState, Request, Tally, VertexCount, Word};
use crate::engine::{Arrival, Deal, EngineState, VertexId};
use crate::prelude::*;
use incircle_protocol::{Opcode, PADDING, TRIANGLES_SHORT, TRIANGLES_TWELVE};

#[derive(LogicBlock, Default)]
pub struct CommandPort {
    pub clock: Signal<In, Clock>,
    /// After a reset the port awaits a command, and all contexts work.
    pub reset: Signal<In, Bit>,
    /// Number of points that the core holds, and of contexts that it has; constants.
    pub capacity: Signal<In, VertexCount>,
    pub built: Signal<In, Bits<5>>,
    pub command: CommandSink,
    /// Memories are being cleared, so the core is not ready for commands.
    pub sweeps: Signal<In, Bit>,
    pub engine: Signal<In, EngineState>,
    pub arrival: Signal<Out, Arrival>,
    pub clearing: Signal<Out, Clearing>,
    /// Number of contexts that work, and which points belong to them.
    pub deal: Signal<Out, Deal>,
    /// An answer is due; held until `answer.ends`.
    pub answers: Signal<Out, Bit>,
    pub request: Signal<Out, Request>,
    pub tally: Signal<Out, Tally>,
    pub answer: Signal<In, AnswerProgress>,
    pub activity: Signal<Out, Activity>,
    /// The next word is a command: in a core that answers questions.
    pub awaits_command: Vec<Signal<Out, Bit>>,
    /// In a core with changes: the last point still waits for its context; and a run has put a vertex into the mesh.
    pub point_waits: Vec<Signal<In, Bit>>,
    pub raises: Vec<Signal<In, Bit>>,
    pub raised: Vec<Signal<In, VertexId>>,
    state: DFF<CommandState>,
    held: DFF<Request>,
    /// No point of the command is left; valid while points come.
    none_is_left: DFF<Bit>,
    is_inserting: DFF<Bit>,
    is_reading: DFF<Bit>,
    slot: PointSlot,
    gate: CommandGate,
    clear: ClearCommand,
    code: Signal<Local, Bits<8>>,
    read_code: Signal<Local, Bits<8>>,
    packed_code: Signal<Local, Bits<8>>,
    insert_code: Signal<Local, Bits<8>>,
    one: Signal<Local, Word>,
}

// The kernel holds the opcodes as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    Opcode::Insert as u8 == 3
        && Opcode::Read as u8 == 4
        && Opcode::Triangles as u8 == 7
        && PADDING == 0
        && TRIANGLES_SHORT == 1 << 3
        && TRIANGLES_TWELVE == 1 << 2,
    "the opcodes of this block follow the protocol"
);

impl CommandPort {
    /// The port of a core that answers questions.
    pub fn with_runs() -> Self {
        Self {
            awaits_command: vec![Signal::default()],
            point_waits: vec![Signal::default()],
            raises: vec![Signal::default()],
            raised: vec![Signal::default()],
            gate: CommandGate::with_changes(),
            slot: PointSlot::with_changes(),
            ..Self::default()
        }
    }
}

impl Logic for CommandPort {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, held, none_is_left, is_inserting, is_reading);
        clock!(self, clock, slot, clear);
        self.insert_code.next = 3.into();
        self.read_code.next = 4.into();
        self.packed_code.next = 7.into();
        self.one.next = 1.into();

        self.arrival.next = self.slot.arrival.val();
        self.clearing.next = self.clear.clearing.val();
        self.deal.next = self.clear.deal.val();
        self.answers.next = (self.state.q.val() == CommandState::Answer)
            & (!self.clear.clearing.val().clears)
            & (!self.clear.clearing.val().is_checking);
        self.request.next = self.held.q.val();
        self.tally.next = self.slot.tally.val();
        self.activity.next.inserting = self.is_inserting.q.val();
        self.activity.next.reading = self.is_reading.q.val();

        // The gate alone decides whether a word is taken, so that `command_ready` and the state below never disagree.
        CommandSink::link(&mut self.command, &mut self.gate.command);
        self.gate.state.next = self.state.q.val();
        self.gate.sweeps.next = self.sweeps.val();
        self.gate.none_is_left.next = self.none_is_left.q.val();
        self.gate.came.next = self.slot.arrival.val().came;
        self.gate.engine.next = self.engine.val();
        self.activity.next.awaits_point = self.gate.awaits_point.val();
        for i in 0..self.awaits_command.len() {
            self.awaits_command[i].next = (self.state.q.val() == CommandState::Command) & (!self.sweeps.val());
        }
        for i in 0..self.point_waits.len() {
            self.gate.point_waits[i].next = self.point_waits[i].val();
            self.slot.raises[i].next = self.raises[i].val();
            self.slot.raised[i].next = self.raised[i].val();
        }
        self.clear.reset.next = self.reset.val();
        self.clear.built.next = self.built.val();
        self.clear.taken.next = self.gate.taken.val();
        self.slot.reset.next = self.reset.val();
        self.slot.clears.next = self.clear.clearing.val().clears;
        self.slot.capacity.next = self.capacity.val();
        self.slot.engine.next = self.engine.val();
        self.slot.taken.next = self.gate.taken.val();
        self.code.next = self.command.data.val().get_bits::<8>(24);

        if (self.state.q.val() != CommandState::Answer) & self.answer.val().is_idle & self.answer.val().is_taken {
            self.is_reading.d.next = false;
        }
        match self.state.q.val() {
            CommandState::Command => {
                if self.gate.taken.val().is_command {
                    self.held.d.next.opcode = self.code.val();
                    self.held.d.next.has_short_ids = self.command.data.val().get_bit(3);
                    self.held.d.next.has_rests = self.command.data.val().get_bit(2);
                    self.state.d.next = CommandState::Answer;
                    if self.code.val() == self.insert_code.val() {
                        self.state.d.next = CommandState::Count;
                    }
                    if (self.code.val() == self.read_code.val()) | (self.code.val() == self.packed_code.val()) {
                        self.state.d.next = CommandState::First;
                    }
                }
            }
            CommandState::First => {
                if self.command.valid.val() {
                    self.held.d.next.first = self.command.data.val();
                    self.state.d.next = CommandState::Count;
                }
            }
            CommandState::Count => {
                if self.command.valid.val() {
                    self.held.d.next.count = self.command.data.val();
                    self.none_is_left.d.next = !self.command.data.val().any();
                    if self.held.q.val().opcode == self.insert_code.val() {
                        self.state.d.next = CommandState::Points;
                    } else {
                        self.is_reading.d.next = true;
                        self.state.d.next = CommandState::Answer;
                    }
                }
            }
            CommandState::Points => {
                if self.none_is_left.q.val() {
                    self.state.d.next = CommandState::Settle;
                }
                if self.gate.taken.val().is_point {
                    self.held.d.next.count = self.held.q.val().count - self.one.val();
                    self.none_is_left.d.next = self.held.q.val().count == self.one.val();
                    self.is_inserting.d.next = true;
                }
            }
            CommandState::Settle => {
                if self.engine.val().is_quiet | self.engine.val().stuck {
                    self.is_inserting.d.next = false;
                    self.state.d.next = CommandState::Answer;
                }
            }
            CommandState::Answer => {
                if self.answer.val().ends {
                    self.state.d.next = CommandState::Command;
                }
            }
            _ => {
                self.state.d.next = CommandState::Command;
            }
        }
        if self.reset.val() {
            self.state.d.next = CommandState::Command;
            self.is_inserting.d.next = false;
            self.is_reading.d.next = false;
        }
    }
}
