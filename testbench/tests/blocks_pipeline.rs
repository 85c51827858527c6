//! A whole visit: queue, memories, reader, predicates and verdict together agree in Rust, in Verilog and in plain arithmetic, and
//! answer after the clocks they promise.
//!
//! The records are not those of a mesh but random ones, three links that differ and any corners, so that every turn, tie and ghost
//! comes up; the pipeline does not know the difference.

mod block_ports;
mod cosimulation;
mod structures;
mod visit_model;

use std::cell::RefCell;
use std::collections::VecDeque;

use cosimulation::{named_ports, Cosimulation, Expected, Numbers};
use incircle_hdl::engine::VisitPipeline;
use incircle_protocol::{infinite_vertex, Config, SMALL, TINY};
use structures::{pack, random, unpack, BUNDLE, TOKEN, WRITE};
use visit_model::{point, word, Record};

named_ports!([] VisitPipeline,
    [reset, infinite, push, bundle, p, read, read_id, write, vertex_id, vertex_position, vertex_enable, clear_id, clear_enable],
    [done, token, turned, verdict, read_done, v0, v1, v2, n0, n1, n2, was_set], clock);

const INPUTS: [&str; 13] = [
    "reset",
    "infinite",
    "push",
    "bundle",
    "p",
    "read",
    "read_id",
    "write",
    "vertex_id",
    "vertex_position",
    "vertex_enable",
    "clear_id",
    "clear_enable",
];
const OUTPUTS: [&str; 12] =
    ["done", "token", "turned", "verdict", "read_done", "v0", "v1", "v2", "n0", "n1", "n2", "was_set"];
/// Clocks from `read` to `read_done`.
const READ_CLOCKS: usize = 3;
/// Records and vertices that a test uses.
const POOL: u64 = 16;
/// Clocks of a round: writes, visits, rest, read-outs.
const ROUND: usize = 104;
const ROUNDS: usize = 45;

/// What comes out in a coming clock.
#[derive(Clone)]
enum Coming {
    Nothing,
    Visit { token: u128, turned: u128, verdict: u128 },
    Read { record: Record, was_set: bool },
}

/// The memories as arrays, the visits waiting, and what comes out when.
struct Visits {
    vertices: u64,
    infinite: u64,
    numbers: Numbers,
    records: Vec<Record>,
    locks: Vec<bool>,
    positions: Vec<u64>,
    p: u64,
    waiting: VecDeque<u128>,
    issued: Option<u128>,
    reads: Option<u64>,
    /// Place 0 is what comes out in this clock.
    coming: VecDeque<Coming>,
    seen: [usize; 5],
}

impl Visits {
    fn new(config: Config) -> Self {
        Self {
            vertices: config.points.into(),
            infinite: infinite_vertex(config.points).into(),
            numbers: Numbers::new(51),
            records: vec![Record::default(); 2 * config.points as usize],
            locks: vec![false; 2 * config.points as usize],
            positions: vec![0; config.points as usize],
            p: 0,
            waiting: VecDeque::new(),
            issued: None,
            reads: None,
            coming: vec![Coming::Nothing; VisitPipeline::STAGES + 1].into(),
            seen: [0; 5],
        }
    }

    /// A record of the pool, spread over the memory.
    fn record_id(&mut self) -> u64 {
        self.numbers.next() % POOL * (self.records.len() as u64 / POOL)
    }

