//! Inserts points solo in Rust and in Verilog beside recursive flips in a mesh of the test: all three must agree in
//! every write, its order and its clock. That mesh answers the visits after a random delay, and exact arithmetic
//! checks that the result is Delaunay.

use crate::rig::flip_mesh::{Mesh, Point, Record, Written, INFINITE};
use crate::rig::stepper::bundles::{link_write, record_write, turned, Finding, LockFinding, Visit};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::Solo;
use incircle_testkit::SplitMix64;

named_ports!(Solo, [reset, start, records, completion], [push, write, progress], clock);

/// A write as the port carries it.
fn packed(written: Written) -> u128 {
    match written {
        Written::Record(id, Record { v, n }) => record_write(id, v, n),
        Written::Link { id, slot, value } => link_write(id, slot, value),
    }
}

fn packed_record(record: &Record, slot: usize) -> u128 {
    turned(record.v, record.n, slot as u64, LockFinding::default(), record.v.map(|v| v == INFINITE))
}

/// An insertion to be made.
struct Job {
    context: u64,
    point: Point,
    /// Triangles that the walk visits; the last one holds the point.
    path: Vec<u64>,
    is_duplicate: bool,
    /// Writes that must be seen.
    expected: Vec<u128>,
}

/// The block, and the visit that it waits for.
struct Rig {
    block: Stepper<Solo>,
    random: SplitMix64,
    /// The visit that is out, and the clocks until it completes.
    visit: Option<(Visit, usize)>,
    /// Latency of the next visits in clocks: the least, and how much more there may be.
    delay: (usize, u64),
}

/// Events of a run.
#[derive(Debug, Default)]
struct Seen {
    writes: Vec<u128>,
    tests: usize,
    flips: usize,
    visits: usize,
    /// Number of visits that have completed.
    completed: usize,
    clocks: usize,
    /// The block was told to start a clock ago.
    has_started: bool,
    is_at_work: bool,
    has_ended: bool,
}

impl Rig {
    fn new(delay: (usize, u64)) -> Self {
        let mut rig =
            Self { block: Stepper::new("solo", Solo::default(), 1), random: SplitMix64::new(8), visit: None, delay };
        rig.reset();
        rig
    }

    fn reset(&mut self) {
        self.block.set("reset", true);
        self.block.settle();
        self.block.edge();
        self.block.set("reset", false);
        self.visit = None;
    }

    fn noise(&mut self) -> Finding {
        let bits = self.random.next_u64();
        Finding {
            conflict: bits & 1 == 1,
            located: bits & 2 == 2,
            falls_onto_corner: bits & 4 == 4,
            is_left: bits & 8 == 8,
            is_straight: bits & 16 == 16,
            walk_next: bits >> 49,
        }
    }

    /// Answers the visit that is due, from the mesh as the writes have left it.
    fn set_completion(&mut self, mesh: &Mesh, job: &Job, seen: &mut Seen) {
        let due = self.visit.filter(|(_, clocks)| *clocks == 0);
        self.block.set("completion_done", due.is_some());
        let mut finding = self.noise();
        let Some((visit, _)) = due else {
            self.block.set("verdict", finding.verdict());
            self.block.set("visit", Visit::look(self.random.below(1 << 15)).packed());
            self.block.set("turned", u128::from(self.random.next_u64()));
            return;
        };
        let stored = mesh.records[visit.record as usize];
        let slot = if visit.rotates { stored.slot_to(visit.cavity_record) } else { 0 };
        let record = stored.turned(slot);
        finding.conflict = mesh.conflicts(record.v, job.point);
        let rest = job.path.get(seen.completed..).unwrap_or_default();
        match rest {
            [_] => (finding.located, finding.falls_onto_corner) = (true, job.is_duplicate),
            [_, after, ..] => (finding.located, finding.walk_next) = (false, *after),
            [] => {}
        }
        self.block.set("verdict", finding.verdict());
        self.block.set("visit", visit.packed());
        self.block.set("turned", packed_record(&record, slot));
        self.visit = None;
        seen.completed += 1;
    }

    /// Sets the other inputs: those that are taken at `starts` are noise at all other times.
    fn set_job(&mut self, starts: bool, job: &Job, mesh: &Mesh) {
        self.block.set("start_valid", starts);
        let [context, vertex, start] = match starts {
            true => [job.context, mesh.points.len() as u64 - 1, job.path[0]],
            false => [self.random.below(32), self.random.below(1 << 15), self.random.below(1 << 15)],
        };
        self.block.set("start_context", context);
        self.block.set("start_vertex", vertex);
        self.block.set("start_record", start);
    }

