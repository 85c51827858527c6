//! Completes visits in a closed loop: several contexts grow cavities in one triangulation, and the test plays its
//! records, locks and predicates. Rust, Verilog and cavities as sets of triangles must agree in every clock, and every
//! ring must be that of its cavity.

use std::collections::BTreeMap;

use crate::rig::cavity_growth::{spread, Around, Completion, Context, Ground, Outcome, Target};
use crate::rig::flip_mesh::Point;
use crate::rig::stepper::bundles::{turned, LockFinding, Visit};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::Attempts;
use incircle_protocol::SMALL;
use incircle_testkit::SplitMix64;

named_ports!(
    Attempts,
    [ring_capacity, early, completion, seeded, contexts, holds_priority, start, now],
    [is_done, follow, outcome, looks, entry, inner, lock, commit, releases, events],
    clock
);

const CONTEXTS: u64 = SMALL.contexts as u64;

/// State of a context as the blocks around see it.
#[derive(Clone, Debug, Default)]
struct Life {
    context: Context,
    awake: bool,
    will_retry: bool,
    has_overflowed: bool,
    root: u64,
    /// Clocks until the locks of a finished attempt are released, if it still holds some.
    due: Option<u64>,
}

/// A visit that completes, its record as a number, and the state around it a clock earlier.
struct Announced {
    done: Completion,
    turned: u128,
    around: Around,
}

/// Number of times that each event has happened.
type Tally = BTreeMap<&'static str, usize>;

/// The block among contexts, records and locks that the test plays.
struct Rig {
    block: Stepper<Attempts>,
    random: SplitMix64,
    ground: Ground,
    targets: Vec<Target>,
    ring: u64,
    lives: Vec<Life>,
    /// The context that holds each lock.
    locks: BTreeMap<u64, u64>,
    priority_context: Option<u64>,
    /// The visit that completes in this clock, as it was announced in the clock before.
    announced: Option<Announced>,
    now: u64,
    /// True if the mesh does not change by surprise.
    is_calm: bool,
    tally: Tally,
}

/// Points on a ring and some inside, so that a point in the middle removes many triangles.
fn ground_points(random: &mut SplitMix64, around: usize, within: usize) -> Vec<Point> {
    let mut points: Vec<Point> = (0..around)
        .map(|place| {
            let angle = place as f64 / around as f64 * std::f64::consts::TAU;
            let radius = 30_000.0 + random.below(40) as f64;
            (32_768 + (radius * angle.cos()) as i64, 32_768 + (radius * angle.sin()) as i64)
        })
        .collect();
    points.swap(1, around / 3);
    points.swap(2, 2 * around / 3);
    points.extend((0..within).map(|_| (random.below(1 << 16) as i64, random.below(1 << 16) as i64)));
    points
}

impl Rig {
    fn new(seed: u64, ring: u64, around: usize, within: usize) -> Self {
        let mut random = SplitMix64::new(seed);
        let points = ground_points(&mut random, around, within);
        let ground = Ground::of(&points);
        let mut wanted: Vec<Point> = points[..4].to_vec();
        wanted.extend((0..12).map(|_| (32_000 + random.below(1500) as i64, 32_000 + random.below(1500) as i64)));
        wanted.extend((0..24).map(|_| (random.below(1 << 16) as i64, random.below(1 << 16) as i64)));
        let targets = wanted.into_iter().filter_map(|point| ground.target(point)).collect();
        let lives =
            (0..CONTEXTS).map(|index| Life { context: Context { index, ..Context::default() }, ..Life::default() });
        let now = (1 << 22) - 500;
        let block = Stepper::new("attempts_small", Attempts::new(SMALL), seed as u32);
        let lives = lives.collect();
        let (locks, priority_context, tally) = (BTreeMap::new(), None, Tally::new());
        let announced = None;
        Self {
            block,
            random,
            ground,
            targets,
            ring,
            lives,
            locks,
            priority_context,
            announced,
            now,
            is_calm: false,
            tally,
        }
    }

    fn one_in(&mut self, times: u64) -> bool {
        !self.is_calm && self.random.below(times) == 0
    }

