//! Runs whole visits: queue, memories, locks, reader, predicates and verdict together must agree in Rust, in Verilog
//! and in plain arithmetic, and must answer after the promised number of clocks.
//!
//! The records are not those of a mesh but random ones, with three links that differ and any corners, so that every
//! turn, tie and ghost triangle comes up. The pipeline does not know the difference. Visits of all contexts come at
//! every clock and meet at few records, while records are written, points change and locks are cleared.

use std::cell::RefCell;
use std::collections::VecDeque;

use crate::rig::drawing::{draw, When};
use crate::rig::stepper::bundles::{pack, random_fields, ring_bundle, unpack, BUNDLE, VISIT, WRITE};
use crate::rig::stepper::{named_ports, Delay, Expected, Stepper};
use crate::rig::visit_model::{point, verdict_parts, word, Locks, Point, Record, VERDICT_PARTS};
use incircle_hdl::engine::VisitPipeline;
use incircle_protocol::{infinite_vertex, Config, SMALL, TINY};
use incircle_testkit::SplitMix64;

named_ports!(
    [] VisitPipeline,
    [reset, infinite, records, push, position, read, write, enables, arrival, fetch_id, clear],
    [is_issuing, completion, early, read_out, fetched],
    clock
);

const INPUTS: [&str; 18] = [
    "reset",
    "infinite",
    "records",
    "push_valid",
    "push_bundle",
    "position_context",
    "position_point",
    "position_valid",
    "read_valid",
    "read_id",
    "write",
    "arrival_id",
    "arrival_point",
    "arrival_came",
    "fetch_id",
    "clear_id",
    "clear_valid",
    "enables",
];

/// Outputs that are compared. `turned` comes in parts: first the bits that are arbitrary in a torn record, then took,
/// foreign and again, then which vertex is infinite. `verdict` comes in the parts of `VERDICT_PARTS`.
const OUTPUTS: [&str; 18] = [
    "is_issuing",
    "completion_done",
    "completion_visit",
    "completion_turned[0+:92]",
    "completion_turned[92+:3]",
    "completion_turned[95+:3]",
    "read_out_valid",
    "read_out_record_v0",
    "read_out_record_v1",
    "read_out_record_v2",
    "read_out_record_n0",
    "read_out_record_n1",
    "read_out_record_n2",
    "read_out_record_was_set",
    "fetched",
    VERDICT_PARTS[0],
    VERDICT_PARTS[1],
    VERDICT_PARTS[2],
];

/// Clocks from the issue register to `done`.
const STAGES: usize = 16;

/// Clocks from the issue register to the read of the vertices and of the point.
const VERTEX_CLOCK: usize = 2;

const POINT_CLOCK: usize = 4;

/// Number of records and of vertices that a test uses.
const POOL: u64 = 16;

/// Clocks of a round, which writes, visits, rests and reads out.
const ROUND: usize = 104;

const ROUNDS: usize = 45;

/// A visit under way, with everything that is known of it so far; `None` where a value is arbitrary.
#[derive(Clone, Copy)]
struct Flight {
    visit: u128,
    context: usize,
    /// Bits found at the lock: took, foreign, again.
    lock: [bool; 3],
    slot: usize,
    /// The record as stored; its corners are in the same order.
    record: Option<Record>,
    corners: Option<[Point; 3]>,
    verdict: Expected,
    parts: [Expected; 3],
}

/// Counts of events, so that a test can check that each of them happened.
#[derive(Debug, Default)]
struct Seen {
    visits: usize,
    conflicts: usize,
    located: usize,
    took: usize,
    foreign: usize,
    own: usize,
    met_clear: usize,
    unwritten: usize,
    torn: usize,
    read_outs: usize,
    triples: usize,
}

impl Seen {
    fn counts(&self) -> [usize; 11] {
        let Self { visits, conflicts, located, took, foreign, own, met_clear, unwritten, torn, read_outs, triples } =
            *self;
        [visits, conflicts, located, took, foreign, own, met_clear, unwritten, torn, read_outs, triples]
    }
}

