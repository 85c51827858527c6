//! Batches on the threads of this process.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::Builder;

use super::{points_of, Done, Single, JOBS_PER_LOOK, MAX_JOB_POINTS};
use crate::cpu::CpuJob;
use crate::error::Error;
use crate::link::Limit;
use crate::options::{Options, Stage};
use crate::session::{tell, Stopwatch};
use crate::solution::Solution;
use incircle_geometry::Order;
use incircle_geometry::Point;

/// Jobs side by side on the threads of this process, each by one thread. Large jobs are left to all threads together.
pub(crate) fn on_threads(
    jobs: &[Vec<Point>],
    threads: u32,
    options: &Options<'_>,
    limit: Limit,
) -> Result<Done, Error> {
    let total = points_of(jobs);
    let mut done = Done::nothing_of(jobs);
    let (small, large): (Vec<usize>, Vec<usize>) = (0..jobs.len()).partition(|&job| jobs[job].len() <= MAX_JOB_POINTS);
    done.singles = large.into_iter().map(|job| Single { job, contexts: options.contexts }).collect();
    let order = options.order;
    for look in small.chunks(JOBS_PER_LOOK * threads as usize) {
        tell(options, Stage::Insert, done.passed, total)?;
        let taken = AtomicUsize::new(0);
        let work = || take_jobs(jobs, look, &taken, order, limit);
        let results = std::thread::scope(|scope| {
            // What threads cannot be had others do.
            let others: Vec<_> = (1..threads).map_while(|_| Builder::new().spawn_scoped(scope, work).ok()).collect();
            let mut results = work();
            for other in others {
                match other.join() {
                    Ok(own) => results.extend(own),
                    Err(panic) => std::panic::resume_unwind(panic),
                }
            }
            results
        });
        for (job, mesh) in results {
            done.meshes[job] = Some(mesh?);
            done.passed += jobs[job].len();
        }
    }
    Ok(done)
}

/// What a thread does: the next of these jobs that nobody has taken, until there is none.
fn take_jobs(
    jobs: &[Vec<Point>],
    look: &[usize],
    taken: &AtomicUsize,
    order: Order,
    limit: Limit,
) -> Vec<(usize, Result<Solution, Error>)> {
    let options = Options { order, ..Options::default() };
    let mut own = Vec::new();
    while let Some(&job) = look.get(taken.fetch_add(1, Ordering::Relaxed)) {
        let watch = Stopwatch::start();
        own.push((job, CpuJob { points: jobs[job].clone(), contexts: 1, options: &options, limit, watch }.run()));
    }
    own
}