    /// Starts a context that sleeps, with its point or with another one.
    fn start(&mut self) {
        let context = self.random.below(CONTEXTS);
        let takes = {
            let (one_in_four, start) = (self.one_in(4), self.ground.somewhere(&mut self.random));
            let life = &mut self.lives[context as usize];
            let may = !life.awake && one_in_four && !(life.will_retry && life.due.is_some());
            if may && life.has_overflowed {
                // A context whose list overflowed inserts its point solo.
                (life.will_retry, life.has_overflowed) = (false, false);
                self.priority_context = self.priority_context.filter(|holder| *holder != context);
            }
            if may {
                let record = if life.will_retry { life.root } else { start };
                life.context.out.push(Visit { context, ..Visit::look(record) });
                life.awake = true;
            }
            may && !life.will_retry
        };
        let id = self.random.below(1 << 15);
        self.block.set("takes", takes);
        self.block.set("start_context", context);
        self.block.set("start_id", id);
        self.block.set("now", self.now);
        if takes {
            let life = &mut self.lives[context as usize];
            (life.context.vertex, life.context.since, life.will_retry) = (id, self.now, false);
            life.context.target = self.random.below(self.targets.len() as u64) as usize;
        }
        self.now = (self.now + 1) % (1 << 22);
    }

    /// Reads the record, takes the lock and evaluates the predicates. Now and then the mesh seems
    /// to have changed since the walk.
    fn read(&mut self, visit: Visit) -> Completion {
        let life = &self.lives[visit.context as usize];
        let target = &self.targets[life.context.target];
        let (record, slot) = self.ground.read(&visit);
        let mut finding = self.ground.find(&visit, target, &mut self.random);
        let mut lock = LockFinding::default();
        if visit.locks {
            lock.took = !self.locks.contains_key(&visit.record);
            lock.foreign = *self.locks.entry(visit.record).or_insert(visit.context) != visit.context;
        } else {
            lock.again = self.one_in(8);
        }
        if !visit.rotates && visit.locks {
            finding.conflict &= !self.one_in(8);
            finding.falls_onto_corner |= self.one_in(8);
        }
        if lock.foreign || lock.again {
            // A record that is being changed gives arbitrary results.
            finding.conflict = self.one_in(2);
            finding.located = self.one_in(2);
        }
        Completion { visit, record, slot, lock, finding }
    }

    /// Announces the visit that completes in the next clock, or random values if none does.
    fn announce(&mut self, visit: Option<Visit>) -> Option<Announced> {
        let seeded = !self.one_in(100);
        let busy = self.lives.iter().enumerate().filter(|(_, life)| life.due.is_some());
        let busy = busy.fold(0u64, |set, (context, _)| set | 1 << context);
        for (port, value) in [("ring_capacity", self.ring), ("busy", busy)] {
            self.block.set(port, value);
        }
        let holds_priority = match visit {
            Some(visit) => self.priority_context == Some(visit.context),
            None => self.one_in(2),
        };
        self.block.set("seeded", seeded);
        self.block.set("holds_priority", holds_priority);
        self.block.set("early_done", visit.is_some());
        let anything =
            Visit { context: self.random.below(CONTEXTS), cavity_entry: self.random.below(64), ..Visit::look(0) };
        self.block.set("early_visit", visit.unwrap_or(anything).packed());
        let visit = visit?;
        let around = Around { seeded, ring: self.ring, holds_priority, is_busy: busy >> visit.context & 1 == 1 };
        let done = self.read(visit);
        let infinite = [self.one_in(2); 3];
        let turned = turned(done.record.v.map(spread), done.record.n, done.slot, done.lock, infinite);
        self.block.set("early_turned", turned);
        Some(Announced { done, turned, around })
    }

    /// Runs one clock: a visit completes, and the one of the next clock is announced.
    fn clock(&mut self, upcoming: Option<Visit>) -> Option<(Completion, Outcome)> {
        let next = self.announce(upcoming);
        let announced = std::mem::replace(&mut self.announced, next);
        let seen = announced.map(|Announced { done, turned, around }| {
            self.block.set("completion_visit", done.visit.packed());
            self.block.set("completion_turned", turned);
            self.block.set("verdict", done.finding.verdict());
            let outcome = self.lives[done.visit.context as usize].context.complete(&done, &around);
            (done, outcome)
        });
        self.block.settle();
        if self.block.clocks() > 0 {
            compare(&self.block, seen.as_ref());
        }
        self.block.edge();
        self.pass_time();
        if let Some((done, outcome)) = &seen {
            self.take(done, outcome);
        }
        seen
    }

    /// Lets time pass for the blocks further on, which release locks.
    fn pass_time(&mut self) {
        for (context, life) in (0..).zip(&mut self.lives) {
            if life.due == Some(0) {
                self.locks.retain(|_, holder| *holder != context);
                life.context.growth = Default::default();
            }
            life.due = life.due.and_then(|clocks| clocks.checked_sub(1));
        }
    }