/// The memories as arrays, the visits that wait, and the visits under way.
struct Visits {
    vertices: u64,
    contexts: u64,
    infinite: u64,
    numbers: SplitMix64,
    records: Vec<Record>,
    locks: Locks,
    positions: Vec<u64>,
    points: Vec<u64>,
    waiting: VecDeque<u128>,
    issued: Option<u128>,
    reads: Option<u64>,
    /// Visits under way; the one at place 0 comes out in this clock.
    flights: VecDeque<Option<Flight>>,
    read_outs: VecDeque<Option<(Record, bool)>>,
    fetched: Delay<Expected>,
    seen: Seen,
}

/// Inputs of a clock that change.
#[derive(Default)]
struct Writes {
    write: u128,
    vertex: (u64, u64, bool),
    position: (u64, u64, bool),
    clear: (u64, bool),
}

impl Visits {
    fn new(config: Config) -> Self {
        Self {
            vertices: config.points.into(),
            contexts: config.contexts.into(),
            infinite: infinite_vertex(config.points).into(),
            numbers: SplitMix64::new(51),
            records: vec![Record::default(); 2 * config.points as usize],
            locks: Locks::new(2 * config.points as usize),
            positions: vec![0; config.points as usize],
            points: vec![0; config.contexts as usize],
            waiting: VecDeque::new(),
            issued: None,
            reads: None,
            flights: vec![None; STAGES + 1].into(),
            read_outs: vec![None; 3].into(),
            fetched: Delay::new(2),
            seen: Seen::default(),
        }
    }

    /// Returns the id of a record of the pool, spread over the memory.
    fn record_id(&mut self) -> u64 {
        self.numbers.below(POOL) * (self.records.len() as u64 / POOL)
    }

    /// Returns the id of a record of the pool; every second time that of the record that a visit reads in this clock.
    fn visited_id(&mut self) -> u64 {
        let any = self.record_id();
        self.issued.filter(|_| self.numbers.bits(1) == 1).map_or(any, |visit| unpack(VISIT, visit)[7])
    }

    /// Returns a vertex of the pool; the last one stands where the infinite vertex reads.
    fn vertex_id(&mut self, place: u64) -> u64 {
        let pool = POOL.min(self.vertices);
        (place % pool + 1) * (self.vertices / pool) - 1
    }

    fn position(&mut self) -> u64 {
        let bits = [2, 2, 3, 16][self.numbers.bits(2) as usize];
        let mut coordinate = || self.numbers.bits(bits) as i64;
        word((coordinate(), coordinate()))
    }

    fn write(&mut self, id: u64, whole: bool) -> u128 {
        let mut corners = [(); 3].map(|()| self.numbers.next_u64());
        for corner in &mut corners {
            *corner = self.vertex_id(*corner);
        }
        let place = self.numbers.bits(3) as usize;
        if place < 3 {
            corners[place] = self.infinite;
        }
        let last = self.records.len() as u64 - 1;
        // Links of different columns differ, even if they are written one by one.
        let n = [0, 1, 2].map(|column| self.numbers.next_u64() & last & !3 | column);
        let columns = if whole { 0b1111 } else { self.numbers.bits(4) };
        let [vertices, link0, link1, link2] = [0, 1, 2, 3].map(|bit| columns >> bit & 1);
        let [v0, v1, v2] = corners;
        let fields = [1, id, vertices, link0, link1, link2, v0, v1, v2, n[0], n[1], n[2]];
        pack(WRITE, fields)
    }

    fn bundle(&mut self) -> u128 {
        let mut bundle = random_fields(BUNDLE, &mut self.numbers);
        bundle[1] &= bundle[0];
        // Every other time context 0, so that a context often meets its own locks.
        let among = if self.numbers.once_in(2) { 1 } else { self.contexts };
        bundle[2] = self.numbers.below(among);
        for place in [9, 11, 12] {
            bundle[place] = self.record_id();
        }
        let link = self.numbers.below(3) as usize;
        bundle[8] = self.records[bundle[9] as usize].n[link];
        pack(BUNDLE, bundle)
    }

