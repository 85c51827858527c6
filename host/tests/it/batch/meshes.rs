//! Every mesh of a batch on the model by clock is that of its job alone, for all kinds of points and all sizes up to the
//! capacity; nine of ten jobs have fewer than 300 points. There are 1,000 meshes, or as many as `INCIRCLE_MESHES` says:
//!
//! `INCIRCLE_MESHES=100000 cargo test --release -p incircle --test it batch::meshes -- --nocapture`

use incircle::{Device, Options, Point};
use incircle_protocol::{Config, FULL, SMALL, TINY};
use incircle_testkit::{generate, Distribution, SplitMix64};

/// Number of meshes without the variable.
const MESHES: usize = 1000;
/// Largest number of jobs of a batch.
const MOST_JOBS: u64 = 40;
/// One of this many jobs is a large one.
const LARGE_ONE_IN: u64 = 10;
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

#[test]
fn every_mesh_of_a_batch_is_that_of_its_job_alone() {
    let wanted = std::env::var("INCIRCLE_MESHES").map_or(MESHES, |text| text.parse().expect("a number of meshes"));
    let mut random = SplitMix64::new(2020);
    let (mut meshes, mut shared, mut teams, mut all_points) = (0, 0, 0, 0);
    while meshes < wanted {
        let (config, numbers) = CORES[random.below(CORES.len() as u64) as usize];
        let contexts = numbers[random.below(numbers.len() as u64) as usize];
        let jobs: Vec<Vec<Point>> =
            (0..1 + random.below(MOST_JOBS)).map(|_| points(&mut random, config.points.into())).collect();
        let mut device = Device::clock_model(config).expect("possible");
        let options = Options::default().contexts(contexts);
        let mut session = device.session().expect("a session");
        let found = session.triangulate_batch(&jobs, &options).expect("meshes");
        for (job, (found, points)) in found.into_iter().zip(&jobs).enumerate() {
            // Only a job that has the memory to itself has counters.
            let is_shared = found.report.counters.is_none() && found.report.contexts > 0;
            shared += usize::from(is_shared);
            teams += usize::from(is_shared && found.report.contexts > 1);
            let right = incircle::triangulate(points).expect("a mesh");
            let what = || format!("job {job} of {}, {} with {contexts} contexts, {points:?}", jobs.len(), config.name);
            assert!(found.mesh == right, "{}", what());
        }
        meshes += jobs.len();
        all_points += jobs.iter().map(Vec::len).sum::<usize>();
    }
    println!(
        "{meshes} meshes of {all_points} points are right, {shared} of jobs that shared a memory, {teams} by teams"
    );
    assert!(shared > meshes / 2 && teams > meshes / 20, "{shared} and {teams} of {meshes}");
}
