//! Runs `Questions` in Rust and in Verilog in front of a mesh and a visit pipeline of plain code. Every answer is
//! compared with what the triangles say by their definition.

use std::collections::{BTreeSet, VecDeque};

use crate::rig::nearest::{distance, Nearest};
use crate::rig::standing_mesh::{Mesh, INFINITE};
use crate::rig::stepper::bundles::{unpack, Visit, BUNDLE, VERDICT};
use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::visit_model::{orientation, point, word, Point};
use incircle_hdl::living::Questions;
use incircle_protocol::{Config, FULL, TINY};
use incircle_testkit::{delaunay, generate, Distribution, SplitMix64};

named_ports!(
    Questions,
    [
        reset,
        clears,
        begins,
        opcode,
        signature,
        contexts,
        has_mesh,
        command.valid,
        command.data,
        response.ready,
        completion,
        sides,
        nearest,
        capacity,
        arrived,
        arrival,
        events,
        fetches,
        fetched
    ],
    [
        command.ready,
        response.valid,
        response.data,
        response.both,
        response.last,
        push,
        position,
        is_active,
        asks,
        start
    ],
    clock
);

/// Number of clocks from the issue of a visit to the requests that follow it.
const STAGES: usize = 16;
/// Most visits of a context in flight: two chains, and a chain round the centre before.
const MOST_VISITS: usize = 3;
/// Clocks in which the counts of the queues are cleared, with those of the reset.
const START: usize = 40;
const LOCATE: u64 = 8;
const INTERPOLATE: u64 = 9;
const NEAREST: u64 = 10;
/// The bits of a bundle that count only in visits of a chain, which have bit 1 of `entry`.
const CAVITY_ENTRY: u128 = 0x3f << 21;

/// The block with a mesh behind it.
struct Rig {
    block: Stepper<Questions>,
    mesh: Mesh,
    places: Vec<Point>,
    pipeline: Pipeline,
    random: SplitMix64,
    /// Visits of the last run.
    visited: usize,
}

/// The visits in flight: those that enter the queue, those in it, the one that is issued, and those in the stages.
struct Pipeline {
    entering: Vec<Visit>,
    queue: VecDeque<Visit>,
    issued: Option<Visit>,
    stages: VecDeque<Option<Visit>>,
}

impl Pipeline {
    fn new() -> Self {
        Self { entering: Vec::new(), queue: VecDeque::new(), issued: None, stages: VecDeque::from(vec![None; STAGES]) }
    }

    fn edge(&mut self, asked: Vec<Visit>) {
        self.stages.push_back(self.issued.take());
        self.queue.extend(self.entering.drain(..));
        self.issued = self.queue.pop_front();
        self.entering = asked;
    }

    /// Number of visits of a context in flight.
    fn count(&self, context: u64) -> usize {
        let staged = self.stages.iter().flatten().chain(&self.issued);
        staged.chain(&self.queue).chain(&self.entering).filter(|visit| visit.context == context).count()
    }
}

/// What the host does to the streams: it offers a word, and takes a beat, in one of so many clocks.
#[derive(Clone, Copy)]
struct Paces {
    words: u64,
    beats: u64,
}

impl Rig {
    fn new(name: &str, config: Config, seed: u64) -> Self {
        let mut block = Stepper::new(name, Questions::new(config), seed as u32);
        for port in ["clears", "begins", "command_valid", "response_ready", "completion_done", "arrival_came"] {
            block.set(port, false);
        }
        // No insertion is at work.
        block.set("events", 0u64);
        block.set("capacity", u64::from(config.points));
        block.set("arrived", 0u64);
        for clock in 0..START {
            block.set("reset", clock < 4);
            block.settle();
            block.edge();
        }
        Self {
            block,
            mesh: Mesh::new(Vec::new(), Vec::new()),
            places: vec![(0, 0); 24],
            pipeline: Pipeline::new(),
            random: SplitMix64::new(seed),
            visited: 0,
        }
    }