    /// Writes everything at first. After that, each round writes at every second clock before its visits
    /// and at every sixth during them.
    fn writes(&mut self, round: usize, clock: usize) -> Writes {
        let mut writes = Writes::default();
        let place = self.numbers.next_u64();
        let context = self.numbers.below(self.contexts);
        if round == 0 && clock < POOL as usize {
            let id = clock as u64 * (self.records.len() as u64 / POOL);
            writes.write = self.write(id, true);
            writes.vertex = (self.vertex_id(clock as u64), self.position(), true);
            writes.position = (clock as u64 % self.contexts, self.position(), true);
        } else if clock < 90 {
            let pace = if clock < 20 { 2 } else { 6 };
            if self.numbers.once_in(pace) {
                let id = self.visited_id();
                writes.write = self.write(id, false);
            }
            writes.vertex = (self.vertex_id(place), self.position(), self.numbers.once_in(pace));
            writes.position = (context, self.position(), self.numbers.once_in(3 * pace));
            writes.clear = (self.visited_id(), self.numbers.once_in(3));
        }
        writes
    }

    /// Inputs of a clock: each round writes, visits, rests and reads.
    fn stimulus(&mut self, cycle: usize) -> Vec<u128> {
        let (round, clock) = (cycle / ROUND, cycle % ROUND);
        let Writes { write, vertex, position, clear } = self.writes(round, clock);
        let id = write >> 1 & 0x7fff;
        let rate = [1, 2, 8][round % 3];
        let visits = (20..60).contains(&clock);
        let push = visits && self.waiting.len() < 7 && self.numbers.once_in(rate);
        let read = (94..102).contains(&clock) && self.numbers.bits(1) == 1;
        let reset = cycle == 0 || (round % 4 == 1 && (20..102).contains(&clock) && self.numbers.once_in(25));
        let all = self.records.len() as u64;
        let records = if self.numbers.once_in(4) { self.record_id() } else { all };
        let fetch = self.numbers.next_u64();
        vec![
            reset.into(),
            self.infinite.into(),
            records.into(),
            push.into(),
            self.bundle(),
            position.0.into(),
            position.1.into(),
            position.2.into(),
            read.into(),
            self.record_id().into(),
            write,
            vertex.0.into(),
            vertex.1.into(),
            vertex.2.into(),
            self.vertex_id(fetch).into(),
            clear.0.into(),
            clear.1.into(),
            if write & 1 == 1 { write >> 16 & 0b1111 } else { 0 } | id << 4 | id << 19,
        ]
    }

    /// Returns the outputs of a clock, then passes its edge.
    fn cycle(&mut self, values: &[u128]) -> Vec<Expected> {
        let mut shown = self.outputs();
        let fetched = (values[13] == 0).then(|| self.positions[values[14] as usize].into());
        shown[14] = self.fetched.pass(fetched).flatten();
        self.read_vertices(values);
        self.judge();
        self.flights.pop_front();
        self.flights.push_back(None);
        self.read_outs.pop_front();
        self.read_outs.push_back(None);
        if let Some(visit) = self.issued {
            self.visit(visit, values);
        }
        self.edge(values);
        shown
    }

    fn outputs(&mut self) -> Vec<Expected> {
        let mut shown = vec![None; OUTPUTS.len()];
        shown[0] = Some(self.issued.is_some().into());
        shown[1] = Some(self.flights[0].is_some().into());
        shown[6] = Some(self.read_outs[0].is_some().into());
        if let Some(flight) = self.flights[0] {
            let turned =
                |record: Record| record.turned(flight.slot).pack_turned(flight.slot, flight.lock, self.infinite);
            let lock = Record::default().pack_turned(0, flight.lock, self.infinite) >> 92 & 7;
            shown[2] = Some(flight.visit);
            shown[3] = flight.record.map(|record| turned(record) & ((1 << 92) - 1));
            shown[4] = Some(lock);
            shown[5] = flight.record.map(|record| turned(record) >> 95);
            shown[15..].copy_from_slice(&flight.parts);
            let verdict = flight.verdict.unwrap_or(0);
            self.seen.visits += 1;
            self.seen.conflicts += usize::from(verdict & 1 == 1);
            self.seen.located += usize::from(verdict >> 1 & 1 == 1);
        }
        if let Some((record, was_set)) = self.read_outs[0] {
            let values = [record.v, record.n].concat();
            for (place, value) in shown[7..].iter_mut().zip(values) {
                *place = Some(value.into());
            }
            shown[13] = Some(was_set.into());
            self.seen.read_outs += 1;
        }
        shown
    }

