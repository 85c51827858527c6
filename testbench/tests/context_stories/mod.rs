//! Stories of points: what the surroundings of the context do in each clock, and what it must show.

use incircle_cli::generate::SplitMix64;

use crate::stepper::bundles::{record_write, turned, Finding, Visit};

pub const INFINITE: u64 = 0x7fff;
pub const PHASES: [&str; 6] = ["is_idle", "is_root", "is_cavity", "is_drain", "is_commit", "is_solo"];
pub const EVENTS: [&str; 5] = ["takes_point", "seeds", "drained", "walk_visit", "duplicate"];
/// Inputs that do nothing while low; all others are noise where a story does not set them.
pub const QUIET: [&str; 12] = [
    "reset",
    "clears",
    "point_valid",
    "done",
    "split",
    "overflows",
    "nothing_is_out",
    "commit_ends",
    "takes_fresh",
    "solo_push",
    "solo_ends",
    "locks_are_held",
];

/// One clock: inputs that are set, outputs that are known.
#[derive(Clone, Debug, Default)]
pub struct Row {
    pub inputs: Vec<(&'static str, u128)>,
    pub outputs: Vec<(&'static str, u128)>,
    /// Visits pushed and a record written in the clock before, if any.
    pub push: Option<Push>,
    pub write: Option<u128>,
}

/// A bundle, and which of its bits count.
#[derive(Clone, Copy, Debug)]
pub struct Push {
    pub bundle: u128,
    pub mask: u128,
}

impl Push {
    /// All bits of a bundle.
    fn whole(bundle: u128) -> Self {
        Self { bundle, mask: (1 << 78) - 1 }
    }

    /// One visit: what stands in the place of a second does not matter.
    fn single(visit: Visit) -> Self {
        Self { bundle: visit.bundle(false, [0; 3]), mask: (1 << 51) - 1 }
    }
}

/// Writes stories, and knows what the context knows.
pub struct Author {
    pub random: SplitMix64,
    rows: Vec<Row>,
    push: Option<Push>,
    write: Option<u128>,
    start: u64,
    records: u64,
    seeded: bool,
    collinear: bool,
    arrived: u64,
    vertex: Option<(u64, u64)>,
    root: Option<(u64, u128)>,
}

impl Author {
    pub fn new() -> Self {
        Self {
            random: SplitMix64::new(7),
            rows: vec![],
            push: None,
            write: None,
            start: 0,
            records: 0,
            seeded: false,
            collinear: false,
            arrived: 0,
            vertex: None,
            root: None,
        }
    }

    pub fn id(&mut self) -> u64 {
        self.random.below(1 << 15)
    }

    pub fn visit(&mut self) -> Visit {
        Visit {
            rotates: self.random.below(2) == 0,
            locks: self.random.below(2) == 0,
            x: self.random.below(64),
            after: self.random.below(64),
            f_entry: self.random.below(64),
            f: self.id(),
            u: self.id(),
        }
    }

    pub fn bundle(&mut self) -> u128 {
        let second = [self.random.below(64), self.random.below(64), self.id()];
        let is_pair = self.random.below(2) == 0;
        self.visit().bundle(is_pair, second)
    }

    pub fn finding(&mut self) -> Finding {
        let bits = self.random.next_u64();
        Finding {
            conflict: bits & 1 == 1,
            located: bits & 2 == 2,
            falls_onto_corner: bits & 4 == 4,
            is_left: bits & 8 == 8,
            is_straight: bits & 16 == 16,
            walk_next: self.id(),
        }
    }

    /// A clock in this phase, with these inputs and events.
    fn row(&mut self, phase: &str, inputs: &[(&'static str, u128)], events: &[&str]) {
        let mut outputs: Vec<_> = PHASES.iter().map(|name| (*name, u128::from(*name == phase))).collect();
        outputs.extend(EVENTS.iter().map(|name| (*name, u128::from(events.contains(name)))));
        outputs.extend([
            ("records", u128::from(self.records)),
            ("seeded", self.seeded.into()),
            ("collinear", self.collinear.into()),
        ]);
        if let Some((p, position)) = self.vertex {
            outputs.extend([("p", p.into()), ("position", position.into())]);
        }
        if let Some((id, root)) = self.root.filter(|_| phase != "is_walk") {
            outputs.extend([("root_id", id.into()), ("root", root)]);
        }
        if phase != "is_root" {
            outputs.push(("root_visits", 0));
        }
        let (push, write) = (self.push.take(), self.write.take());
        self.rows.push(Row { inputs: inputs.to_vec(), outputs, push, write });
    }

    fn rows_of(&mut self, phase: &str, most: u64) {
        for _ in 0..self.random.below(most + 1) {
            self.row(phase, &[], &[]);
        }
    }

    /// A point comes.
    fn point(&mut self) {
        let (id, point) = (self.arrived, self.random.below(1 << 32));
        let locks = self.random.below(2).into();
        let inputs = [("point_valid", 1), ("point_id", id.into()), ("point", point.into()), ("locks_are_held", locks)];
        self.row("is_idle", &inputs, &["takes_point"]);
        self.vertex = Some((id, point));
        self.arrived += 1;
        if self.seeded {
            self.push = Some(Push::single(Visit::look(self.start)));
            self.walk();
        } else if id == 0 {
            self.write = Some(record_write(0, [0, 1, 2], [0; 3]));
        } else if id == 2 {
            self.push = Some(Push::single(Visit::look(0)));
            self.seed();
        }
    }

    /// The look at the first three, and their records.
    fn seed(&mut self) {
        self.rows_of("seed", 20);
        let finding = Finding { is_straight: self.random.below(4) == 0, ..self.finding() };
        self.row("seed", &[("done", 1), ("verdict", finding.verdict())], &[]);
        if finding.is_straight {
            self.collinear = true;
            return;
        }
        let (b, c) = if finding.is_left { (1, 2) } else { (2, 1) };
        let records = [
            ([0, b, c], [1, 2, 3]),
            ([c, b, INFINITE], [3, 2, 0]),
            ([0, c, INFINITE], [1, 3, 0]),
            ([b, 0, INFINITE], [2, 1, 0]),
        ];
        for (id, (v, n)) in records.into_iter().enumerate() {
            self.row("seed", &[], if id == 3 { &["seeds"] } else { &[] });
            self.write = Some(record_write(id as u64, v, n));
        }
        self.seeded = true;
        self.records = 4;
    }

    fn walk(&mut self) {
        let mut at = self.start;
        loop {
            self.rows_of("is_walk", 8);
            let finding = Finding { located: self.random.below(3) == 0, ..self.finding() };
            let token = Visit { u: at, ..self.visit() }.token();
            let columns = [(); 6].map(|()| self.id());
            let [v0, v1, v2, n @ ..] = columns;
            let slot = self.random.below(3);
            let root = turned([v0, v1, v2], n, slot, finding.conflict, [finding.is_left; 3]);
            let inputs = [("done", 1), ("token", token), ("turned", root), ("verdict", finding.verdict())];
            let is_duplicate = finding.located && finding.falls_onto_corner;
            self.row("is_walk", &inputs, if is_duplicate { &["walk_visit", "duplicate"] } else { &["walk_visit"] });
            if !finding.located {
                self.push = Some(Push::single(Visit::look(finding.walk_next)));
                at = finding.walk_next;
                continue;
            }
            self.start = at;
            self.root = Some((at, root));
            if !is_duplicate {
                self.open(at, n);
            }
            return;
        }
    }

    /// The root's visits, once the locks are free; then the cavity and what follows.
    fn open(&mut self, root: u64, n: [u64; 3]) {
        for _ in 0..self.random.below(4) * 5 {
            self.row("is_root", &[("locks_are_held", 1)], &[]);
            self.rows.last_mut().expect("a row").outputs.push(("root_visits", 0));
        }
        let test = Visit { rotates: true, locks: true, f: root, ..Visit::default() };
        let lock = Visit { locks: true, ..Visit::look(root) };
        let pair = Visit { after: 1, u: n[0], ..test };
        let pushes = [
            (1, Push::single(lock)),
            (2, Push::whole(pair.bundle(true, [1, 2, n[1]]))),
            (1, Push::single(Visit { x: 2, u: n[2], ..test })),
        ];
        for (visits, push) in pushes {
            self.row("is_root", &[], &[]);
            self.rows.last_mut().expect("a row").outputs.push(("root_visits", visits));
            self.push = Some(push);
        }
        self.grow();
    }

    /// The cavity, to its end or its overflow.
    fn grow(&mut self) {
        let overflows = self.random.below(3) == 0;
        for _ in 0..self.random.below(12) {
            self.cavity_row("is_cavity");
        }
        if overflows {
            self.row("is_cavity", &[("overflows", 1)], &[]);
            self.rows_of("is_drain", 10);
            self.row("is_drain", &[("nothing_is_out", 1)], &["drained"]);
            self.alone();
        } else {
            self.row("is_cavity", &[("nothing_is_out", 1)], &[]);
            self.commit();
        }
    }

    /// A clock of the cavity, in which a test may pass through its edge.
    fn cavity_row(&mut self, phase: &str) {
        let (done, verdict) = (self.random.below(2).into(), self.finding().verdict());
        if self.random.below(2) == 0 {
            let bundle = self.bundle();
            self.row(phase, &[("done", done), ("verdict", verdict), ("split", 1), ("split_bundle", bundle)], &[]);
            self.push = Some(Push::whole(bundle));
        } else {
            self.row(phase, &[("done", done), ("verdict", verdict)], &[]);
        }
    }

    fn commit(&mut self) {
        for _ in 0..2 {
            self.rows_of("is_commit", 4);
            self.row("is_commit", &[("takes_fresh", 1)], &[]);
            self.records += 1;
        }
        self.rows_of("is_commit", 4);
        self.row("is_commit", &[("commit_ends", 1)], &[]);
    }

    fn alone(&mut self) {
        for _ in 0..self.random.below(6) {
            self.rows_of("is_solo", 5);
            let bundle = self.bundle();
            let inputs = [("solo_push", 1), ("solo_bundle", bundle), ("done", self.random.below(2).into())];
            self.row("is_solo", &inputs, &[]);
            self.push = Some(Push::whole(bundle));
        }
        self.row("is_solo", &[("solo_ends", 1)], &[]);
        self.records += 2;
    }

    /// The clock at the edge of which everything is forgotten.
    fn forget(&mut self) {
        (self.start, self.records, self.arrived) = (0, 0, 0);
        (self.seeded, self.collinear) = (false, false);
    }

    /// The next story.
    pub fn story(&mut self) -> Vec<Row> {
        self.rows_of("is_idle", 3);
        // A collinear start takes no more points.
        let ends = self.collinear || self.arrived == INFINITE || self.random.below(60) == 0;
        if ends {
            self.row("is_idle", &[("clears", 1)], &[]);
            self.forget();
        } else {
            self.point();
        }
        std::mem::take(&mut self.rows)
    }

    /// A story that ends in a reset in its middle.
    pub fn broken_story(&mut self) -> Vec<Row> {
        let mut rows = self.story();
        rows.truncate(1 + self.random.below(rows.len() as u64) as usize);
        let last = rows.last_mut().expect("a story has a clock");
        last.inputs.push(("reset", 1));
        self.forget();
        (self.push, self.write, self.vertex, self.root) = (None, None, None, None);
        rows
    }
}
