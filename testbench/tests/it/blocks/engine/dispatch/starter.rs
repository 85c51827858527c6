//! Starts contexts in a closed loop, in Rust and in Verilog beside a list of the vertices that each context has taken:
//! all three must agree in every clock.

use std::collections::VecDeque;

use crate::rig::stepper::bundles::Deal;
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::Starter;
use incircle_protocol::{Config, FIRST_ROUND, LARGE, SMALL};
use incircle_testkit::SplitMix64;

named_ports!(
    Starter,
    [reset, clears, deal, arrived, came, seeded, contexts, may_retry, solo_is_at_work, is_done, is_blocked, outcome],
    [planned, passed, start, solo_start],
    clock
);

/// A context as the blocks around see it.
#[derive(Clone, Copy, Debug, Default)]
struct Life {
    awake: bool,
    will_retry: bool,
    busy: bool,
    began: bool,
    /// The context has had a commit.
    hinted: bool,
    root: u64,
    /// The vertex that the context took last.
    last: Option<u64>,
}

/// State of the context at which the pointer stood, as the pointer saw it.
#[derive(Clone, Copy, Debug)]
struct Sight {
    context: u64,
    /// The vertex that the context took last.
    last: Option<u64>,
    vertex: u64,
}

/// The context at which the pointer stood two steps ago, and the decision about it.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    sight: Sight,
    is_due: bool,
    /// The context tries its point again.
    will_retry: bool,
    /// The record at which the context would start.
    record: u64,
    is_solo: bool,
}

/// Outputs of a clock.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    starts: bool,
    takes: Option<u64>,
    context: u64,
    waits: bool,
}

/// Inputs of a clock that do not come from a context.
#[derive(Clone, Copy, Debug, Default)]
struct Inputs {
    reset: bool,
    clears: bool,
    came: bool,
    seeded: bool,
    solo: bool,
    /// The context that asks for a solo insertion, or holds the priority.
    special: u64,
    solo_is_at_work: bool,
    all_rest: bool,
    is_urgent: bool,
    /// A visit completes, and may ask for others.
    is_done: bool,
    is_blocked: bool,
    deed: Option<(u64, Deed)>,
}

impl Inputs {
    /// Whether no other context than this one holds the priority and has waited for long.
    fn may_retry(&self, context: u64) -> bool {
        !self.is_urgent || self.special == context
    }
}

/// The starter among contexts that the test plays.
struct Rig {
    block: Stepper<Starter>,
    contexts: u64,
    /// Number of jobs, which divides that of the contexts.
    jobs: u64,
    arrived: u64,
    lives: Vec<Life>,
    /// Steps of the pointer since the last reset.
    steps: u64,
    passed: Option<Sight>,
    candidate: Option<Candidate>,
    /// Teams that are over the first round of their job.
    open: Vec<bool>,
}

impl Rig {
    fn new(name: &'static str, config: Config) -> Self {
        let contexts = config.contexts.into();
        let block = Stepper::new(name, Starter::new(config), 1);
        let mut rig = Self {
            block,
            contexts,
            jobs: 1,
            arrived: 0,
            lives: Vec::new(),
            steps: 0,
            passed: None,
            candidate: None,
            open: Vec::new(),
        };
        rig.forget();
        rig.clock(&Inputs { reset: true, ..Inputs::default() });
        rig
    }

    /// Forgets everything after a clock with reset or clear: no point has come, and all contexts sleep.
    fn forget(&mut self) {
        self.arrived = 0;
        self.lives = vec![Life::default(); self.contexts as usize];
        self.open = vec![false; self.jobs as usize];
        self.steps = 0;
        (self.passed, self.candidate) = (None, None);
    }

    fn deal(&self) -> Deal {
        Deal::new(self.contexts, self.jobs)
    }

    fn set(&self, flag: impl Fn(&Life) -> bool) -> u64 {
        (0..).zip(&self.lives).fold(0, |set, (place, life)| set | u64::from(flag(life)) << place)
    }

