//! Does the runs on a mesh that stands, in all contexts side by side: answers questions, and begins and ends the items
//! of changes, which the insertion engine carries out.
//!
//! ```text
//! words -> RunPort -> ItemQueues -> NextItem -> walks begin --+--> visits, to the pipeline
//!                         ^             ^                     |
//!                         |             +-- ReturnLine        |
//!                         +-- ends -- QuestionStep <----------+-- completed visits
//! answer <- PartQueue <---- parts ---------+
//!                 ^------- Changes <- LateEvents <- events of the insertion engine
//! ```
//! 1. A context works on one item at a time, and has one visit in flight, or up to three in the search of a `Nearest`.
//!    A visit that completes asks for the next one or two, or ends its item, or leaves both to another visit in flight.
//!    A walk begins in a clock in which no completed visit asks, so one bundle a clock enters the queue of the
//!    pipeline. The item waits for that clock in [`NextItem`].
//! 2. A walk begins where the last walk of its context has ended, or at record 0 if there was none since the last
//!    `clears`. No record goes away while the mesh stands.
//! 3. Questions take no lock and write no record. The user begins a run only while no insertion is at work, so the mesh
//!    does not change during a run of questions.
//! 4. An item of a change begins with a start of its context in the insertion engine, which makes its visits. Its walk
//!    begins at the last root of its context, or as rule 2 says. [`Changes`] has the rest.
//! 5. The vertex of a move that is out of the mesh goes back before other items begin ([`ReturnLine`]). Its context has
//!    its place in the answer already.
//! 6. A run ends when its answer has been taken. A run of changes also waits until all locks are released.
//!
//! Latency: none (combinational) from a completed visit to `push`.

