//! Releases locks in Rust and in Verilog beside a list of the locks that are still to be cleared: all
//! three must agree in every clock.

use std::collections::VecDeque;

use crate::rig::stepper::bundles::release_job;
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::Release;
use incircle_protocol::{Config, MAX_CONTEXTS, MAX_RING, TINY};
use incircle_testkit::SplitMix64;

named_ports!(Release, [reset, last_id, lock, commit, failure], [sweeps, clear, released], clock);

const LONGEST: Config = Config { ring: MAX_RING, contexts: MAX_CONTEXTS, ..TINY };

/// A lock to clear; the last lock of a job names the job's context.
#[derive(Clone, Copy, Debug)]
struct Lock {
    id: u64,
    last_of: Option<u64>,
}

/// A context and its locks, all of them in the log.
type Job = (u64, Vec<u64>);

/// The release as lists of its tasks.
#[derive(Default)]
struct ReleaseReference {
    to_sweep: VecDeque<u64>,
    /// Jobs of finished rings, and jobs of aborted attempts.
    due: [VecDeque<Job>; 2],
    /// Locks of the job at work that have not been fetched.
    at_work: VecDeque<Lock>,
    /// Locks on their way, and the one that is cleared in this clock.
    ways: [Option<Lock>; 3],
}

impl ReleaseReference {
    fn shown(&self) -> Option<Lock> {
        self.ways[2]
    }

    fn edge(&mut self, drive: &Drive, last_id: u64) {
        let swept = self.to_sweep.pop_front().map(|id| Lock { id, last_of: None });
        self.ways = [self.at_work.pop_front(), self.ways[0], self.ways[1].or(swept)];
        if self.at_work.is_empty() {
            let [rings, failures] = &mut self.due;
            if let Some((context, ids)) = rings.pop_front().or_else(|| failures.pop_front()) {
                self.at_work = ids.into_iter().map(|id| Lock { id, last_of: None }).collect();
                self.at_work.back_mut().expect("a lock").last_of = Some(context);
            }
        }
        for (due, job) in self.due.iter_mut().zip([&drive.ring, &drive.failure]) {
            due.extend(job.clone());
        }
        if drive.reset {
            *self = Self { to_sweep: (0..=last_id).collect(), ..Self::default() };
        }
    }

    fn is_idle(&self) -> bool {
        self.at_work.is_empty() && self.due.iter().all(VecDeque::is_empty)
    }
}

/// Inputs of a clock.
#[derive(Clone, Debug, Default)]
struct Drive {
    reset: bool,
    /// A lock that joins the log: context, place, id.
    lock: Option<(u64, u64, u64)>,
    ring: Option<Job>,
    failure: Option<Job>,
}

/// Runs one clock of the block and the list; nothing is compared in the first one.
fn release_clock(block: &mut Stepper<Release>, reference: &mut ReleaseReference, drive: &Drive, last_id: u64) {
    let (context, place, id) = drive.lock.unwrap_or((1, 2, 0x5a5a & last_id));
    block.set("reset", drive.reset);
    block.set("last_id", last_id);
    block.set("lock_valid", drive.lock.is_some());
    block.set("lock_context", context);
    block.set("lock_place", place);
    block.set("lock_id", id);
    for (enable, port, job) in
        [("commit_valid", "commit_job", &drive.ring), ("failure_valid", "failure_job", &drive.failure)]
    {
        block.set(enable, job.is_some());
        block.set(port, job.as_ref().map_or(0xfff, |(context, ids)| release_job(*context, ids.len() as u64)));
    }
    block.settle();
    let shown = reference.shown();
    if block.clocks() > 0 {
        block.expect("sweeps", !reference.to_sweep.is_empty());
        block.expect("clear_valid", shown.is_some());
        block.expect("released_valid", shown.is_some_and(|lock| lock.last_of.is_some()));
    }
    if let Some(lock) = shown {
        block.expect("clear_id", lock.id);
        if let Some(context) = lock.last_of {
            block.expect("released_context", context);
        }
    }
    block.edge();
    reference.edge(drive, last_id);
}

/// State of a context.
#[derive(Clone, Debug)]
enum Attempt {
    /// The context logs this many more locks; the list has those logged so far.
    Logs(u64, Vec<u64>),
    /// The ring of the context is being written.
    Commits(Vec<u64>),
    /// The locks of the context are due.
    IsDue,
}

/// Contexts that take locks side by side.
struct Attempts {
    contexts: Vec<Attempt>,
    most: u64,
    last_id: u64,
    jobs: [usize; 2],
}

impl Attempts {
    fn new(config: Config, last_id: u64) -> Self {
        let contexts = vec![Attempt::IsDue; config.contexts as usize];
        Self { contexts, most: 2 * u64::from(config.ring) - 2, last_id, jobs: [0; 2] }
    }

    fn begin(&mut self, context: usize, random: &mut SplitMix64) {
        let locks = match random.below(6) {
            0 => 1,
            1 => self.most,
            _ => 1 + random.below(self.most.min(12)),
        };
        self.contexts[context] = Attempt::Logs(locks, Vec::new());
    }