    /// Puts a new mesh behind the block, which forgets where its walks have ended.
    fn stand_on(&mut self, mesh: Mesh) {
        self.mesh = mesh;
        self.block.set("clears", true);
        self.block.settle();
        self.block.edge();
        self.block.set("clears", false);
    }

    /// Completes the visit of this clock.
    fn complete(&mut self) {
        let visit = self.pipeline.stages.pop_front().flatten();
        self.block.set("completion_done", visit.is_some());
        let Some(visit) = visit else { return };
        self.visited += 1;
        let record = self.mesh.records[visit.record as usize];
        let (corners, place) = (self.mesh.corners(&record), self.places[visit.context as usize]);
        let slot = record.slot(visit.rotates, visit.cavity_record);
        let verdict = record.verdict(slot, corners, place, INFINITE);
        let infinite = record.v.iter().position(|&vertex| vertex == INFINITE);
        self.block.set("nearest", Nearest::of(corners, infinite, place).packed(slot));
        assert!(unpack(VERDICT, verdict)[5] < self.mesh.records.len() as u64);
        self.block.set("completion_visit", visit.packed());
        self.block.set("completion_turned", record.turned(slot).pack_turned(slot, [false; 3], INFINITE));
        self.block.set("completion_verdict", verdict);
        for (slot, port) in
            ["sides_flags_e0_zero", "sides_flags_e1_zero", "sides_flags_e2_zero"].into_iter().enumerate()
        {
            let side = orientation(corners[(slot + 1) % 3], corners[(slot + 2) % 3], place);
            self.block.set(port, side == 0);
            self.block.set(&format!("sides_weights_w{slot}"), side as u64 & 0xffff_ffff);
        }
    }

    /// Passes an edge, and takes note of the visit that is asked for.
    fn edge(&mut self) {
        self.block.expect("start_valid", false);
        let pushed = if self.block.is("push_valid") { self.pushed() } else { Vec::new() };
        if let Some(visit) = pushed.first() {
            assert!(!visit.locks, "questions take no lock");
            assert!(pushed.len() + self.pipeline.count(visit.context) <= MOST_VISITS, "few visits of a context");
        }
        if self.block.is("position_valid") {
            let context = self.block.get("position_context") as u64;
            assert_eq!(self.pipeline.count(context), 0, "a place changes while no visit of the context is in flight");
            if let Some(first) = pushed.first().filter(|visit| visit.context == context) {
                assert!(!first.rotates && first.entry == 0 && pushed.len() == 1, "a walk begins with one visit");
            }
            self.places[context as usize] = point(self.block.get("position_point") as u64);
        }
        self.pipeline.edge(pushed);
        self.block.edge();
    }

    /// The one or two visits that are asked for.
    fn pushed(&self) -> Vec<Visit> {
        let mut packed = self.block.get_masked("push_bundle", !CAVITY_ENTRY);
        if Visit::of_bundle(packed).entry & 2 != 0 {
            packed = self.block.get("push_bundle");
        }
        let (first, bundle) = (Visit::of_bundle(packed), unpack(BUNDLE, packed));
        assert_eq!(bundle[1], 0, "two visits at most");
        let second = Visit { entry: first.after, after: bundle[10], record: bundle[11], ..first };
        [first, second][..1 + bundle[0] as usize].to_vec()
    }

