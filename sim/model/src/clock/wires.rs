//! The values that parts show each other within a clock: their registers as of the edge, and the wires, which are
//! functions of registers and inputs.
//!
//! This module alone may stand in a circle of imports: every part reads the registers and wires and defines
//! some of them, with types of its own, as the blocks of the core do.
//! `testbench/tests/it/project/import_circles` allows no other.

use super::command_port::{CommandPort, State as CommandState};
use super::commit::Commit;
use super::commit_job::CommitJob;
use super::contexts::Contexts;
use super::counters::Counters;
use super::holes::{FillEnd, Holes};
use super::late_point::LatePoint;
use super::memory::Write;
use super::outcome::{Around, Outcome};
use super::ports::Inputs;
use super::questions::{Launch, Questions};
use super::responder::Responder;
use super::ring::Head;
use super::seeder::Seeder;
use super::solo::Solo;
use super::starter::{Start, Starter};
use super::visit::{Bundle, Completion};
use super::watchdog::{FinishedPoints, Watchdog};
use super::ClockModel;
use crate::predicate::Point;
use incircle_protocol::{Config, FEATURE_SHORT_IDS};

/// The registers of the core, except those of the visit pipeline, the ring reader and the release.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Registers {
    pub command: CommandPort,
    pub responder: Responder,
    pub contexts: Contexts,
    /// The contexts as of one clock ago: a part of the meaning of a visit is decided ahead of its completion.
    pub noted: Contexts,
    pub starter: Starter,
    pub seeder: Seeder,
    pub commit: Commit,
    pub solo: Solo,
    pub finished_points: FinishedPoints,
    pub watchdog: Watchdog,
    pub counters: Counters,
    /// The counters as of one clock ago: the hardware counts an event one clock after it.
    pub counted: Counters,
    /// The consequences of the visit that completed in the clock before. The contexts take note of them in this clock.
    pub outcome: Option<Outcome>,
    /// The bundle that enters the queue in this clock.
    pub push: Option<Bundle>,
    pub write: Write,
    /// The write that the filling of a hole requests.
    pub filled: Write,
    /// The point of the move in place that has ended in the clock before, or the word of a vertex that is out of the
    /// mesh; and the one that waits to be written.
    pub coming_point: Option<LatePoint>,
    pub late_point: Option<LatePoint>,
    /// The vertex of an item that has begun in the clock before, whose point is stored in this one.
    pub storing: Option<(u32, Point)>,
    /// Number of vertices that have been deleted since the last clear, and of those whose ids are kept.
    pub deleted: u32,
    pub kept: u32,
    /// Whether read-outs of triangles leave out free records; a constant.
    pub skips_free: bool,
    /// The features of the identity; a constant.
    pub features: u32,
}

impl Registers {
    pub(super) fn after_reset(config: Config, engine: u8) -> Self {
        let mut registers = Self { features: FEATURE_SHORT_IDS, ..Self::default() };
        registers.responder.engine = engine;
        registers.command.contexts = config.contexts;
        registers.command.jobs = 1;
        registers.contexts.reset(config.contexts);
        registers
    }

    /// Whether the point of a move in place, or the word of a vertex that is out of the mesh, is not written yet.
    pub(super) fn has_late_point(&self) -> bool {
        self.coming_point.is_some() || self.late_point.is_some()
    }
}