    /// Lets some context take a lock, at which its attempt may abort, and possibly finishes the ring of a context.
    fn drive(&mut self, random: &mut SplitMix64) -> Drive {
        let mut drive = Drive::default();
        let context = random.below(self.contexts.len() as u64) as usize;
        if let Attempt::Logs(left, ids) = &mut self.contexts[context] {
            let id = random.below(self.last_id + 1);
            drive.lock = Some((context as u64, ids.len() as u64, id));
            ids.push(id);
            *left -= 1;
            if *left == 0 {
                let ids = ids.clone();
                let fails = random.below(2) == 0;
                self.contexts[context] = if fails { Attempt::IsDue } else { Attempt::Commits(ids.clone()) };
                drive.failure = fails.then_some((context as u64, ids));
            }
        }
        let context = random.below(self.contexts.len() as u64) as usize;
        if let (true, Attempt::Commits(ids)) = (random.below(3) == 0, &self.contexts[context]) {
            drive.ring = Some((context as u64, ids.clone()));
            self.contexts[context] = Attempt::IsDue;
        }
        self.jobs[0] += usize::from(drive.ring.is_some());
        self.jobs[1] += usize::from(drive.failure.is_some());
        drive
    }
}

fn releases_locks(name: &'static str, config: Config, last_id: u64) {
    let mut random = SplitMix64::new(2);
    let mut block = Stepper::new(name, Release::new(config), 1);
    let mut reference = ReleaseReference::default();
    let mut attempts = Attempts::new(config, last_id);
    let (mut resets, mut both_due, mut idle) = (0, 0, 0);
    for clock in 0..12_000 {
        let rests = !reference.to_sweep.is_empty() || clock / 500 % 3 == 1 && random.below(8) != 0;
        let mut drive = if rests { Drive::default() } else { attempts.drive(&mut random) };
        drive.reset = clock == 0 || random.below(1500) == 0;
        let released = reference.shown().and_then(|lock| lock.last_of);
        release_clock(&mut block, &mut reference, &drive, last_id);
        if let Some(context) = released {
            attempts.begin(context as usize, &mut random);
        }
        if drive.reset {
            (0..config.contexts as usize).for_each(|context| attempts.begin(context, &mut random));
        }
        resets += usize::from(drive.reset);
        both_due += usize::from(reference.due.iter().all(|due| !due.is_empty()));
        idle += usize::from(reference.is_idle());
    }
    let [rings, failures] = attempts.jobs;
    assert!(
        resets > 3 && both_due > 4 * config.contexts as usize && idle > 300 && rings > 100 && failures > 100,
        "{resets} resets, {both_due} clocks with rings and aborts due, {idle} idle; {rings} rings, {failures} aborts"
    );
}

#[test]
fn release_frees_what_was_locked() {
    releases_locks("release_6", TINY, 15);
}

#[test]
fn release_holds_the_locks_of_the_longest_list() {
    releases_locks("release_64", LONGEST, 300);
}

#[test]
fn release_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("release_64", Release::new(LONGEST), 1);
    let mut reference = ReleaseReference::default();
    let mut wave = Wave::default();
    for clock in 0..17 {
        let failures: [(usize, Job); 2] = [(6, (1, vec![27, 28])), (7, (0, vec![25]))];
        let rings: [(usize, Job); 1] = [(8, (3, vec![26]))];
        let job = |jobs: &[(usize, Job)]| jobs.iter().find(|(at, _)| *at == clock).map(|(_, job)| job.clone());
        let locks = [(3, (1, 0, 27)), (4, (1, 1, 28)), (5, (3, 0, 26)), (7, (0, 0, 25))];
        let drive = Drive {
            reset: clock == 0,
            lock: locks.into_iter().find(|(at, _)| *at == clock).map(|(_, lock)| lock),
            ring: job(&rings),
            failure: job(&failures),
        };
        let (shown, sweeps) = (reference.shown(), !reference.to_sweep.is_empty());
        release_clock(&mut block, &mut reference, &drive, 3);
        let number = |number: Option<u64>| number.map_or(Cell::Open, |number| Cell::Number(number.into()));
        wave.take(&[
            ("reset", Cell::Bit(drive.reset)),
            ("sweeps", Cell::Bit(sweeps)),
            ("lock_enable", Cell::Bit(drive.lock.is_some())),
            ("lock_id", number(drive.lock.map(|(.., id)| id))),
            ("failure_enable", Cell::Bit(drive.failure.is_some())),
            ("commit_enable", Cell::Bit(drive.ring.is_some())),
            ("clear_enable", Cell::Bit(shown.is_some())),
            ("clear_id", number(shown.map(|lock| lock.id))),
            ("released", Cell::Bit(shown.is_some_and(|lock| lock.last_of.is_some()))),
            ("released_context", number(shown.and_then(|lock| lock.last_of))),
        ]);
    }
    wave.assert_drawn_in("release");
}
