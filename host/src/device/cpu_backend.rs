//! The engine in this process.

use std::sync::{Mutex, PoisonError};
use std::thread::Builder;

use incircle_protocol::Identity;

use super::backend::{Backend, JobLeft, Terms, Together};
use crate::cpu::{self, CpuJob, CPU_NAME};
use crate::error::Error;
use crate::job::watch::{tell, Stopwatch};
use crate::job::{Options, Solution, Stage};
use crate::limit::Limit;
use crate::point::Point;

/// Most points of a job that one thread does, beside others.
const MAX_JOB_POINTS: usize = 8192;
/// Jobs for each thread between two looks at the listener.
const JOBS_PER_LOOK: usize = 64;

/// The engine in this process, with so many threads at most.
pub(crate) struct CpuBackend {
    pub(crate) threads: u32,
}

impl Backend for CpuBackend {
    fn name(&self) -> String {
        CPU_NAME.to_owned()
    }

    fn greet(&mut self, _limit: Limit) -> Result<Identity, Error> {
        Ok(cpu::identity(self.threads))
    }

    fn triangulate(&mut self, points: Vec<Point>, terms: Terms<'_>) -> Result<Solution, Error> {
        let Terms { contexts, limit, options, .. } = terms;
        let answer = CpuJob { points: &points, contexts, options, limit, watch: Stopwatch::start() }.run()?;
        Ok(answer.with(points))
    }

    /// Jobs side by side, each by one thread. Large jobs are left to all threads together.
    fn triangulate_together(&mut self, jobs: Vec<Vec<Point>>, terms: Terms<'_>) -> Result<Together, Error> {
        let total = jobs.iter().map(Vec::len).sum();
        let mut together = Together { solutions: jobs.iter().map(|_| None).collect(), left: Vec::new() };
        let (small, large): (Vec<_>, Vec<_>) =
            jobs.into_iter().enumerate().partition(|(_, points)| points.len() <= MAX_JOB_POINTS);
        let left = |(job, points)| JobLeft { job, points, contexts: terms.contexts };
        together.left = large.into_iter().map(left).collect();
        let (mut small, mut passed) = (small.into_iter().peekable(), 0);
        while small.peek().is_some() {
            tell(terms.options, Stage::Insert, passed, total)?;
            let look: Vec<_> = small.by_ref().take(JOBS_PER_LOOK * terms.contexts as usize).collect();
            for (job, solution) in side_by_side(look, terms) {
                let solution = solution?;
                passed += solution.mesh.points.len();
                together.solutions[job] = Some(solution);
            }
        }
        Ok(together)
    }
}

/// Jobs with their places in the list of the caller.
type Numbered<T> = Vec<(usize, T)>;

/// Does these jobs, each by one of the threads.
fn side_by_side(jobs: Numbered<Vec<Point>>, terms: Terms<'_>) -> Numbered<Result<Solution, Error>> {
    let Terms { contexts: threads, limit, options: Options { order, .. }, .. } = terms;
    let jobs = Mutex::new(jobs.into_iter());
    let next = || jobs.lock().unwrap_or_else(PoisonError::into_inner).next();
    let solve = |points: Vec<Point>| {
        let (options, watch) = (Options::default().order(*order), Stopwatch::start());
        let job = CpuJob { points: &points, contexts: 1, options: &options, limit, watch };
        job.run().map(|answer| answer.with(points))
    };
    let work = || std::iter::from_fn(next).map(|(job, points)| (job, solve(points))).collect::<Vec<_>>();
    std::thread::scope(|scope| {
        // If the system will not start a thread, the threads that did start share its work.
        let others: Vec<_> = (1..threads).map_while(|_| Builder::new().spawn_scoped(scope, work).ok()).collect();
        let mut solutions = work();
        for other in others {
            match other.join() {
                Ok(own) => solutions.extend(own),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        solutions
    })
}