/// The wires of one clock.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wires {
    /// The command word that is taken at this edge.
    pub word: Option<u32>,
    pub response_ready: bool,
    /// The infinite vertex of this configuration.
    pub infinite: u32,
    /// The visit that completes.
    pub done: Option<Completion>,
    /// The consequences of that visit, unless it belongs to a solo insertion.
    pub outcome: Option<Outcome>,
    /// The record that a read-out asked for three clocks ago, as answer words.
    pub record_read: Option<[u32; 3]>,
    /// Whether that record is free.
    pub read_is_free: bool,
    /// The record that a read-out asks for.
    pub read: Option<u32>,
    /// Whether the responder loads its last word.
    pub answer_ends: bool,
    /// Whether every point that has come is in the mesh, and no lock is held.
    pub is_quiet: bool,
    /// The point that is accepted at this edge.
    pub new_vertex: Option<(u32, Point)>,
    /// The point of a move in place that ends, or the word of a vertex that is out of the mesh, which is to be written.
    pub coming_point: Option<LatePoint>,
    /// The vertex whose point is stored in the next clock, because its item begins. The vertex whose point is stored in
    /// this one, for that reason or as one that has waited.
    pub stored: Option<(u32, Point)>,
    pub new_point: Option<(u32, Point)>,
    /// The walk that a context starts.
    pub start: Option<Start>,
    /// The item of a change that begins, whose context starts to walk.
    pub launch: Option<Launch>,
    /// Whether contexts take points as items alone; whether a run of changes is under way; whether some point of an
    /// `Insert` that came after a change is not finished.
    pub has_changed: bool,
    pub changes_mesh: bool,
    pub is_pending: bool,
    /// Whether a context would start, but a visit completes or the vertex memory takes a point, so that the pointer
    /// waits.
    pub start_is_held: bool,
    /// Whether the last record of the first triangle is written.
    pub seeds: bool,
    /// The entry at the head of the ring reader, and whether the commit takes it.
    pub head: Option<Head>,
    pub head_is_taken: bool,
    /// The ring whose last record is written.
    pub committed: Option<CommitJob>,
    /// The lock that is cleared, and the context whose last lock that is.
    pub clear: Option<u32>,
    pub released: Option<usize>,
    /// The bundle that a solo insertion asks for.
    pub solo_push: Option<Bundle>,
    /// The context whose solo insertion begins now.
    pub solo_starts: Option<usize>,
    /// Whether the solo insertion ends, and whether it ends with its point in the mesh and not as a duplicate.
    pub solo_ends: bool,
    pub solo_inserts: bool,
    /// Whether the visit that completes is one of a deletion, or of a move whose vertex is in the mesh; whether a
    /// run of deletions or of moves is under way; the test that the filling of a hole asks for; the item that ends with
    /// a hole that is full or flat; and the deletion whose last record is written.
    pub finds: bool,
    pub deletes: bool,
    pub moves: bool,
    pub fill_push: Option<Bundle>,
    pub fill_end: Option<FillEnd>,
    pub erased: Option<CommitJob>,
    /// Whether a commit waits, because the filling of a hole requests a write.
    pub holds: bool,
}

impl ClockModel {
    pub(super) fn wires(&self, inputs: Inputs) -> Wires {
        let was = &self.registers;
        let config = self.config;
        let questions = self.questions.as_ref();
        let point_waits = questions.is_some_and(Questions::point_waits);
        let ready = was.command.is_ready(was, self.sweeps(), point_waits);
        let word = (inputs.command_valid && ready).then_some(inputs.command_data);
        let done = self.pipeline.completion();
        let outcome = done.filter(|_| !was.solo.is_at_work()).map(|done| self.outcome(&done));
        let finds = done.is_some_and(|done| self.finds(done.visit.context));
        let solo_push = was.solo.push_request(was);
        let wanted = was.starter.wants(was);
        // The queue takes one bundle in each clock, and the vertex memory has one port for points that arrive
        // and points that are taken. Whether a completing visit asks for more visits is known too late, so
        // every visit but a test that finds its edge final counts as asking. The pointer knows even less, and
        // waits at every completion.
        let lacks_port = wanted.is_some_and(|start| start.id.is_some() && was.command.came);
        let lacks_queue =
            outcome.is_some() && done.is_some_and(|done| done.may_ask(finds, self.is_last_of_star(&done)));
        let takes_point = was.command.state == CommandState::Points && was.command.stores_points(was, config);
        let head = self.ring.head;
        let rests = was.contexts.rest;
        let record_read = self.pipeline.record_read().map(|id| self.memory.record_words(id));
        let solo_inserts = was.solo.inserts();
        let start = wanted.filter(|_| !lacks_port && !lacks_queue);
        let holes = self.holes.as_ref();
        let test = holes.and_then(Holes::push_request);
        let is_free = !lacks_queue && wanted.is_none();
        let launch = self.launch(!is_free || test.is_some());
        let ends = |outcome: Outcome| outcome.release.is_some() || outcome.commit.is_some() || outcome.duplicate;
        // Whether a visit of a star is the last one of its attempt is known too late, so each that may be counts.
        let may_settle = |done: &Completion| self.may_settle(done);
        let ends_attempt =
            outcome.is_some_and(ends) || outcome.is_some() && finds && done.as_ref().is_some_and(may_settle);
        let holds = holes.is_some_and(Holes::writes_next);
        let moved = outcome.filter(|outcome| outcome.moves_in_place).map(|outcome| outcome.context);
        let moved = moved.map(|context| (self.memory.point_id[context], self.memory.target[context]));
        let late = was.late_point.filter(|late| late.is_due(self.pipeline.fetches(), was.coming_point.is_some()));
        let stored = launch.filter(|launch| launch.stores).map(|launch| (launch.item.vertex, launch.item.place));
        Wires {
            word,
            response_ready: inputs.response_ready,
            infinite: self.memory.infinite,
            done,
            outcome,
            record_read,
            read_is_free: record_read.is_some_and(|words| self.memory.is_free(words)),
            read: was.responder.read_request(),
            answer_ends: was.responder.ends(inputs.response_ready),
            is_quiet: was.finished_points.is_done(was) && rests,
            coming_point: moved.or(self.restored(outcome.as_ref(), finds)).map(LatePoint::new),
            stored,
            new_point: was.storing.or(late.map(|late| late.arrival())),
            new_vertex: word.filter(|_| takes_point).map(|word| (was.command.arrived, point(word))),
            start,
            launch,
            has_changed: questions.is_some_and(Questions::has_changed),
            changes_mesh: questions.is_some_and(Questions::changes_mesh),
            is_pending: questions.is_some_and(|questions| questions.is_pending(was.command.came)),
            start_is_held: wanted.is_some() && (lacks_port || outcome.is_some()),
            seeds: was.seeder.seeds(),
            head,
            head_is_taken: was.commit.takes(head, &self.memory) && !holds,
            committed: was.commit.ends().filter(|_| !holds),
            clear: self.release.clear(),
            released: self.release.released(),
            solo_push,
            solo_starts: was.starter.solo().filter(|_| rests && !was.solo.is_at_work()),
            solo_ends: solo_inserts || was.solo.finds_duplicate(),
            solo_inserts,
            finds,
            deletes: self.deletes(),
            moves: self.moves(),
            fill_push: test.filter(|_| is_free),
            fill_end: holes.and_then(Holes::end_request).filter(|_| !ends_attempt),
            erased: holes.and_then(Holes::erased),
            holds,
        }
    }