    /// Decides whether a context that the pointer has seen is due, and where it would start.
    fn decide(&self, inputs: &Inputs, sight: Sight) -> Option<Candidate> {
        let life = self.lives.get(sight.context as usize)?;
        let team = sight.context % self.jobs;
        let works = if sight.context == team { inputs.seeded || !life.began } else { self.open[team as usize] };
        let is_due = match life.will_retry {
            // In three of four rounds of the pointer no context tries again.
            true => {
                let has_rested = (self.steps / self.contexts).is_multiple_of(4);
                has_rested && inputs.may_retry(sight.context) && !life.busy
            }
            // In the first round of the pointer no context starts.
            false => self.steps >= self.contexts && sight.vertex < self.arrived && works,
        };
        // With one context only, that context may be starting in this clock.
        let starts_now = self.contexts == 1 && self.candidate.is_some_and(|candidate| candidate.is_due);
        Some(Candidate {
            sight,
            is_due: is_due && !life.awake && !starts_now && !inputs.solo,
            will_retry: life.will_retry,
            record: if life.will_retry || life.hinted { life.root } else { 4 * team },
            is_solo: inputs.solo && inputs.special == sight.context && !inputs.solo_is_at_work,
        })
    }

    /// Expected start: the vertex that the candidate takes, if it takes a new one, and the record at which it starts.
    fn wants(&self, inputs: &Inputs) -> Option<(Option<u64>, u64)> {
        let candidate = self.candidate.filter(|candidate| candidate.is_due && !inputs.solo)?;
        Some(((!candidate.will_retry).then_some(candidate.sight.vertex), candidate.record))
    }

    fn drive(&mut self, inputs: &Inputs) {
        let root = match inputs.deed {
            Some((context, Deed::Sleeps { root, .. })) => Some((context, root)),
            Some((_, Deed::IsFreed)) | None => None,
        };
        for (port, value) in [
            ("reset", inputs.reset),
            ("clears", inputs.clears),
            ("came", inputs.came),
            ("seeded", inputs.seeded),
            ("solo_valid", inputs.solo),
            ("solo_is_at_work", inputs.solo_is_at_work),
            ("all_rest", inputs.all_rest),
            ("may_retry", self.passed.is_none_or(|sight| inputs.may_retry(sight.context))),
            ("is_done", inputs.is_done),
            ("is_blocked", inputs.is_blocked),
            ("root_enable", root.is_some()),
        ] {
            self.block.set(port, value);
        }
        self.block.set("deal", self.deal().bits());
        let root = root.unwrap_or((1, 0x7fff));
        for (port, value) in [
            ("solo", u64::from(inputs.solo) << inputs.special),
            ("arrived", self.arrived),
            ("asleep", self.set(|life| !life.awake)),
            ("retrying", self.set(|life| life.will_retry)),
            ("busy", self.set(|life| life.busy)),
            ("began", self.set(|life| life.began)),
            ("hinted", self.set(|life| life.hinted)),
            ("outcome_context", root.0),
            ("root", root.1),
        ] {
            self.block.set(port, value);
        }
    }

    /// Runs one clock of the block and of the lists.
    fn clock(&mut self, inputs: &Inputs) -> Seen {
        self.drive(inputs);
        let wanted = self.wants(inputs);
        // A point that is being stored takes the port that a new point needs.
        let lacks_port = wanted.is_some_and(|start| start.0.is_some() && inputs.came);
        let start = wanted.filter(|_| !inputs.is_blocked && !lacks_port);
        let mut seen = Seen { waits: wanted.is_some() && (inputs.is_done || lacks_port), ..Seen::default() };
        self.block.settle();
        if self.block.clocks() > 0 {
            self.expect_pointer();
            self.block.expect("start_valid", start.is_some());
            self.block.expect("takes", start.is_some_and(|(vertex, _)| vertex.is_some()));
            if let Some(candidate) = self.candidate {
                self.block.expect("start_context", candidate.sight.context);
                self.expect_solo(inputs, candidate);
            }
            if let Some((vertex, record)) = start {
                self.block.expect("start_record", record);
                vertex.into_iter().for_each(|vertex| self.block.expect("start_id", vertex));
            }
            seen.starts = start.is_some();
            seen.takes = start.and_then(|(vertex, _)| vertex);
            seen.context = self.candidate.map_or(0, |candidate| candidate.sight.context);
        }
        self.block.edge();
        self.advance(inputs, seen);
        seen
    }