    fn take(&mut self, done: &Completion, outcome: &Outcome) {
        let context = done.visit.context;
        let patience = self.random.below(30);
        let life = &mut self.lives[context as usize];
        life.awake = !outcome.sleeps;
        life.will_retry |= outcome.will_retry;
        life.root = outcome.root.unwrap_or(life.root);
        life.has_overflowed |= outcome.overflows;
        if outcome.commit.is_some() {
            life.context.growth.assert_ring(&self.ground, &self.targets[life.context.target]);
            let inners = life.context.growth.inner.len();
            *self.tally.entry("inner records").or_default() += inners;
            let is_full = life.context.growth.entries.len() as u64 == self.ring;
            *self.tally.entry("full rings").or_default() += usize::from(is_full);
        }
        if outcome.commit.is_some() || outcome.release.is_some() {
            life.due = Some(patience);
        }
        if outcome.duplicate || outcome.commit.is_some() || outcome.looks {
            life.will_retry = false;
        }
        let is_root = done.visit.locks && !done.visit.rotates;
        for (event, happens) in [
            ("commits", outcome.commit.is_some()),
            ("failures", outcome.release.is_some() && done.visit.rotates),
            ("waits at a root", outcome.revisit && is_root),
            ("waits at a test", outcome.revisit && done.visit.rotates),
            ("looks again while busy", outcome.revisit && !done.visit.locks && !done.lock.again),
            ("aborts at a root", outcome.aborts && is_root),
            ("aborts at a test", outcome.aborts && done.visit.rotates),
            ("takes the priority", outcome.asks_for_priority && self.priority_context.is_none()),
            ("locks while it drains", done.lock.took && outcome.entry.is_none() && outcome.push.is_none() && !is_root),
            ("outcome_overflows", outcome.overflows),
            ("duplicates of walks", outcome.duplicate && !is_root),
            ("duplicates of roots", outcome.duplicate && is_root),
            ("root_changed", outcome.root_changed),
            ("looks", outcome.looks),
        ] {
            *self.tally.entry(event).or_default() += usize::from(happens);
        }
        if outcome.returns_priority && self.priority_context == Some(context) {
            self.priority_context = None;
        } else if outcome.asks_for_priority && self.priority_context.is_none() {
            self.priority_context = Some(context);
        }
    }

    /// Returns a visit that is out, of some context, which completes in the next clock.
    fn any_visit(&mut self) -> Option<Visit> {
        let life = self.random.below(CONTEXTS) as usize;
        let place = self.random.below(self.lives[life].context.out.len() as u64) as usize;
        self.lives[life].context.out.get(place).copied()
    }

    /// Completes the visit that was announced.
    fn complete(&mut self) {
        let Some(Announced { done: Completion { visit, .. }, .. }) = self.announced else {
            return;
        };
        let out = &mut self.lives[visit.context as usize].context.out;
        let place = out.iter().position(|other| *other == visit).expect("the visit is out");
        out.swap_remove(place);
    }

    fn run(&mut self, clocks: usize) {
        for _ in 0..clocks {
            self.complete();
            let upcoming = self.any_visit();
            self.start();
            self.clock(upcoming);
        }
    }
}

/// Compares every output with the expected one.
fn compare(block: &Stepper<Attempts>, seen: Option<&(Completion, Outcome)>) {
    let nothing = Outcome::default();
    let outcome = seen.map_or(&nothing, |(_, outcome)| outcome);
    let visit = seen.map(|(done, _)| done.visit);
    let is = |rotates, locks| visit.is_some_and(|visit| visit.rotates == rotates && (visit.locks == locks || rotates));
    // Every visit may ask except a test that finds its edge final, whatever has become of its attempt.
    let may_ask = seen.is_some_and(|(done, _)| !is(true, true) || done.lock.foreign || done.finding.conflict);
    for (port, value) in [
        ("asks", outcome.push.is_some()),
        ("may_ask", may_ask),
        ("is_done", seen.is_some()),
        ("sleeps", outcome.sleeps),
        ("will_retry", outcome.will_retry),
        ("root_enable", outcome.root.is_some()),
        ("entry_valid", outcome.entry.is_some()),
        ("inner_valid", outcome.inner.is_some()),
        ("lock_valid", outcome.lock.is_some()),
        ("commit_valid", outcome.commit.is_some()),
        ("releases_valid", outcome.release.is_some()),
        ("asks_for_priority", outcome.asks_for_priority),
        ("waits", outcome.revisit && !is(false, false)),
        ("returns_priority", outcome.returns_priority),
        ("outcome_overflows", outcome.overflows),
        ("duplicate", outcome.duplicate),
        ("looks", outcome.looks),
        ("walk_visit", is(false, false) && !outcome.looks),
        ("root_visit", is(false, true)),
        ("test", is(true, true)),
        ("revisit", outcome.revisit),
        ("aborts", outcome.aborts),
        ("root_changed", outcome.root_changed),
    ] {
        block.expect(port, value);
    }
    let expect = |port, value: Option<u128>| value.into_iter().for_each(|value| block.expect(port, value));
    expect("outcome_context", visit.map(|visit| visit.context.into()));
    expect("root", outcome.root.map(Into::into));
    expect("entry_place", outcome.entry.map(|(place, _)| place.into()));
    expect("entry_entry", outcome.entry.map(|(_, edge)| edge.entry()));
    expect("inner_place", outcome.inner.map(|(place, _)| place.into()));
    expect("inner_id", outcome.inner.map(|(_, id)| id.into()));
    expect("lock_place", outcome.lock.map(|(place, _)| place.into()));
    expect("lock_id", outcome.lock.map(|(_, id)| id.into()));
    expect("commit_job", outcome.commit);
    expect("cavity_triangles", outcome.commit.map(|_| outcome.triangles.into()));
    expect("releases_job", outcome.release);
    if let Some((visits, bundle)) = outcome.push {
        // Fields of visits that are not made are open.
        let mask = (1 << [57, 78, 93][visits - 1]) - 1;
        block.expect_masked("bundle", mask, bundle & mask);
    }
}