    /// Whether the visits of a context look for the vertex of its item, go round its star and fill its hole: in a
    /// deletion, and in a move until its vertex is out of the mesh.
    pub(super) fn finds(&self, context: usize) -> bool {
        let is_out = self.memory.inserts[context] || self.registers.solo.is_at_work();
        self.deletes() || self.moves() && !is_out
    }

    /// Whether a run of deletions is under way.
    fn deletes(&self) -> bool {
        self.questions.as_ref().is_some_and(Questions::deletes)
    }

    /// Whether a run of moves is under way.
    fn moves(&self) -> bool {
        self.questions.as_ref().is_some_and(Questions::moves)
    }

    /// A vertex that is out of the mesh, whose kept ids take the place of its point: a run of deletions deletes it, or
    /// its point turns out to be that of another vertex.
    fn restored(&self, outcome: Option<&Outcome>, finds: bool) -> Option<(u32, Point)> {
        let solo = &self.registers.solo;
        let deleted = self.holes.as_ref().filter(|_| self.deletes()).and_then(|holes| holes.kept(&self.memory));
        let duplicate = outcome.filter(|outcome| outcome.duplicate && !finds);
        let duplicate = duplicate.map(|outcome| self.memory.point_id[outcome.context]);
        let vertex = duplicate.or(Some(solo.vertex()).filter(|_| solo.finds_duplicate()));
        let restored = vertex.and_then(|vertex| Some((vertex, self.memory.kept(vertex)?)));
        deleted.or(restored).map(|(vertex, [first, second])| (vertex, point(first | second << 15)))
    }

    /// Whether a visit of a deletion or of a move is the last one in flight of its star, or the test of its last edge.
    fn may_settle(&self, done: &Completion) -> bool {
        let is_of_star = done.visit.rotates && done.visit.locks;
        is_of_star && self.tables.attempts[done.visit.context].outstanding == 1 || done.visit.is_last_edge()
    }

    /// Whether the visit is the last one in flight of a star that moves.
    fn is_last_of_star(&self, done: &Completion) -> bool {
        self.moves() && self.tables.attempts[done.visit.context].outstanding == 1
    }

    /// The consequences of a completing visit for its context.
    fn outcome(&self, done: &Completion) -> Outcome {
        let context = done.visit.context;
        let around = Around {
            was: &self.registers,
            attempt: self.tables.attempts[context],
            vertex: self.memory.point_id[context],
            since: self.memory.since[context],
            config: self.config,
            infinite: self.memory.infinite,
            defect: self.defect,
            moves: self.moves(),
            stays: self.memory.target[context] == self.memory.position[context],
        };
        match self.holes.as_ref().filter(|_| self.finds(context)) {
            Some(holes) => Outcome::of_deletion(done, &around, &holes.stars[context], &holes.holes[context]),
            None => Outcome::of(done, &around),
        }
    }
}

/// The point in a command word.
fn point(word: u32) -> Point {
    Point { x: word & 0xffff, y: word >> 16 }
}