    /// The visit in the issue register reads its record at this edge, and comes out `STAGES` clocks later.
    fn visit(&mut self, visit: u128, values: &[u128]) {
        let [context, rotates, locks, .., cavity_record, record] = unpack(VISIT, visit);
        let write = unpack(WRITE, values[10]);
        let is_torn = write[0] == 1 && write[1] == record;
        let is_written = u128::from(record) < values[2];
        let is_cleared = values[16] == 1 && values[15] == record.into();
        let (took, foreign) =
            if locks == 1 { self.locks.take(record as usize, context, is_cleared) } else { (false, false) };
        let stored = self.records[record as usize];
        let slot = stored.slot(rotates == 1, cavity_record);
        self.seen.took += usize::from(took);
        self.seen.foreign += usize::from(foreign && !is_cleared);
        self.seen.own += usize::from(locks == 1 && !took && !foreign);
        self.seen.met_clear += usize::from(locks == 1 && is_cleared);
        self.seen.unwritten += usize::from(!is_written);
        self.seen.torn += usize::from(is_torn);
        self.flights[STAGES - 1] = Some(Flight {
            visit,
            context: context as usize,
            lock: [took, foreign, is_torn || !is_written],
            slot,
            record: (!is_torn).then_some(stored),
            corners: None,
            verdict: None,
            parts: [None; 3],
        });
    }

    /// The visit that has its record reads the corners; a corner that is written at this edge is arbitrary.
    fn read_vertices(&mut self, values: &[u128]) {
        // The memory has no word for the infinite vertex, so its id wraps.
        let place = |vertex: u64| (vertex % self.vertices) as usize;
        let written = (values[13] == 1).then_some(values[11] as usize);
        if let Some(flight) = &mut self.flights[STAGES - VERTEX_CLOCK] {
            let corners = flight.record.map(|record| record.v.map(place));
            let corners = corners.filter(|corners| corners.iter().all(|corner| Some(*corner) != written));
            flight.corners = corners.map(|corners| corners.map(|corner| point(self.positions[corner])));
        }
    }

    /// The visit that has its corners gets the point of its context.
    fn judge(&mut self) {
        if let Some(flight) = &mut self.flights[STAGES - POINT_CLOCK] {
            let p = point(self.points[flight.context]);
            if let (Some(record), Some(corners)) = (flight.record, flight.corners) {
                let verdict = record.verdict(flight.slot, corners, p, self.infinite);
                flight.verdict = Some(verdict);
                flight.parts = verdict_parts(verdict, flight.slot, corners, p);
            }
        }
    }

    fn push(&mut self, bundle: u128) {
        let [is_pair, is_triple, context, rotates, locks, entry, after, ..] = unpack(BUNDLE, bundle);
        let [.., cavity_entry, cavity_record, record, after2, record2, record3] = unpack(BUNDLE, bundle);
        let visits = [(entry, after, record), (after, after2, record2), (after2, 0, record3)];
        for (entry, after, record) in visits.into_iter().take(1 + (is_pair + is_triple) as usize) {
            self.waiting
                .push_back(pack(VISIT, [context, rotates, locks, entry, after, cavity_entry, cavity_record, record]));
        }
        self.seen.triples += is_triple as usize;
    }