    /// Runs one clock; `mesh` takes the write that is seen.
    fn clock(&mut self, starts: bool, mesh: &mut Mesh, job: &Job, seen: &mut Seen) {
        self.set_job(starts, job, mesh);
        self.set_completion(mesh, job, seen);
        self.block.settle();
        self.block.expect("is_at_work", seen.is_at_work);
        self.block.expect_masked("write", 1, self.block.get_masked("write", 1));
        if self.block.get_masked("write", 1) == 1 {
            let write = *job.expected.get(seen.writes.len()).expect("a write that the flips make");
            self.block.expect("write", write);
            seen.writes.push(write);
            mesh.write(unpacked(write));
        }
        seen.tests += usize::from(self.block.is("tests"));
        seen.flips += usize::from(self.block.is("flips"));
        seen.has_ended = self.block.is("ends");
        self.block.expect("inserts", seen.has_ended && !job.is_duplicate);
        seen.is_at_work = (seen.is_at_work || seen.has_started) && !seen.has_ended;
        seen.has_started = starts;
        seen.clocks += 1;
        if let Some((_, clocks)) = &mut self.visit {
            *clocks -= 1;
        }
        if self.block.is("push_valid") {
            self.expect_visit(job, seen);
            let delay = self.delay.0 + self.random.below(self.delay.1 + 1) as usize;
            let visit = Visit::of_bundle(self.block.get("bundle"));
            self.visit = Some((visit, delay - 1));
            seen.visits += 1;
        }
        self.block.edge();
    }

    fn expect_visit(&self, job: &Job, seen: &Seen) {
        assert_eq!(self.visit, None, "at most one visit is out");
        let bundle = self.block.get("bundle");
        let visit = Visit::of_bundle(bundle);
        self.block.expect("bundle", visit.bundle(1, 0, 0, 0));
        assert_eq!((visit.context, visit.locks), (job.context, false));
        if let Some(place) = job.path.get(seen.visits) {
            assert_eq!(visit, Visit { context: job.context, ..Visit::look(*place) });
        }
    }

    /// Inserts the last point of the mesh, which the records do not know yet. Stops after `most` clocks.
    fn insert(&mut self, mesh: &mut Mesh, job: &Job, most: usize) -> Seen {
        self.block.set("records", mesh.records.len() as u64);
        let mut seen = Seen::default();
        while !seen.has_ended && seen.clocks < most {
            self.clock(seen.clocks == 0, mesh, job, &mut seen);
        }
        if seen.has_ended {
            // The last write is seen a clock later, and nothing comes after it.
            self.block.set("records", self.random.below(1 << 15));
            let clocks = seen.clocks;
            for _ in 0..2 {
                self.clock(false, mesh, job, &mut seen);
                assert!(!seen.has_ended);
            }
            (seen.clocks, seen.has_ended) = (clocks, true);
        }
        seen
    }
}

/// The write that these bits carry.
fn unpacked(write: u128) -> Written {
    let field = |place: u32| (write >> place) as u64 & 0x7fff;
    let id = field(1);
    if write >> 16 & 1 == 1 {
        let columns = |place: u32| [field(place), field(place + 15), field(place + 30)];
        return Written::Record(id, Record { v: columns(20), n: columns(65) });
    }
    let slot = u64::from((write >> 17 & 7).trailing_zeros());
    Written::Link { id, slot, value: field(65) }
}

/// Points of a box of this side; the first three form a triangle that turns left.
fn points(random: &mut SplitMix64, side: u64, count: usize) -> Vec<Point> {
    let side = side as i64;
    let mut points = vec![(0, 0), (side - 1, 0), (side / 2, side - 1)];
    while points.len() < count {
        let mut coordinate = || random.below(side as u64) as i64;
        let point = (coordinate(), coordinate());
        if !points.contains(&point) {
            points.push(point);
        }
    }
    points
}

/// Sums over the insertions of a run.
#[derive(Debug, Default)]
struct Sums {
    insertions: usize,
    duplicates: usize,
    walked: usize,
    flips: usize,
    clocks: usize,
}

/// Triangles on the way to one that holds the point.
fn path(random: &mut SplitMix64, mesh: &Mesh, point: Point) -> Vec<u64> {
    let mut path: Vec<u64> = (0..random.below(5)).map(|_| random.below(mesh.records.len() as u64)).collect();
    let places = mesh.places_of(point);
    path.push(places[random.below(places.len() as u64) as usize]);
    path
}

/// Lets the block find a point to be a duplicate.
fn find_duplicate(rig: &mut Rig, mesh: &Mesh, sums: &mut Sums) {
    let point = mesh.points[rig.random.below(mesh.points.len() as u64) as usize];
    let path = path(&mut rig.random, mesh, point);
    let job = Job { context: rig.random.below(24), point, path, is_duplicate: true, expected: vec![] };
    let seen = rig.insert(&mut mesh.clone(), &job, 10_000);
    assert_eq!((seen.visits, seen.tests, seen.flips), (job.path.len(), 0, 0));
    sums.duplicates += 1;
    sums.walked += job.path.len();
    sums.clocks += seen.clocks;
}