#[test]
fn attempts_grow_the_rings_of_all_contexts_at_once() {
    let mut tally = Tally::new();
    for (seed, ring, around, within) in
        [(60, 32, 24, 0), (61, 32, 12, 12), (62, 10, 20, 8), (63, 6, 9, 20), (64, 3, 8, 8)]
    {
        let mut rig = Rig::new(seed, ring, around, within);
        rig.run(60_000);
        for (event, times) in &rig.tally {
            *tally.entry(event).or_default() += times;
        }
        assert!(ring < 6 || rig.tally["commits"] > 50, "ring {ring}: {:?}", rig.tally);
    }
    assert!(tally.len() == 16 && tally.values().all(|times| *times > 30), "{tally:?}");
}

#[test]
fn attempts_show_the_wave_of_their_header() {
    let mut rig = Rig::new(65, 32, 8, 8);
    rig.is_calm = true;
    // The first targets fall onto corners.
    let is_small = |target: &usize| rig.targets[*target].cavity.len() == 2;
    let target = (4..rig.targets.len()).find(is_small).expect("a small cavity");
    let context = &mut rig.lives[1].context;
    (context.target, context.vertex, context.since) = (target, 7, 3);
    for (port, value) in [("takes", 1u64), ("start_context", 1), ("start_id", 7), ("now", 3)] {
        rig.block.set(port, value);
    }
    rig.clock(None);
    rig.block.set("takes", false);
    let root = rig.targets[target].places[0];
    rig.lives[1].context.out.push(Visit { context: 1, ..Visit::look(root) });
    let mut wave = Wave::default();
    // The visits complete in their order; the pipeline between is left out.
    let completes = |clock: usize| clock % 2 == 1 || clock > 4;
    for clock in 0..12 {
        rig.complete();
        let upcoming = rig.lives[1].context.out.first().copied().filter(|_| completes(clock + 1));
        let seen = rig.clock(upcoming);
        let visit = seen.as_ref().map(|(done, _)| done.visit);
        let nothing = Outcome::default();
        let outcome = seen.as_ref().map_or(&nothing, |(_, outcome)| outcome);
        let number = |number: Option<u64>| number.map_or(Cell::Open, |number| Cell::Number(number.into()));
        let is = |rotates, locks| visit.is_some_and(|visit| (visit.rotates, visit.locks) == (rotates, locks));
        wave.take(&[
            ("early_done", Cell::Bit(upcoming.is_some())),
            ("walk_visit", Cell::Bit(is(false, false))),
            ("root_visit", Cell::Bit(is(false, true))),
            ("test", Cell::Bit(is(true, true))),
            ("asks", Cell::Bit(outcome.push.is_some())),
            ("visits", number(outcome.push.map(|(visits, _)| visits as u64))),
            ("lock_enable", Cell::Bit(outcome.lock.is_some())),
            ("lock_place", number(outcome.lock.map(|(place, _)| place))),
            ("entry_enable", Cell::Bit(outcome.entry.is_some())),
            ("entry_place", number(outcome.entry.map(|(place, _)| place))),
            ("sleeps", Cell::Bit(outcome.sleeps)),
            ("commit_enable", Cell::Bit(outcome.commit.is_some())),
        ]);
    }
    wave.assert_drawn_in("attempts");
}
