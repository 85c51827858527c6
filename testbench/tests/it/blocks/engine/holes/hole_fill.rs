//! Runs `HoleFill` in Rust and in Verilog beside a plain recursion over the intervals of a ring, in eight contexts side
//! by side. Tests are answered with random apexes after random times, so holes of all shapes come up.

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::HoleFill;
use incircle_protocol::{Config, TINY};
use incircle_testkit::SplitMix64;

named_ports!(HoleFill, [reset, came, pushes, may_end, is_full, takes, taker, taken], [asks, hole, ending, job], clock);

/// Fields of a hole, in the order of their ports.
const FIELDS: [&str; 13] =
    ["i", "j", "base", "best", "challenger", "is_ready", "end", "first", "last", "depth", "is_dry", "locks", "is_new"];
const I: usize = 0;
const J: usize = 1;
const BASE: usize = 2;
const BEST: usize = 3;
const CHALLENGER: usize = 4;
const IS_READY: usize = 5;
const IS_DRY: usize = 10;
const IS_NEW: usize = 12;

/// The configuration of the exported block.
const FILLED: Config = Config { contexts: 8, ring: 32, ..TINY };

/// Number of places of a list.
const PLACES: u64 = FILLED.ring as u64;

/// An interval of a ring: its ends, and the other side of its base.
type Interval = [u64; 3];

/// A deletion of a context, by the rules.
struct Deletion {
    vertex: u64,
    locks: u64,
    first: u64,
    last: u64,
    end: u64,
    is_dry: bool,
    /// The intervals that are left, the next one last.
    left: Vec<Interval>,
    /// The apex of the next interval, if a test has named it or there is no choice.
    apex: Option<u64>,
    /// A test was asked for, and its answer comes in so many clocks, with this hole.
    answer: Option<(u64, [u64; 13])>,
}

impl Deletion {
    fn random(random: &mut SplitMix64) -> Self {
        let length = 3 + random.below(PLACES - 2);
        let first = random.below(PLACES);
        let last = (first + length - 1) % PLACES;
        let end = (first + random.below(length)) % PLACES;
        let mut new = Self {
            vertex: random.bits(15),
            locks: random.bits(7),
            first,
            last,
            end,
            is_dry: random.once_in(3),
            left: Vec::new(),
            apex: None,
            answer: None,
        };
        new.restart();
        new
    }

    fn next(&self, place: u64) -> u64 {
        if place == self.last {
            self.first
        } else {
            (place + 1) % PLACES
        }
    }

    /// All of the ring is to be filled.
    fn restart(&mut self) {
        self.left = vec![[self.next(self.end), self.end, 0]];
        self.look();
    }

    /// The vertices between the ends of an interval.
    fn between(&self, [i, j, _]: Interval) -> Vec<u64> {
        std::iter::successors(Some(self.next(i)), |&place| Some(self.next(place))).take_while(|&at| at != j).collect()
    }

    /// An interval with one vertex between its ends needs no test.
    fn look(&mut self) {
        let between = self.left.last().map(|&interval| self.between(interval)).unwrap_or_default();
        self.apex = (between.len() == 1).then(|| between[0]);
    }

    /// Goes on from the interval whose apex is known. Returns the triangle, unless nothing may be written.
    fn step(&mut self) -> Option<(Interval, u64)> {
        let (interval, apex) = (self.left.pop().expect("an interval"), self.apex.expect("its apex"));
        let [i, j, _] = interval;
        let [has_left, has_right] = [self.next(i) != apex, self.next(apex) != j];
        if self.is_dry && has_left {
            // A triangle will stand below the base.
            self.is_dry = false;
            self.restart();
            return None;
        }
        self.left.extend(has_right.then_some([apex, j, 2]));
        self.left.extend(has_left.then_some([i, apex, 1]));
        self.look();
        (!self.is_dry).then_some((interval, apex))
    }

    /// Steps that show at no port.
    fn settle(&mut self) {
        while self.is_dry && self.apex.is_some() {
            self.step();
        }
    }

    /// The hole as it opens, as fields of the port: of its interval, only the end counts.
    fn opened(&self, random: &mut SplitMix64) -> [u64; 13] {
        let mut any = || random.below(PLACES);
        let is_dry = u64::from(self.is_dry);
        [any(), self.end, 0, any(), any(), 0, self.end, self.first, self.last, 0, is_dry, self.locks, 1]
    }
}

/// The block beside the deletions of its contexts.
struct Rig {
    block: Stepper<HoleFill>,
    random: SplitMix64,
    deletions: Vec<Option<Deletion>>,
    /// A test, and the end of an item, are let through in this clock.
    pushes: bool,
    may_end: bool,
    /// Numbers of triangles, of deletions that ended with a write, and of those that ended flat.
    seen: [usize; 3],
}

