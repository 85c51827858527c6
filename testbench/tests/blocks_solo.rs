//! Insertion alone: Rust, Verilog and recursive flips in a mesh of the test's own agree in every write, its order and its clock.
//! The visits are answered from that mesh after a random delay; what comes out is checked to be Delaunay by exact arithmetic.

mod block_ports;
mod flip_mesh;
mod stepper;

use flip_mesh::{Mesh, Point, Record, Written, INFINITE};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::{Solo, SoloWrites};
use stepper::bundles::{link_write, record_write, turned, Finding, Visit};
use stepper::{named_ports, Stepper};

named_ports!(
    Solo,
    [reset, starts, p, records, root_id, root, done, token, turned, verdict],
    [push, bundle, write, tests, flips, ends],
    clock
);
named_ports!(
    SoloWrites,
    [
        is_split,
        is_mend,
        is_test,
        step,
        p,
        records,
        root_id,
        root,
        id,
        a,
        b,
        outer,
        after,
        preceding,
        apex,
        apex_after_a,
        apex_before_b,
        visited,
        slot
    ],
    [write]
);

/// A write as it stands on the port.
fn packed(written: Written) -> u128 {
    match written {
        Written::Record(id, Record { v, n }) => record_write(id, v, n),
        Written::Link { id, slot, value } => link_write(id, slot, value),
    }
}

fn packed_record(record: &Record, slot: usize) -> u128 {
    turned(record.v, record.n, slot as u64, false, record.v.map(|v| v == INFINITE))
}

struct Rig {
    block: Stepper<Solo>,
    random: SplitMix64,
    /// The visit that is out, and the clocks until it completes.
    visit: Option<(Visit, usize)>,
    /// Clocks of the next visits: the shortest, and how much longer at most.
    delay: (usize, u64),
}

/// What a run showed.
#[derive(Debug, Default)]
struct Seen {
    writes: Vec<u128>,
    tests: usize,
    flips: usize,
    visits: usize,
    clocks: usize,
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

    /// Answers the visit that is due, from the mesh as the writes have left it.
    fn set_completion(&mut self, mesh: &Mesh, point: Point) {
        let due = self.visit.filter(|(_, clocks)| *clocks == 0);
        self.block.set("done", due.is_some());
        let Some((visit, _)) = due else {
            let noise = Finding { conflict: self.random.below(2) == 0, ..Finding::default() };
            self.block.set("verdict", noise.verdict());
            self.block.set("token", Visit::look(self.random.below(1 << 15)).token());
            self.block.set("turned", u128::from(self.random.next_u64()));
            return;
        };
        let stored = mesh.records[visit.u as usize];
        let slot = if visit.rotates { stored.slot_to(visit.f) } else { 0 };
        let record = stored.turned(slot);
        let conflict = mesh.conflicts(record.v, point);
        self.block.set("verdict", Finding { conflict, ..Finding::default() }.verdict());
        self.block.set("token", visit.token());
        self.block.set("turned", packed_record(&record, slot));
        self.visit = None;
    }

    /// One clock; `mesh` takes the write that is seen.
    fn clock(&mut self, starts: bool, mesh: &mut Mesh, point: Point, expected: &[u128], seen: &mut Seen) {
        self.block.set("starts", starts);
        self.set_completion(mesh, point);
        self.block.settle();
        self.block.expect_masked("write", 1, self.block.get_masked("write", 1));
        if self.block.get_masked("write", 1) == 1 {
            let write = *expected.get(seen.writes.len()).expect("a write that the flips make");
            self.block.expect("write", write);
            seen.writes.push(write);
            mesh.write(unpacked(write));
        }
        seen.tests += usize::from(self.block.is("tests"));
        seen.flips += usize::from(self.block.is("flips"));
        seen.has_ended = self.block.is("ends");
        seen.clocks += 1;
        if let Some((_, clocks)) = &mut self.visit {
            *clocks -= 1;
        }
        if self.block.is("push") {
            assert_eq!(self.visit, None, "at most one visit is out");
            let bundle = self.block.get("bundle");
            let visit = Visit::of_bundle(bundle);
            self.block.expect("bundle", visit.bundle(false, [0; 3]));
            assert!(!visit.locks);
            let delay = self.delay.0 + self.random.below(self.delay.1 + 1) as usize;
            self.visit = Some((visit, delay - 1));
            seen.visits += 1;
        }
        self.block.edge();
    }

    fn set_job(&mut self, mesh: &Mesh, root: u64) {
        self.block.set("p", mesh.points.len() as u64 - 1);
        self.block.set("records", mesh.records.len() as u64);
        self.block.set("root_id", root);
        self.block.set("root", packed_record(&mesh.records[root as usize], 0));
    }