    fn edge(&mut self, values: &[u128]) {
        if let Some(id) = self.reads.take() {
            let (record, holder) = (self.records[id as usize], self.locks.holder(id as usize));
            self.read_outs[1] = Some((record, holder.is_some()));
        }
        if values[3] == 1 {
            self.push(values[4]);
        }
        self.issued = self.waiting.pop_front();
        self.reads = (values[8] == 1).then_some(values[9] as u64);
        let write = unpack(WRITE, values[10]);
        if write[0] == 1 {
            let record = &mut self.records[write[1] as usize];
            if write[2] == 1 {
                record.v.copy_from_slice(&write[6..9]);
            }
            for k in 0..3 {
                if write[3 + k] == 1 {
                    record.n[k] = write[9 + k];
                }
            }
        }
        if values[7] == 1 {
            self.points[values[5] as usize] = values[6] as u64;
        }
        if values[13] == 1 {
            self.positions[values[11] as usize] = values[12] as u64;
        }
        if values[16] == 1 {
            self.locks.clear(values[15] as usize);
        }
        if values[0] == 1 {
            self.waiting.clear();
            self.issued = None;
            self.reads = None;
            self.flights.iter_mut().for_each(|flight| *flight = None);
            self.read_outs.iter_mut().for_each(|read| *read = None);
        }
    }
}

fn visits(name: &str, config: Config) {
    assert_eq!(VisitPipeline::STAGES, STAGES);
    let visits = RefCell::new(Visits::new(config));
    // Before its reset the block starts with random values and may have taken a lock. So all locks are cleared first,
    // and nothing is compared until then, nor in the two clocks in which a vertex comes that nobody wrote.
    let clears = 2 * config.points as usize;
    let clearing = (0..=clears + STAGES).map(|clock| {
        let mut inputs = vec![0; INPUTS.len()];
        let is_lock = (1..=clears).contains(&clock);
        (inputs[0], inputs[15], inputs[16]) = (u128::from(clock == 0), clock.saturating_sub(1) as u128, is_lock.into());
        inputs
    });
    let stimuli = clearing.chain((0..ROUND * ROUNDS).map(|cycle| visits.borrow_mut().stimulus(cycle)));
    let mut clocks = 0;
    Stepper::new(name, VisitPipeline::new(config), 1).run(&INPUTS, &OUTPUTS, stimuli, |values| {
        let shown = visits.borrow_mut().cycle(values);
        clocks += 1;
        if clocks > clears + STAGES + 3 {
            shown
        } else {
            vec![None; OUTPUTS.len()]
        }
    });
    let seen = visits.into_inner().seen;
    assert!(seen.counts().iter().all(|count| *count > ROUNDS), "{seen:?}");
}

#[test]
fn visit_pipeline_of_a_tiny_core() {
    visits("visit_pipeline_tiny", TINY);
}

#[test]
fn visit_pipeline_of_a_small_core() {
    visits("visit_pipeline_small", SMALL);
}

#[test]
fn visit_pipeline_shows_the_wave_of_its_header() {
    let stimuli = [(0, "push_valid", 1), (0, "push_bundle", ring_bundle(&[1, 2])), (19, "read_valid", 1)];
    let lanes = [
        ("push", "push_valid", 0, 1, When::Always),
        ("bundle.context", "push_bundle", 2, 5, When::If("push_valid")),
        ("bundle.entry", "push_bundle", 9, 6, When::If("push_valid")),
        ("is_issuing", "is_issuing", 0, 1, When::Always),
        ("done", "completion_done", 0, 1, When::Always),
        ("visit.context", "completion_visit", 0, 5, When::If("completion_done")),
        ("visit.entry", "completion_visit", 7, 6, When::If("completion_done")),
        ("read", "read_valid", 0, 1, When::Always),
        ("read_done", "read_out_valid", 0, 1, When::Always),
    ];
    let pipeline = VisitPipeline::new(TINY);
    draw("visit_pipeline_tiny", pipeline, &stimuli, 24, &lanes).assert_drawn_in("visit_pipeline");
}