impl Rig {
    /// Sets the inputs of a clock. Returns the context whose vertex is taken in it.
    fn drive(&mut self) -> Option<(usize, Deletion)> {
        let random = &mut self.random;
        [self.pushes, self.may_end] = [flip(random), flip(random)];
        self.block.set("pushes", self.pushes);
        self.block.set("may_end", self.may_end);
        self.block.set("is_full", flip(random));
        let open = (0..self.deletions.len()).find(|&context| self.deletions[context].is_none());
        let new = open.filter(|_| random.once_in(4)).map(|context| (context, Deletion::random(random)));
        self.block.set("takes", new.is_some());
        if let Some((context, deletion)) = &new {
            self.block.set("taker", *context as u64);
            self.block.set("taken", deletion.vertex);
        }
        self.block.set("came_valid", false);
        let due =
            |deletion: &Option<Deletion>| deletion.as_ref().is_some_and(|it| it.answer.is_some_and(|(n, _)| n == 0));
        if let Some(context) = self.deletions.iter().position(due) {
            let deletion = self.deletions[context].as_mut().expect("it is due");
            let (_, hole) = deletion.answer.take().expect("it is due");
            self.block.set("came_valid", true);
            self.block.set("came_hole_context", context as u64);
            for (field, value) in FIELDS.into_iter().zip(hole) {
                self.block.set(&format!("came_hole_hole_{field}"), value);
            }
            if hole[IS_READY] == 1 {
                deletion.apex = Some(hole[BEST]);
            }
            deletion.settle();
        }
        for deletion in self.deletions.iter_mut().flatten() {
            deletion.answer = deletion.answer.map(|(clocks, hole)| (clocks.saturating_sub(1), hole));
        }
        new
    }

    /// Compares a triangle, or the end of a deletion, with the rules.
    fn expect_job(&mut self) {
        let context = self.block.get("job_job_context") as usize;
        let deletion = self.deletions[context].as_mut().expect("a deletion is under way");
        let ends = self.block.is("job_job_ends");
        assert_eq!(ends, deletion.left.is_empty(), "the last job of context {context} is its end");
        let ([i, j, base], m) = match ends {
            false => deletion.step().expect("a triangle"),
            true => ([deletion.next(deletion.end), deletion.end, 0], deletion.next(deletion.next(deletion.end))),
        };
        for (port, value) in [("i", i), ("m", m), ("j", j), ("base", base)] {
            self.block.expect(&format!("job_job_{port}"), value);
        }
        self.block.expect("job_job_mends", !ends && deletion.next(i) == m);
        if ends {
            self.block.expect("job_job_vertex", deletion.vertex);
            self.block.expect("job_job_locks", deletion.locks);
        } else {
            self.seen[0] += 1;
        }
    }

    fn clock(&mut self) {
        let new = self.drive();
        self.block.settle();
        if self.block.is("asks") {
            let context = self.block.get("hole_context") as usize;
            let hole = FIELDS.map(|field| self.block.get(&format!("hole_hole_{field}")) as u64);
            let deletion = self.deletions[context].as_mut().expect("a deletion is under way");
            let interval = *deletion.left.last().expect("an interval");
            let between = deletion.between(interval);
            assert_eq!([hole[I], hole[J], hole[BASE]], interval, "the interval of context {context}");
            assert_eq!([hole[BEST], hole[CHALLENGER]], [between[0], between[1]]);
            assert_eq!([hole[IS_DRY], hole[IS_NEW]], [u64::from(deletion.is_dry), 0]);
            if self.pushes {
                let mut answer = hole;
                (answer[BEST], answer[IS_READY]) = (self.random.pick(&between), 1);
                deletion.answer = Some((self.random.below(30), answer));
            }
        }
        let ending = self.block.is("ending_valid").then(|| self.block.get("ending_context") as usize);
        if let Some(context) = ending {
            let deletion = self.deletions[context].as_ref().expect("a deletion is under way");
            assert!(deletion.left.is_empty(), "no interval of context {context} is left");
            self.block.expect("ending_is_flat", deletion.is_dry);
            self.block.expect("ending_vertex", deletion.vertex);
            self.block.expect("ending_locks", deletion.locks);
        }
        if self.block.is("job_valid") {
            self.expect_job();
        }
        if let Some(context) = ending.filter(|_| self.may_end) {
            let is_flat = self.deletions[context].take().is_some_and(|deletion| deletion.is_dry);
            self.seen[1 + usize::from(is_flat)] += 1;
        }
        self.block.edge();
        if let Some((context, mut deletion)) = new {
            deletion.answer = Some((self.random.below(40), deletion.opened(&mut self.random)));
            self.deletions[context] = Some(deletion);
        }
    }
}

#[test]
fn hole_fill_puts_each_triangle_once_and_in_order() {
    let block = Stepper::new("hole_fill", HoleFill::new(FILLED), 1);
    let deletions = (0..FILLED.contexts).map(|_| None).collect();
    let mut rig = Rig { block, random: SplitMix64::new(91), deletions, pushes: false, may_end: false, seen: [0; 3] };
    for port in ["came_valid", "pushes", "may_end", "is_full", "takes"] {
        rig.block.set(port, false);
    }
    for clock in 0..4 {
        rig.block.set("reset", clock < 3);
        rig.block.settle();
        rig.block.edge();
    }
    for _ in 0..15_000 {
        rig.clock();
    }
    let [triangles, full, flat] = rig.seen;
    assert!(triangles > 800 && full > 60 && flat > 2, "{:?}", rig.seen);
}