use super::changes::Changes;
use super::item_queues::ItemQueues;
use super::late_events::LateEvents;
use super::next_item::NextItem;
use super::part_queue::PartQueue;
use super::question_step::QuestionStep;
use super::return_line::ReturnLine;
use super::run_port::RunPort;
use super::types::{ContextEnd, Item, ItemNumber, Launch, Part};
use crate::commands::{AnswerSource, CommandSink};
use crate::engine::types::{
    context_bits, Arrival, Bundle, ChangeEvents, Completion, ContextId, ContextSet, Moving, NearVerdict, Position,
    Push, Start, TriangleId, VertexId, Visit, CONTEXT_BITS, TRIANGLE_BITS,
};
use crate::leaf::LutMemory;
use crate::predicate::{Point, Sides};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct Questions {
    pub clock: Signal<In, Clock>,
    /// Reset drops the run. After `clears`, which comes only between runs, walks begin at record 0 again.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// A run begins: its opcode is taken at this edge.
    pub begins: Signal<In, Bit>,
    pub opcode: Signal<In, Bits<8>>,
    /// The low half of the header, which has engine and tag; the number of contexts that work; whether there is a mesh.
    pub signature: Signal<In, Bits<16>>,
    pub contexts: Signal<In, ContextId>,
    pub has_mesh: Signal<In, Bit>,
    pub command: CommandSink,
    pub response: AnswerSource,
    /// The visit that completes (`done` only if it is that of a question), with signs and values of its three orient2d,
    /// for the corners as stored, and with the search for the nearest vertex.
    pub completion: Signal<In, Completion>,
    pub sides: Signal<In, Sides>,
    pub nearest: Signal<In, NearVerdict>,
    pub push: Signal<Out, Push>,
    /// The place and context of the item that begins; of a question, already while it waits to begin.
    pub position: Signal<Out, Position>,
    /// A run is under way; it asks questions, so that all visits are theirs; or it changes the mesh.
    pub is_active: Signal<Out, Bit>,
    pub asks: Signal<Out, Bit>,
    pub changes_mesh: Signal<Out, Bit>,
    /// For changes, as the ports of [`Changes`] of these names.
    pub capacity: Signal<In, VertexId>,
    pub arrived: Signal<In, VertexId>,
    pub arrival: Signal<In, Arrival>,
    pub events: Signal<In, ChangeEvents>,
    pub has_changed: Signal<Out, Bit>,
    pub is_pending: Signal<Out, Bit>,
    pub point_waits: Signal<Out, Bit>,
    pub raises: Signal<Out, Bit>,
    pub raised: Signal<Out, VertexId>,
    /// The context of an item of a change starts to walk, to the place in `position`. In the clock
    /// after, its point has to be stored.
    pub start: Signal<Out, Start>,
    pub stored: Signal<Out, Arrival>,
    /// Ids are kept for the vertex of the item; a run of deletions is under way; or one of moves, with the item that
    /// begins; and the ports of [`Changes`] of these names.
    pub owns: Signal<Out, Bit>,
    pub deletes: Signal<Out, Bit>,
    pub moving: Signal<Out, Moving>,
    pub wanted: Signal<Out, VertexId>,
    pub fetches: Signal<In, Bit>,
    pub fetched: Signal<In, Point>,
    changes: Changes,
    late: LateEvents,
    upcoming: NextItem,
    is_question: Signal<Local, Bit>,
    walks: Signal<Local, Bit>,
    port: RunPort,
    queues: ItemQueues,
    line: ReturnLine,
    step: QuestionStep,
    parts: PartQueue,
    /// The record at which the last walk of each context has ended, or the root of its last change, and the number of
    /// its item.
    hints: LutMemory<CONTEXT_BITS, TRIANGLE_BITS>,
    numbers: LutMemory<CONTEXT_BITS, 24>,
    /// Bit `c`: context `c` has a hint.
    hinted: DFF<ContextSet>,
    /// The point of an item that has begun in the clock before; the context whose question has ended then. Both come
    /// late in their clocks, and lead to block RAMs.
    storing: DFF<Arrival>,
    ended: DFF<ContextEnd>,
    visit: Signal<Local, Visit>,
    launch: Signal<Local, Launch>,
    item: Signal<Local, Item>,
    launches: Signal<Local, Bit>,
    leaves_queues: Signal<Local, Bit>,
    late_events: Signal<Local, ChangeEvents>,
    next_launch: Signal<Local, Launch>,
    next_item: Signal<Local, Item>,
    bundle: Signal<Local, Bundle>,
    number: Signal<Local, ItemNumber>,
    part: Signal<Local, Part>,
    start_record: Signal<Local, TriangleId>,
    arrives: Signal<Local, Bit>,
    wide_visit: Signal<Local, ContextSet>,
    wide_launch: Signal<Local, ContextSet>,
    of_launch: Signal<Local, ContextSet>,
    new_hint: Signal<Local, ContextSet>,
    one_bit: Signal<Local, ContextSet>,
}

impl Questions {
    /// The questions of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        let bits = context_bits(config);
        Self {
            queues: ItemQueues::new(config),
            line: ReturnLine::new(config),
            changes: Changes::new(config),
            step: QuestionStep::new(config),
            hints: LutMemory::new(bits, TRIANGLE_BITS),
            numbers: LutMemory::new(bits, 24),
            ..Self::default()
        }
    }
}