    /// Inserts the last point of the mesh, which its records do not know yet. Stops after that many clocks.
    fn insert(&mut self, mesh: &mut Mesh, root: u64, expected: &[u128], most: usize) -> Seen {
        self.set_job(mesh, root);
        let point = mesh.points[mesh.points.len() - 1];
        let mut seen = Seen::default();
        while !seen.has_ended && seen.clocks < most {
            self.clock(true, mesh, point, expected, &mut seen);
        }
        if seen.has_ended {
            // The last write is seen a clock later, and nothing after it.
            let clocks = seen.clocks;
            for _ in 0..2 {
                self.clock(false, mesh, point, expected, &mut seen);
                assert!(!seen.has_ended);
            }
            (seen.clocks, seen.has_ended) = (clocks, true);
        }
        seen
    }
}

/// The write that these bits stand for.
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

/// Points of a box of this side, the first three a triangle that turns left.
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

/// Inserts points one by one; returns flips and clocks.
fn grow(rig: &mut Rig, points: &[Point], resets: bool) -> (usize, usize) {
    let mut mesh = Mesh::of([points[0], points[1], points[2]]);
    let (mut flips, mut clocks) = (0, 0);
    for point in &points[3..] {
        let places = mesh.places_of(*point);
        let root = places[rig.random.below(places.len() as u64) as usize];
        let mut reference = mesh.clone();
        let deeds = reference.insert(*point, root);
        let expected: Vec<u128> = deeds.writes.iter().map(|write| packed(*write)).collect();
        mesh.points.push(*point);
        if resets && rig.random.below(4) == 0 {
            let most = rig.random.below(80) as usize;
            let seen = rig.insert(&mut mesh.clone(), root, &expected, most);
            if !seen.has_ended {
                rig.reset();
            }
        }
        let seen = rig.insert(&mut mesh, root, &expected, 10_000);
        assert_eq!(seen.writes, expected);
        assert_eq!((seen.tests, seen.flips), (deeds.tests, deeds.flips));
        assert_eq!(deeds.tests, 2 * deeds.flips + 3);
        assert_eq!(mesh.records, reference.records);
        mesh.assert_delaunay();
        flips += seen.flips;
        clocks += seen.clocks;
    }
    (flips, clocks)
}

#[test]
fn solo_inserts_as_recursive_flips_do() {
    let mut random = SplitMix64::new(9);
    let mut rig = Rig::new((3, 12));
    let mut flips = 0;
    for side in [4, 6, 16, 1 << 16] {
        flips += grow(&mut rig, &points(&mut random, side, 14), true).0;
    }
    assert!(flips > 60 && rig.block.clocks() > 4000, "{flips} flips, {} clocks", rig.block.clocks());
}

#[test]
fn solo_takes_the_clocks_its_header_names() {
    let delay = 17;
    let mut random = SplitMix64::new(10);
    let mut rig = Rig::new((delay, 0));
    let all = points(&mut random, 64, 12);
    let (flips, clocks) = grow(&mut rig, &all, false);
    let insertions = all.len() - 3;
    let visits = (2 + 3 + 3) * insertions + (1 + 2) * flips;
    assert_eq!(clocks, 4 * insertions + visits * (delay + 1) + 3 * flips);
}

/// Inputs of `SoloWrites` that are ids.
const IDS: [&str; 12] =
    ["p", "records", "root_id", "id", "a", "b", "outer", "after", "preceding", "apex", "apex_after_a", "apex_before_b"];

#[test]
fn solo_writes_what_each_state_asks_for() {
    let mut random = SplitMix64::new(11);
    let mut block = Stepper::new("solo_writes", SoloWrites::default(), 1);
    for _ in 0..4000 {
        let ids = IDS.map(|_| random.below((1 << 15) - 1));
        let [p, records, root_id, id, a, b, outer, after, preceding, apex, apex_after_a, apex_before_b] = ids;
        for (port, value) in IDS.into_iter().zip(ids) {
            block.set(port, value);
        }
        let [v0, v1, v2, n0, n1, n2] = [(); 6].map(|()| random.below(1 << 15));
        block.set("root", turned([v0, v1, v2], [n0, n1, n2], 1, true, [true; 3]));
        let (visited, slot) = (random.below(1 << 15), random.below(3));
        block.set("visited", visited);
        block.set("slot", slot);
        let act = random.below(4);
        let step = random.below([3, 2, 3, 3][act as usize]);
        block.set("step", step);
        for (port, code) in [("is_split", 0), ("is_mend", 1), ("is_test", 2)] {
            block.set(port, act == code);
        }
        let (second, third) = (records, records + 1);
        block.settle();
        block.expect(
            "write",
            match (act, step) {
                (0, 0) => record_write(root_id, [p, v1, v2], [n0, second, third]),
                (0, 1) => record_write(second, [p, v2, v0], [n1, third, root_id]),
                (0, _) => record_write(third, [p, v0, v1], [n2, root_id, second]),
                (1, _) => link_write(visited, slot, records + step),
                (2, _) => link_write(visited, slot, id),
                (_, 0) => record_write(id, [p, a, apex], [apex_after_a, outer, preceding]),
                (_, 1) => record_write(outer, [p, apex, b], [apex_before_b, after, id]),
                _ => link_write(after, 2, outer),
            },
        );
    }
}