    /// Checks what the starter tells of the pointer: the context under it in its first round, and the one that it left.
    fn expect_pointer(&self) {
        let is_first_round = self.steps < self.contexts;
        self.block.expect("planned_valid", is_first_round);
        if is_first_round {
            self.block.expect("planned_context", self.steps);
            self.block.expect("planned_team", self.steps % self.jobs);
        }
        if let Some(sight) = self.passed {
            self.block.expect("passed_context", sight.context);
            self.block.expect("passed_team", sight.context % self.jobs);
        }
    }

    /// Checks the start of a solo insertion: the context starts once the pointer has seen it, with the point that it
    /// has, at the record of its attempt.
    fn expect_solo(&self, inputs: &Inputs, candidate: Candidate) {
        let may_start = inputs.all_rest && !inputs.solo_is_at_work;
        let starts = may_start && candidate.is_solo;
        self.block.expect("solo_start_valid", starts);
        if let Some(last) = candidate.sight.last.filter(|_| starts && candidate.will_retry) {
            self.block.expect("solo_start_vertex", last);
            self.block.expect("start_record", candidate.record);
        }
    }

    fn advance(&mut self, inputs: &Inputs, seen: Seen) {
        let decided = self.passed.and_then(|sight| self.decide(inputs, sight));
        if let Some(candidate) = self.candidate.as_mut().filter(|_| seen.starts) {
            candidate.is_due = false;
        }
        if !seen.waits {
            let context = self.steps % self.contexts;
            let last = self.lives[context as usize].last.filter(|_| self.lives[context as usize].began);
            let mut vertices = self.deal().dealt(context);
            let vertex = match last {
                Some(last) => vertices.find(|vertex| *vertex > last),
                None => vertices.next(),
            };
            self.candidate = decided;
            self.passed = vertex.map(|vertex| Sight { context, last, vertex });
            self.steps += 1;
        }
        if seen.starts {
            let life = &mut self.lives[seen.context as usize];
            life.last = seen.takes.or(life.last);
            (life.awake, life.will_retry, life.began) = (true, false, true);
            let is_dealt = |vertex| vertex >= u64::from(FIRST_ROUND) * self.jobs;
            self.open[(seen.context % self.jobs) as usize] |= seen.takes.is_some_and(is_dealt);
        }
        if let Some((context, deed)) = inputs.deed {
            let life = &mut self.lives[context as usize];
            match deed {
                Deed::Sleeps { root, will_retry, busy } => {
                    (life.awake, life.root, life.will_retry) = (false, root, will_retry);
                    life.busy |= busy;
                }
                Deed::IsFreed => (life.hinted, life.busy) = (true, false),
            }
        }
        if inputs.reset || inputs.clears {
            self.jobs = if inputs.reset { 1 } else { self.jobs };
            self.forget();
        }
    }
}

/// Events of a job.
#[derive(Default)]
struct Tally {
    taken: Vec<(u64, u64)>,
    again: usize,
    waits: usize,
    stops: VecDeque<u64>,
}

