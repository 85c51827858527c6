//! Every mesh of a batch on the model by clock is that of its job alone, for all kinds of points and all sizes up to
//! the capacity; nine of ten jobs have fewer than 300 points. There are 1,000 meshes, or as many as `INCIRCLE_MESHES`
//! says:
//!
//! `INCIRCLE_MESHES=100000 cargo test --release -p incircle --test it batch::meshes -- --nocapture`

use std::sync::Mutex;

use incircle::{Device, Options, Point};
use incircle_protocol::{Config, FULL, SMALL, TINY};
use incircle_testkit::{generate, Distribution, SplitMix64};

/// Number of meshes without the variable.
const MESHES: usize = 1000;
/// After this many meshes the command says how many are to come.
const REPORT: usize = 5000;
/// Largest number of jobs of a batch.
const MOST_JOBS: u64 = 40;
/// One of this many jobs is a large one.
const LARGE_ONE_IN: u64 = 10;
/// One of this many large jobs has as many points as the core holds.
const FULL_ONE_IN: u64 = 10;
/// Fewest points of a large job.
const LARGE: u64 = 300;

/// Cores with the numbers of contexts that batches may use: teams of many sizes, and lists that overflow.
const CORES: [(Config, &[u32]); 4] = [
    (SMALL, &[16, 15, 12, 5]),
    (FULL, &[16, 14, 9]),
    (Config { ring: 6, contexts: 24, ..SMALL }, &[24, 10]),
    (TINY, &[2]),
];

/// The number of points of a job: 0 to 299, or for a large job up to the capacity, small ones more often.
fn size(random: &mut SplitMix64, capacity: u64) -> usize {
    if random.below(LARGE_ONE_IN) > 0 || capacity <= LARGE {
        return random.below(LARGE.min(capacity + 1)) as usize;
    }
    if random.below(FULL_ONE_IN) == 0 {
        return capacity as usize;
    }
    let doublings = random.below(u64::from((capacity / LARGE).ilog2()) + 1);
    let most = (LARGE << (doublings + 1)).min(capacity);
    (LARGE + random.below(most - LARGE + 1)) as usize
}

/// Points of any kind, in a grid of any size: in a small one most fall together.
fn points(random: &mut SplitMix64, capacity: u64) -> Vec<Point> {
    let count = size(random, capacity);
    let kind = Distribution::ALL[random.below(Distribution::ALL.len() as u64) as usize];
    let bits = [16, 16, 16, 12, 8, 6][random.below(6) as usize];
    let seed = random.next_u64();
    // Some kinds have no room in a small grid.
    let made = generate(kind, count, bits, seed).or_else(|_| generate(Distribution::Uniform, count, bits, seed));
    made.expect("a uniform set").into_iter().map(|[x, y]| Point::new(x, y)).collect()
}

/// A batch and the core that does it.
struct Batch {
    config: Config,
    contexts: u32,
    jobs: Vec<Vec<Point>>,
}

/// Draws the batches one after another, so that they are the same for any number of threads.
struct Source {
    random: SplitMix64,
    /// Number of meshes that are still wanted.
    left: usize,
}

impl Source {
    fn next(&mut self) -> Option<Batch> {
        if self.left == 0 {
            return None;
        }
        let random = &mut self.random;
        let (config, numbers) = CORES[random.below(CORES.len() as u64) as usize];
        let contexts = numbers[random.below(numbers.len() as u64) as usize];
        let count = self.left.min(1 + random.below(MOST_JOBS) as usize);
        let jobs = (0..count).map(|_| points(random, config.points.into())).collect();
        self.left -= count;
        if self.left / REPORT != (self.left + count) / REPORT {
            println!("{} meshes to come", self.left);
        }
        Some(Batch { config, contexts, jobs })
    }
}

/// Counts of meshes that were right.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    meshes: usize,
    points: usize,
    /// Jobs below 300 points.
    small: usize,
    /// Large jobs of as many points as the core holds.
    full: usize,
    /// Jobs that shared a memory, and those of them that had a team of two contexts or more.
    shared: usize,
    teams: usize,
}

impl Tally {
    fn add(self, other: Self) -> Self {
        Self {
            meshes: self.meshes + other.meshes,
            points: self.points + other.points,
            small: self.small + other.small,
            full: self.full + other.full,
            shared: self.shared + other.shared,
            teams: self.teams + other.teams,
        }
    }
}

/// Does one batch, and compares each mesh with that of the job alone, by the CPU triangulator.
fn compare(batch: &Batch) -> Tally {
    let Batch { config, contexts, jobs } = batch;
    let mut device = Device::clock_model(*config).expect("possible");
    let options = Options::default().contexts(*contexts);
    let mut session = device.session().expect("a session");
    let found = session.triangulate_batch(jobs, &options).expect("meshes");
    assert_eq!(found.len(), jobs.len());
    let mut tally = Tally::default();
    for (job, (found, points)) in found.into_iter().zip(jobs).enumerate() {
        // Only a job that has the memory to itself has counters.
        let is_shared = found.report.counters.is_none() && found.report.contexts > 0;
        let right = incircle::triangulate(points).expect("a mesh");
        let what = || format!("job {job} of {}, {} with {contexts} contexts, {points:?}", jobs.len(), config.name);
        assert!(found.mesh == right, "{}", what());
        tally = tally.add(Tally {
            meshes: 1,
            points: points.len(),
            small: usize::from(points.len() < LARGE as usize),
            full: usize::from(points.len() >= LARGE as usize && points.len() == config.points as usize),
            shared: usize::from(is_shared),
            teams: usize::from(is_shared && found.report.contexts > 1),
        });
    }
    tally
}

#[test]
fn every_mesh_of_a_batch_is_that_of_its_job_alone() {
    let wanted = std::env::var("INCIRCLE_MESHES").map_or(MESHES, |text| text.parse().expect("a number of meshes"));
    let source = Mutex::new(Source { random: SplitMix64::new(2020), left: wanted });
    let next = || source.lock().expect("no thread has failed").next();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let tally = std::thread::scope(|scope| {
        let work = || std::iter::from_fn(next).map(|batch| compare(&batch)).fold(Tally::default(), Tally::add);
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        workers.into_iter().map(|worker| worker.join().expect("right meshes")).fold(Tally::default(), Tally::add)
    });
    println!("all meshes are right: {tally:?}");
    let Tally { meshes, small, full, shared, teams, .. } = tally;
    assert_eq!(meshes, wanted);
    assert!(small > meshes / 10 * 8 && full > meshes / 400, "{tally:?}");
    assert!(shared > meshes / 2 && teams > meshes / 20, "{tally:?}");
}