impl Logic for Questions {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, hinted, storing, ended);
        clock!(self, clock, port, queues, line, step, parts, hints, numbers, changes, late, upcoming);
        self.one_bit.next = 1.into();
        self.port.reset.next = self.reset.val();
        self.port.begins.next = self.begins.val();
        self.port.opcode.next = self.opcode.val();
        self.port.signature.next = self.signature.val();
        self.port.contexts.next = self.contexts.val();
        self.port.has_mesh.next = self.has_mesh.val();
        CommandSink::link(&mut self.command, &mut self.port.command);
        self.is_question.next = self.port.is_question.val();
        self.port.taken.next = self.changes.taken.val();
        self.port.is_over.next = self.parts.is_over.val() & (self.is_question.val() | self.events.val().all_rest);
        self.is_active.next = self.port.is_active.val();
        self.asks.next = self.is_question.val();
        self.changes_mesh.next = self.changes.runs.val();

        self.step.completion.next = self.completion.val();
        self.step.sides.next = self.sides.val();
        self.step.nearest.next = self.nearest.val();
        self.step.is_nearest.next = self.port.is_nearest.val();
        self.visit.next = self.completion.val().visit;
        self.queues.reset.next = self.reset.val();
        self.queues.dealt.next = self.changes.queued.val();
        self.queues.ends.next = self.changes.ends.val();
        self.ended.d.next.valid = self.step.ends.val() & (!self.reset.val());
        self.ended.d.next.context = self.visit.val().context;
        if self.is_question.val() {
            self.queues.ends.next = self.ended.q.val();
        }

        self.late.reset.next = self.reset.val();
        self.late.events.next = self.events.val();
        self.late.context_id.next = self.visit.val().context;
        self.late.corner.next = self.step.corner.val();
        self.late_events.next = self.late.late.val();

        // The item that begins next.
        self.line.reset.next = self.reset.val();
        self.line.puts_out.next = self.late_events.val().puts_out;
        self.line.put_out_context.next = self.late_events.val().put_out_context;
        self.upcoming.reset.next = self.reset.val();
        self.upcoming.returns.next = self.line.waits.val();
        self.upcoming.returned.next = self.line.launch.val();
        self.upcoming.waits.next = self.queues.waits.val();
        self.upcoming.queued.next = self.queues.launch.val();
        self.upcoming.has_room.next = self.parts.has_room.val();
        self.leaves_queues.next = self.upcoming.pops.val();
        self.queues.launches.next = self.leaves_queues.val();
        self.line.begins.next = self.leaves_queues.val();
        self.line.begun.next = self.queues.launch.val();
        self.line.goes.next = self.upcoming.takes_returned.val();
        self.hints.read_address.next = self.upcoming.context_id.val();
        self.wide_launch.next = bit_cast::<24, 5>(self.upcoming.context_id.val());
        self.of_launch.next = self.hinted.q.val() >> self.wide_launch.val();
        self.start_record.next = 0.into();
        if self.of_launch.val().get_bit(0) {
            self.start_record.next = self.hints.read_data.val();
        }
        self.upcoming.start_record.next = self.start_record.val();

        // The queue of the pipeline takes one bundle a clock, so a walk begins only if no completed visit asks. No item
        // begins in a clock in which a vertex falls out of use, because `Changes` has one place for a vertex that waits
        // for its mark.
        self.launch.next = self.upcoming.launch.val();
        self.item.next = self.launch.val().item;
        self.launches.next = self.upcoming.is_ready.val()
            & self.events.val().may_launch
            & (!self.is_question.val())
            & (!self.changes.unmarks.val());
        self.walks.next = self.upcoming.is_ready.val() & self.is_question.val();
        self.upcoming.goes.next = self.launches.val() | (self.walks.val() & (!self.step.asks.val()));
        self.push.next.valid = self.walks.val() | (self.is_question.val() & self.step.asks.val());
        self.bundle.next = self.step.bundle.val();
        if !self.step.asks.val() {
            self.bundle.next.is_pair = false;
            self.bundle.next.context = self.launch.val().context;
            self.bundle.next.rotates = false;
            self.bundle.next.entry = 0.into();
            self.bundle.next.record = self.upcoming.record.val();
        }
        self.push.next.bundle = self.bundle.val();
        // The place of a question may be stored before its walk begins: its context has no visit in flight.
        self.position.next.valid = self.launches.val() | self.walks.val();
        self.position.next.context = self.launch.val().context;
        self.position.next.point = self.item.val().place;
        self.start.next.valid = self.launches.val();
        self.start.next.context = self.launch.val().context;
        self.start.next.record = self.upcoming.record.val();
        self.start.next.takes = true;
        self.start.next.id = self.item.val().vertex;
        self.deletes.next = self.port.is_delete.val();
        self.moving.next.runs = self.port.is_move.val();
        self.moving.next.returns = self.upcoming.is_return.val();
        self.moving.next.stays = self.item.val().place == self.item.val().target;
        self.moving.next.target = self.item.val().target;
        self.owns.next = self.item.val().owns;
        self.storing.d.next.came = self.launches.val()
            & (!self.reset.val())
            & self.port.is_change.val()
            & (!self.port.is_delete.val())
            & ((!self.port.is_move.val()) | self.upcoming.is_return.val());
        self.storing.d.next.id = self.item.val().vertex;
        self.storing.d.next.point = self.item.val().place;
        self.stored.next = self.storing.q.val();
        self.next_launch.next = self.queues.launch.val();
        self.next_item.next = self.next_launch.val().item;
        self.numbers.write_address.next = self.next_launch.val().context;
        self.numbers.write_data.next = self.next_item.val().number;
        self.numbers.write_enable.next = self.leaves_queues.val();

        // A walk can end before its item does, because outside the hull a search follows. The next walk of the context
        // begins where the walk has ended, and not where the search has.
        self.numbers.read_address.next = self.late.late_context.val();
        if self.late_events.val().fill_ends {
            self.numbers.read_address.next = self.late_events.val().fill_context;
        }
        if self.is_question.val() {
            self.numbers.read_address.next = self.visit.val().context;
        }
        self.number.next = self.numbers.read_data.val();
        self.part.next.number = self.number.val();
        self.part.next.finding = self.step.finding.val();
        self.parts.came.next = self.changes.came.val();
        if self.is_question.val() {
            self.parts.came.next.valid = self.step.ends.val();
            self.parts.came.next.part = self.part.val();
        }
        self.hints.write_address.next = self.visit.val().context;
        self.hints.write_data.next = self.visit.val().record;
        self.arrives.next = self.step.arrives.val() | (self.events.val().is_root & self.changes.has_changed.val());
        self.hints.write_enable.next = self.arrives.val();
        self.wide_visit.next = bit_cast::<24, 5>(self.visit.val().context);
        self.new_hint.next = 0.into();
        if self.arrives.val() {
            self.new_hint.next = self.one_bit.val() << self.wide_visit.val();
        }
        self.hinted.d.next = self.hinted.q.val() | self.new_hint.val();
        if self.reset.val() | self.clears.val() {
            self.hinted.d.next = 0.into();
        }

        self.parts.reset.next = self.reset.val();
        self.parts.head.next = self.port.head.val();
        self.parts.begins.next = (self.leaves_queues.val() & self.port.is_active.val()) | self.changes.is_noted.val();

        self.changes.reset.next = self.reset.val();
        self.changes.clears.next = self.clears.val();
        self.changes.capacity.next = self.capacity.val();
        self.changes.arrived.next = self.arrived.val();
        self.changes.contexts.next = self.contexts.val();
        self.changes.arrival.next = self.arrival.val();
        self.changes.is_active.next = self.port.is_active.val();
        self.changes.is_change.next = self.port.is_change.val();
        self.changes.is_delete.next = self.port.is_delete.val();
        self.changes.is_move.next = self.port.is_move.val();
        self.changes.fetches.next = self.fetches.val();
        self.changes.fetched.next = self.fetched.val();
        self.wanted.next = self.changes.wanted.val();
        self.changes.dealt.next = self.port.dealt.val();
        self.changes.vertex.next = self.port.vertex.val();
        self.changes.accepted.next = self.queues.taken.val();
        self.changes.queues_rest.next = self.queues.rests.val();
        self.changes.events.next = self.late_events.val();
        self.changes.context_id.next = self.late.late_context.val();
        self.changes.number.next = self.numbers.read_data.val();
        self.changes.corner.next = self.late.late_corner.val();
        self.changes.launches.next = self.launches.val();
        self.changes.launch.next = self.launch.val();
        self.changes.has_room.next = self.parts.has_two_places.val() & (!self.leaves_queues.val());
        self.has_changed.next = self.changes.has_changed.val();
        self.is_pending.next = self.changes.is_pending.val();
        self.point_waits.next = self.changes.point_waits.val();
        self.raises.next = self.changes.raises.val();
        self.raised.next = self.changes.raised.val();
        AnswerSource::link(&mut self.response, &mut self.parts.response);
    }
}