/// Inserts points one by one, with duplicates and attempts that a reset cuts off between them.
fn grow(rig: &mut Rig, points: &[Point], resets: bool) -> Sums {
    let mut mesh = Mesh::of([points[0], points[1], points[2]]);
    let mut sums = Sums::default();
    for point in &points[3..] {
        if rig.random.below(3) == 0 {
            find_duplicate(rig, &mesh, &mut sums);
        }
        let path = path(&mut rig.random, &mesh, *point);
        let mut reference = mesh.clone();
        let deeds = reference.insert(*point, path[path.len() - 1]);
        let expected = deeds.writes.iter().map(|write| packed(*write)).collect();
        let job = Job { context: rig.random.below(24), point: *point, path, is_duplicate: false, expected };
        mesh.points.push(*point);
        if resets && rig.random.below(4) == 0 {
            let most = rig.random.below(80) as usize;
            let seen = rig.insert(&mut mesh.clone(), &job, most);
            if !seen.has_ended {
                rig.reset();
            }
        }
        let seen = rig.insert(&mut mesh, &job, 10_000);
        assert_eq!(seen.writes, job.expected);
        assert_eq!((seen.tests, seen.flips), (deeds.tests, deeds.flips));
        assert_eq!(deeds.tests, 2 * deeds.flips + 3);
        assert_eq!(mesh.records, reference.records);
        mesh.assert_delaunay();
        sums.insertions += 1;
        sums.walked += job.path.len();
        sums.flips += seen.flips;
        sums.clocks += seen.clocks;
    }
    sums
}

#[test]
fn solo_inserts_as_recursive_flips_do() {
    let mut random = SplitMix64::new(9);
    let mut rig = Rig::new((3, 12));
    let (mut flips, mut duplicates) = (0, 0);
    for side in [4, 6, 16, 1 << 16] {
        let sums = grow(&mut rig, &points(&mut random, side, 14), true);
        flips += sums.flips;
        duplicates += sums.duplicates;
    }
    assert!(flips > 60 && rig.block.clocks() > 4000, "{flips} flips, {} clocks", rig.block.clocks());
    assert!(duplicates > 5, "{duplicates}");
}

#[test]
fn solo_takes_the_clocks_its_header_names() {
    let delay = 17;
    let mut random = SplitMix64::new(10);
    let mut rig = Rig::new((delay, 0));
    let sums = grow(&mut rig, &points(&mut random, 64, 12), false);
    let visits = sums.walked + 8 * sums.insertions + 3 * sums.flips;
    let own = 5 * sums.insertions + 3 * sums.flips + 2 * sums.duplicates;
    assert_eq!(sums.clocks, visits * (delay + 2) + own, "{sums:?}");
}

/// Visits take two clocks here: a walk of two triangles, the split, and the first test of an outer edge.
#[test]
fn solo_shows_the_wave_of_its_header() {
    let mut rig = Rig::new((2, 0));
    let mut mesh = Mesh::of([(0, 0), (8, 0), (0, 8)]);
    let point = (1, 1);
    let deeds = mesh.clone().insert(point, 0);
    let expected = deeds.writes.iter().map(|write| packed(*write)).collect();
    let job = Job { context: 3, point, path: vec![2, 0], is_duplicate: false, expected };
    mesh.points.push(point);
    rig.block.set("records", mesh.records.len() as u64);
    let (mut seen, mut wave) = (Seen::default(), Wave::default());
    for clock in 0..16 {
        let (visits, completed, writes) = (seen.visits, seen.completed, seen.writes.len());
        let is_at_work = seen.is_at_work;
        rig.clock(clock == 1, &mut mesh, &job, &mut seen);
        let visit = rig.visit.filter(|_| seen.visits > visits).map(|(visit, _)| visit.record);
        let number = |number: Option<u64>| number.map_or(Cell::Open, |number| Cell::Number(number.into()));
        let done = seen.completed > completed;
        let written = seen.writes.get(writes).map(|write| (write >> 1) as u64 & 0x7fff);
        wave.take(&[
            ("starts", Cell::Bit(clock == 1)),
            ("is_at_work", Cell::Bit(is_at_work)),
            ("push", Cell::Bit(visit.is_some())),
            ("bundle.record", number(visit)),
            ("done", Cell::Bit(done)),
            ("located", if done && completed < 2 { Cell::Bit(completed == 1) } else { Cell::Open }),
            ("write.valid", Cell::Bit(written.is_some())),
            ("write.id", number(written)),
        ]);
    }
    wave.assert_drawn_in("solo");
}