    /// A vertex of the pool; the last one stands where the infinite vertex reads.
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
        let mut corners = [(); 3].map(|()| self.numbers.next());
        for corner in &mut corners {
            *corner = self.vertex_id(*corner);
        }
        let place = self.numbers.bits(3) as usize;
        if place < 3 {
            corners[place] = self.infinite;
        }
        let last = self.records.len() as u64 - 1;
        // Links of different columns differ, also when they are written one by one.
        let n = [0, 1, 2].map(|column| self.numbers.next() & last & !3 | column);
        let columns = if whole { 0b1111 } else { self.numbers.bits(4) };
        let [vertices, link0, link1, link2] = [0, 1, 2, 3].map(|bit| columns >> bit & 1);
        let [v0, v1, v2] = corners;
        let fields = [1, id, vertices, link0, link1, link2, v0, v1, v2, n[0], n[1], n[2]];
        pack(WRITE, fields)
    }

    fn bundle(&mut self) -> u128 {
        let mut bundle = random(BUNDLE, |bits| self.numbers.bits(bits));
        bundle[7] = self.record_id();
        bundle[10] = self.record_id();
        let link = self.numbers.next() as usize % 3;
        bundle[6] = self.records[bundle[7] as usize].n[link];
        pack(BUNDLE, bundle)
    }

    /// Inputs of a clock: first everything is written; then each round writes a little, visits, rests and reads.
    fn stimulus(&mut self, cycle: usize) -> Vec<u128> {
        let (round, clock) = (cycle / ROUND, cycle % ROUND);
        let mut write = 0;
        let mut vertex = (0, 0, false);
        let mut clears = false;
        let mut id = self.record_id();
        if round == 0 && clock < POOL as usize {
            id = clock as u64 * (self.records.len() as u64 / POOL);
            write = self.write(id, true);
            vertex = (self.vertex_id(clock as u64), self.position(), true);
        } else if round > 0 && clock < 10 {
            if self.numbers.bits(1) == 1 {
                write = self.write(id, false);
            }
            let place = self.numbers.next();
            vertex = (self.vertex_id(place), self.position(), self.numbers.bits(1) == 1);
            clears = true;
        }
        if clock == 19 {
            self.p = self.position();
        }
        let rate = [1, 2, 8][round % 3];
        let visits = (20..60).contains(&clock);
        let push = visits && self.waiting.len() < 7 && self.numbers.once_in(rate);
        let read = (94..102).contains(&clock) && self.numbers.bits(1) == 1;
        let reset = cycle == 0 || (round % 4 == 1 && (20..102).contains(&clock) && self.numbers.once_in(25));
        vec![
            reset.into(),
            self.infinite.into(),
            push.into(),
            self.bundle(),
            self.p.into(),
            read.into(),
            self.record_id().into(),
            write,
            vertex.0.into(),
            vertex.1.into(),
            vertex.2.into(),
            id.into(),
            clears.into(),
        ]
    }

    /// Outputs of a clock, then its edge.
    fn cycle(&mut self, values: &[u128]) -> Vec<Expected> {
        let shown = self.outputs();
        self.coming.pop_front();
        self.coming.push_back(Coming::Nothing);
        if let Some(token) = self.issued {
            self.visit(token);
        }
        self.edge(values);
        shown
    }

    fn outputs(&mut self) -> Vec<Expected> {
        let mut shown = vec![None; OUTPUTS.len()];
        shown[0] = Some(0);
        shown[4] = Some(0);
        match self.coming[0].clone() {
            Coming::Nothing => {}
            Coming::Visit { token, turned, verdict } => {
                let values = [1, token, turned, verdict];
                for (place, value) in shown.iter_mut().zip(values) {
                    *place = Some(value);
                }
                self.seen[0] += 1;
                self.seen[1] += usize::from(verdict & 1 == 1);
                self.seen[2] += usize::from(verdict >> 1 & 1 == 1);
                self.seen[3] += usize::from(turned >> 92 & 1 == 1);
            }
            Coming::Read { record, was_set } => {
                let [v0, v1, v2] = record.v;
                let [n0, n1, n2] = record.n;
                let values = [1, v0, v1, v2, n0, n1, n2, was_set.into()];
                for (place, value) in shown[4..].iter_mut().zip(values) {
                    *place = Some(value.into());
                }
                self.seen[4] += 1;
            }
        }
        shown
    }

    /// The visit in the issue register reads its record at this edge and comes out `STAGES` clocks later.
    fn visit(&mut self, token: u128) {
        let [rotates, locks, .., f, u] = unpack(TOKEN, token);
        let stored = self.records[u as usize];
        let slot = stored.slot(rotates == 1, f);
        let record = stored.turned(slot);
        let was_set = self.locks[u as usize];
        self.locks[u as usize] |= locks == 1;
        // The memory has no word for the infinite vertex: its id wraps.
        let r = record.v.map(|vertex| point(self.positions[(vertex % self.vertices) as usize]));
        self.coming[VisitPipeline::STAGES - 1] = Coming::Visit {
            token,
            turned: record.pack_turned(slot, was_set, self.infinite),
            verdict: record.verdict(r, point(self.p), self.infinite),
        };
    }

    fn edge(&mut self, values: &[u128]) {
        if let Some(id) = self.reads.take() {
            let (record, was_set) = (self.records[id as usize], self.locks[id as usize]);
            self.coming[READ_CLOCKS - 2] = Coming::Read { record, was_set };
        }
        if values[2] == 1 {
            let [is_pair, rotates, locks, x, after, f_entry, f, u, x2, after2, u2] = unpack(BUNDLE, values[3]);
            self.waiting.push_back(pack(TOKEN, [rotates, locks, x, after, f_entry, f, u]));
            if is_pair == 1 {
                let second = [rotates, locks, x2, after2, f_entry, f, u2];
                self.waiting.push_back(pack(TOKEN, second));
            }
        }
        self.issued = self.waiting.pop_front();
        self.reads = (values[5] == 1).then_some(values[6] as u64);
        let write = unpack(WRITE, values[7]);
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
        if values[10] == 1 {
            self.positions[values[8] as usize] = values[9] as u64;
        }
        if values[12] == 1 {
            self.locks[values[11] as usize] = false;
        }
        if values[0] == 1 {
            self.waiting.clear();
            self.issued = None;
            self.reads = None;
            self.coming.iter_mut().for_each(|coming| *coming = Coming::Nothing);
        }
    }
}

fn visits(name: &str, config: Config) {
    let visits = RefCell::new(Visits::new(config));
    let stimuli = (0..ROUND * ROUNDS).map(|cycle| visits.borrow_mut().stimulus(cycle));
    let mut is_reset = false;
    Cosimulation { name, rust: VisitPipeline::new(config), inputs: &INPUTS, outputs: &OUTPUTS }.run(
        stimuli,
        |values| {
            let shown = visits.borrow_mut().cycle(values);
            // Registers start with anything.
            let shown = if is_reset { shown } else { vec![None; OUTPUTS.len()] };
            is_reset = true;
            shown
        },
    );
    let seen = visits.into_inner().seen;
    assert!(seen.iter().all(|count| *count > ROUNDS), "visits, conflicts, located, locked before, read-outs: {seen:?}");
}

#[test]
fn visit_pipeline_of_a_tiny_core() {
    visits("visit_pipeline_tiny", TINY);
}

#[test]
fn visit_pipeline_of_a_small_core() {
    visits("visit_pipeline_small", SMALL);
}