    /// Asks about these places, checks the answers, and returns the number of clocks.
    fn ask(&mut self, opcode: u64, asked: &[Point], contexts: u64, has_mesh: bool, paces: Paces) -> u64 {
        let mut words = VecDeque::from([asked.len() as u64]);
        words.extend(asked.iter().copied().map(word));
        let (mut answer, mut clocks, mut begins) = (Vec::new(), 0, true);
        self.visited = 0;
        self.block.set("opcode", opcode);
        self.block.set("signature", 0x1234u64);
        self.block.set("contexts", contexts);
        self.block.set("has_mesh", has_mesh);
        loop {
            self.complete();
            let (offers, takes) = (self.random.once_in(paces.words), self.random.once_in(paces.beats));
            self.block.set("begins", begins);
            self.block.set("command_valid", offers && !begins && !words.is_empty());
            self.block.set("command_data", words.front().copied().unwrap_or(0));
            self.block.set("response_ready", takes);
            self.block.settle();
            let is_over = !begins && !self.block.is("is_active");
            if is_over {
                break;
            }
            if takes && self.block.is("response_valid") {
                self.block.expect("response_both", true);
                let beat = self.block.get("response_data") as u64;
                answer.extend([beat & 0xffff_ffff, beat >> 32]);
                let length = 2 + if has_mesh { part_words(opcode) * asked.len() } else { 0 };
                self.block.expect("response_last", answer.len() == length);
            }
            if offers && !begins && self.block.is("command_ready") {
                words.pop_front();
            }
            self.edge();
            begins = false;
            clocks += 1;
            assert!(clocks < 400_000, "the run ends");
        }
        assert!((0..24).all(|context| self.pipeline.count(context) == 0), "no visit is in flight after a run");
        self.edge();
        assert!(words.is_empty());
        self.check(opcode, asked, has_mesh, &answer);
        clocks
    }

    fn check(&self, opcode: u64, asked: &[Point], has_mesh: bool, answer: &[u64]) {
        let (status, parts) = if has_mesh { (0, asked.len()) } else { (7, 0) };
        let words = part_words(opcode);
        assert_eq!(answer[..2], [opcode << 24 | status << 16 | 0x1234, (words * parts) as u64]);
        let mut numbers = BTreeSet::new();
        for part in answer[2..].chunks(words) {
            let number = part[0] & 0xff_ffff;
            assert!(numbers.insert(number), "item {number} has two parts");
            let (place, outcome) = (asked[number as usize], part[0] >> 24);
            if opcode == NEAREST {
                assert_eq!((outcome, part[1]), (1, self.nearest(place)), "{place:?}: the nearest vertex");
                continue;
            }
            let vertices = [part[1], part[2], part[3]];
            self.mesh.check(place, outcome, vertices);
            if opcode == INTERPOLATE {
                assert_eq!([part[5], part[7], part[9]], [0; 3], "the weights of the core have one word each");
                self.mesh.check_weights(place, outcome, vertices, [part[4], part[6], part[8]]);
            }
        }
        assert_eq!(numbers.len(), parts, "each item has a part");
    }

    /// The vertex nearest to a place; of equal distances that of the smallest point.
    fn nearest(&self, place: Point) -> u64 {
        let nearness = |&(_, &point): &(usize, &Point)| (distance(point, place), point);
        self.mesh.points.iter().enumerate().min_by_key(nearness).map_or(0, |(vertex, _)| vertex as u64)
    }
}

/// Number of words of the part of an item.
fn part_words(opcode: u64) -> usize {
    match opcode {
        INTERPOLATE => 10,
        NEAREST => 2,
        _ => 4,
    }
}

/// A mesh of up to this many points on a small grid, and its side.
fn random_mesh(random: &mut SplitMix64, most: usize) -> (Mesh, u64) {
    loop {
        let side = [2, 3, 4, 7, 1 << 15][random.below(5) as usize];
        let count = 3 + random.below(most as u64 - 2) as usize;
        let points: BTreeSet<[u32; 2]> = (0..count).map(|_| [(); 2].map(|()| 1 + random.below(side) as u32)).collect();
        let mut points: Vec<[u32; 2]> = points.into_iter().collect();
        random.shuffle(&mut points);
        let triangles = delaunay(&points);
        if !triangles.is_empty() {
            let points = points.into_iter().map(|[x, y]| (i64::from(x), i64::from(y))).collect();
            return (Mesh::new(points, triangles), side);
        }
    }
}