/// Lets points come and contexts work until all points are taken and all contexts sleep.
fn job(rig: &mut Rig, random: &mut SplitMix64, points: u64, tally: &mut Tally) {
    let (mut came, mut solo, mut is_urgent, mut special) = (false, false, false, 0);
    for _ in 0..200_000 {
        // Two points of each triple are taken with the third.
        let all_are_taken = tally.taken.len() as u64 + 2 * rig.jobs == points;
        if all_are_taken && rig.lives.iter().all(|life| !life.awake && !life.will_retry && !life.busy) {
            return;
        }
        let mut one_in = |times: u64| random.below(times) == 0;
        let comes = !came && rig.arrived < points && one_in(3);
        solo = if solo { !one_in(20) } else { one_in(400) };
        let seeded = rig.lives[0].began && !rig.lives[0].awake || rig.arrived > 3;
        is_urgent = if is_urgent { !one_in(30) } else { one_in(100) };
        let (is_done, may_ask, all_rest, solo_is_at_work) = (one_in(2), !one_in(3), one_in(2), one_in(2));
        special = if solo || is_urgent { special } else { random.below(rig.contexts) };
        let deed = deed(rig, random);
        let seen = rig.clock(&Inputs {
            came,
            seeded,
            solo,
            special,
            solo_is_at_work,
            all_rest,
            is_urgent,
            is_done,
            is_blocked: is_done && may_ask,
            deed,
            ..Inputs::default()
        });
        tally.taken.extend(seen.takes.map(|vertex| (seen.context, vertex)));
        tally.again += usize::from(seen.starts && seen.takes.is_none());
        tally.waits += usize::from(seen.waits);
        if !seen.waits {
            tally.stops.push_back(seen.context);
        }
        came = comes;
        rig.arrived += u64::from(comes);
    }
    panic!("of {points} points {} are taken: {:?}", tally.taken.len(), rig.lives);
}

/// Fate of a context at an edge.
#[derive(Clone, Copy, Debug)]
enum Deed {
    /// The context falls asleep, to try again from this root or not, with a commit or release due or not.
    Sleeps { root: u64, will_retry: bool, busy: bool },
    /// The commit of the context ends, and its locks are released.
    IsFreed,
}

/// Lets some context fall asleep, or frees it.
fn deed(rig: &Rig, random: &mut SplitMix64) -> Option<(u64, Deed)> {
    let context = random.below(rig.contexts);
    let root = random.below(1 << 15);
    let [ends, will_retry, busy, is_freed] = [4, 3, 3, 6].map(|times| random.below(times) == 0);
    let life = &rig.lives[context as usize];
    let sleeps = (life.awake && ends).then_some(Deed::Sleeps { root, will_retry, busy });
    let frees = (!life.awake && life.busy && is_freed).then_some(Deed::IsFreed);
    sleeps.or(frees).map(|deed| (context, deed))
}

/// Runs batches one after another, each with so many contexts, jobs and points.
fn batches(name: &'static str, config: Config, batches: &[(u64, u64, u64)]) {
    let mut random = SplitMix64::new(80);
    let (mut again, mut waits) = (0, 0);
    let mut rig = Rig::new(name, config);
    for (contexts, jobs, points) in batches.iter().copied() {
        // All contexts sleep when the mesh is cleared.
        // What the pointer has left belongs to the batch before.
        (rig.contexts, rig.jobs, rig.passed) = (contexts, jobs, None);
        rig.lives = vec![Life::default(); contexts as usize];
        rig.clock(&Inputs { clears: true, came: true, ..Inputs::default() });
        let mut tally = Tally::default();
        job(&mut rig, &mut random, points, &mut tally);
        let mut vertices: Vec<u64> = tally.taken.iter().map(|(_, vertex)| *vertex).collect();
        for context in 0..contexts {
            let own = tally.taken.iter().filter(|(taker, _)| *taker == context).map(|(_, vertex)| *vertex);
            let expected = rig.deal().dealt(context).take_while(|vertex| *vertex < points);
            assert!(own.eq(expected), "{contexts} contexts, {jobs} jobs, context {context}");
        }
        for team in 0..jobs {
            // Until point 16 of a job is taken, the first context of its team is the only one that works.
            let takers = tally.taken.iter().map(|(context, _)| *context).filter(|context| context % jobs == team);
            assert!(takers.take(FIRST_ROUND as usize - 1).all(|context| context == team), "team {team}");
        }
        vertices.sort_unstable();
        assert!(vertices.into_iter().eq((0..points).filter(|id| *id >= 3 * jobs || id % 3 == 2)));
        // The pointer skips no context; it is two contexts ahead.
        let stops: Vec<u64> = tally.stops.into_iter().skip(2).collect();
        assert!(stops.windows(2).all(|two| two[1] == (two[0] + 1) % contexts));
        (again, waits) = (again + tally.again, waits + tally.waits);
    }
    assert!(again > 100 && waits > 100, "{again} {waits}");
}