fn random_runs(name: &str, config: Config, seed: u64, meshes: usize, most: u64) {
    let mut rig = Rig::new(name, config, seed);
    let mut random = SplitMix64::new(seed + 100);
    for number in 0..meshes {
        let (mesh, side) = random_mesh(&mut random, 14);
        rig.stand_on(mesh);
        for run in 0..4 {
            let count = random.below(most);
            let place = |random: &mut SplitMix64| {
                // Often a vertex, and sometimes beside the grid.
                let [x, y] = [(); 2].map(|()| random.below(side + 2) as i64);
                let vertex = random.below(rig.mesh.points.len() as u64) as usize;
                if random.once_in(5) {
                    rig.mesh.points[vertex]
                } else {
                    (x, y)
                }
            };
            let asked: Vec<Point> = (0..count).map(|_| place(&mut random)).collect();
            let contexts = 1 + random.below(u64::from(config.contexts));
            let paces = Paces { words: [1, 1, 5][(number + run) % 3], beats: [1, 6, 1][number % 3] };
            let opcode = LOCATE + random.below(3);
            rig.ask(opcode, &asked, contexts, !random.once_in(8), paces);
        }
    }
}

#[test]
fn questions_of_two_contexts_are_answered_by_the_definition() {
    random_runs("living_questions_2", TINY, 67, 60, 30);
}

#[test]
fn questions_of_16_contexts_are_answered_by_the_definition() {
    random_runs("living_questions_16", FULL, 68, 25, 200);
}

/// The places in Hilbert order, cut into a stretch for each context, and dealt in turn.
fn dealt(places: &[Point], contexts: usize) -> Vec<Point> {
    let points: Vec<incircle::Point> = places.iter().map(|&(x, y)| incircle::Point::new(x as u32, y as u32)).collect();
    let order = incircle::order::hilbert(&points);
    let stretch = order.len() / contexts;
    assert_eq!(stretch * contexts, order.len(), "equal stretches");
    (0..order.len()).map(|item| places[order[item % contexts * stretch + item / contexts] as usize]).collect()
}

/// Cycles of an item of a run of this kind about 8,000 places in Hilbert order, in a mesh of 8,000 uniform points.
fn cycles_of_an_item(opcode: u64) -> f64 {
    const COUNT: usize = 8_000;
    let set = |seed: u64| generate(Distribution::Uniform, COUNT, 16, seed).expect("a set of this size");
    let points: BTreeSet<[u32; 2]> = set(1).into_iter().collect();
    let points: Vec<[u32; 2]> = points.into_iter().collect();
    let stored: Vec<incircle::Point> = points.iter().copied().map(incircle::Point::from).collect();
    let triangles = incircle::triangulate(&stored).expect("a mesh").triangles;
    let pair = |points: Vec<[u32; 2]>| points.into_iter().map(|[x, y]| (i64::from(x), i64::from(y))).collect();
    let mut rig = Rig::new("living_questions_16", FULL, 69);
    rig.stand_on(Mesh::new(pair(points), triangles));
    let asked: Vec<Point> = dealt(&pair(set(2)), 16);
    let paces = Paces { words: 1, beats: 1 };
    // The first items bring the contexts to their stretches.
    rig.ask(LOCATE, &asked[..16], 16, true, paces);
    let clocks = rig.ask(opcode, &asked, 16, true, paces);
    let [cycles, visits] = [clocks as f64, rig.visited as f64].map(|count| count / COUNT as f64);
    println!("opcode {opcode}: {cycles:.2} cycles and {visits:.2} visits an item");
    cycles
}

#[test]
fn locate_takes_fewer_than_five_cycles_an_item() {
    let cycles = cycles_of_an_item(LOCATE);
    assert!(cycles < 5.0, "{cycles:.2} cycles an item");
}

#[test]
fn interpolate_takes_fewer_than_five_and_a_half_cycles_an_item() {
    let cycles = cycles_of_an_item(INTERPOLATE);
    assert!(cycles < 5.5, "{cycles:.2} cycles an item");
}

#[test]
fn nearest_takes_at_most_eight_cycles_an_item() {
    let cycles = cycles_of_an_item(NEAREST);
    assert!(cycles <= 8.0, "{cycles:.2} cycles an item");
}