#[test]
fn starter_gives_every_point_to_its_context_once() {
    let of_small = [(4, 1, 300), (1, 1, 60), (3, 1, 250), (2, 1, 3), (2, 1, 16), (4, 1, 17), (2, 1, 18), (4, 1, 200)];
    batches("starter_small", SMALL, &of_small);
    batches("starter_large", LARGE, &[(24, 1, 600), (23, 1, 400), (1, 1, 20), (16, 1, 400), (9, 1, 17)]);
}

#[test]
fn starter_gives_every_job_of_a_batch_its_points() {
    let of_small = [(4, 4, 300), (4, 2, 300), (3, 3, 250), (2, 2, 6), (4, 2, 33), (4, 2, 34), (2, 2, 18), (4, 4, 200)];
    batches("starter_small", SMALL, &of_small);
    let of_large = [(24, 24, 600), (24, 2, 400), (24, 12, 600), (16, 4, 400), (15, 5, 300), (9, 9, 27), (24, 8, 500)];
    batches("starter_large", LARGE, &of_large);
}

#[test]
fn starter_forgets_what_it_was_at_when_it_is_reset() {
    let mut random = SplitMix64::new(81);
    let mut rig = Rig::new("starter_small", SMALL);
    for _ in 0..60 {
        for _ in 0..random.below(200) {
            let came = rig.arrived < 100 && random.below(2) == 0;
            let is_blocked = random.below(4) == 0;
            let (seeded, deed) = (rig.arrived > 3, deed(&rig, &mut random));
            rig.clock(&Inputs { came, seeded, is_done: is_blocked, is_blocked, deed, ..Inputs::default() });
            rig.arrived += u64::from(came);
        }
        rig.clock(&Inputs { reset: true, ..Inputs::default() });
    }
}

#[test]
fn starter_shows_the_wave_of_its_header() {
    let mut rig = Rig::new("starter_small", Config { contexts: 2, ..SMALL });
    rig.arrived = 2;
    let mut wave = Wave::default();
    for clock in 0..16 {
        let inputs = Inputs {
            came: clock == 1,
            is_done: matches!(clock, 4 | 5),
            is_blocked: clock == 4,
            deed: (clock == 7).then_some((0, Deed::Sleeps { root: 9, will_retry: true, busy: false })),
            ..Inputs::default()
        };
        if clock == 1 {
            rig.arrived = 3;
        }
        let asleep = rig.set(|life| !life.awake);
        let retrying = rig.set(|life| life.will_retry);
        let arrived = rig.arrived;
        let candidate = rig.candidate;
        let wanted = rig.wants(&inputs);
        let seen = rig.clock(&inputs);
        let number = |number: Option<u64>| number.map_or(Cell::Open, |number| Cell::Number(number.into()));
        wave.take(&[
            ("arrived", number(Some(arrived))),
            ("came", Cell::Bit(inputs.came)),
            ("is_done", Cell::Bit(inputs.is_done)),
            ("is_blocked", Cell::Bit(inputs.is_blocked)),
            ("asleep", number(Some(asleep))),
            ("retrying", number(Some(retrying))),
            ("context", number(candidate.map(|candidate| candidate.sight.context))),
            ("starts", Cell::Bit(seen.starts)),
            ("takes", Cell::Bit(seen.takes.is_some())),
            ("taken_id", number(seen.takes)),
            ("record", number(wanted.filter(|_| seen.starts).map(|(_, record)| record))),
        ]);
    }
    wave.assert_drawn_in("starter");
}
