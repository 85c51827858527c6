//! Many jobs in one call: on a device, or on the threads of this process.
//!
//! A small mesh has no room for many insertions at once, so a device with several contexts gets a *group* of small jobs, a mesh for each
//! context. A job too large for that, or one that is left over, is a *frame*: it has the whole memory ([`plan`]). Where the link takes words
//! ahead, those of the next group or frame are sent before the answers of the last are received ([`flight`]), so that the device never waits
//! for the host.

mod commands;
mod flight;
mod group;
mod part_listener;
mod plan;
mod threads;

use std::sync::mpsc::sync_channel;
use std::thread::{Builder, Scope};

use incircle_protocol::Identity;

use crate::error::Error;
use crate::link::{Limit, Link};
use crate::options::{Options, Stage};
use crate::prepare::{prepare, Prepared};
use crate::report::Report;
use crate::session::tell;
use crate::solution::Solution;
use incircle_geometry::Order;
use incircle_geometry::{Mesh, Point};

use group::{Group, Ordered};
pub(crate) use part_listener::PartListener;
use plan::{Part, Plan};
pub(crate) use threads::on_threads;

/// Most points of a job that is one of a group: the records of a group are read at once.
const MAX_JOB_POINTS: usize = 8192;
/// Most points of a frame: its words are kept, and its records are read at once.
const MAX_FRAME_POINTS: usize = 65_536;
/// Jobs that are taken between two looks at the listener.
const JOBS_PER_LOOK: usize = 64;

/// What becomes of the jobs: meshes without their points, in the order of the caller, and those that must go one by one.
pub(crate) struct Done {
    pub(crate) meshes: Vec<Option<Solution>>,
    pub(crate) singles: Vec<Single>,
    /// Points of the jobs that have been begun or answered: what a listener hears is ahead by the jobs under way at most.
    pub(crate) passed: usize,
}

/// A job that goes alone.
pub(crate) struct Single {
    pub(crate) job: usize,
    /// As [`Options::contexts`].
    pub(crate) contexts: Option<u32>,
}

impl Done {
    fn nothing_of(jobs: &[Vec<Point>]) -> Self {
        Self { meshes: jobs.iter().map(|_| None).collect(), singles: Vec::new(), passed: 0 }
    }
}

/// Points of all jobs.
pub(crate) fn points_of(jobs: &[Vec<Point>]) -> usize {
    jobs.iter().map(Vec::len).sum()
}

/// A batch over a link.
pub(crate) struct Batch<'b> {
    pub(crate) identity: Identity,
    /// Contexts that work.
    pub(crate) contexts: u32,
    /// For all jobs that share the memory.
    pub(crate) limit: Limit,
    pub(crate) link: &'b mut Link,
    pub(crate) options: &'b Options<'b>,
    pub(crate) jobs: &'b [Vec<Point>],
}

impl Batch<'_> {
    /// All jobs but those that must go one by one: those that share the memory with none on a link that takes nothing ahead, and very
    /// large ones on any.
    pub(crate) fn run(mut self) -> Result<Done, Error> {
        let mut done = Done::nothing_of(self.jobs);
        let plan = Plan::new(self.contexts, self.identity.capacity);
        let (small, mut frames) = self.divide(&plan, &mut done);
        let groups = self.group(&plan, small, &mut frames, &mut done)?;
        std::thread::scope(|scope| {
            let contexts = |job: usize| plan.frame_contexts(self.jobs[job].len());
            let frames = frames.into_iter().map(|job| (job, contexts(job))).collect();
            let ordered = order_frames(scope, self.jobs, frames, self.options.order);
            self.carry(groups.into_iter().chain(ordered), &mut done)
        })?;
        Ok(done)
    }

    /// The jobs that may share the memory, and the frames.
    fn divide(&self, plan: &Plan, done: &mut Done) -> (Vec<usize>, Vec<usize>) {
        let (mut small, mut frames) = (Vec::new(), Vec::new());
        for (job, points) in self.jobs.iter().enumerate() {
            if points.len() <= MAX_JOB_POINTS && plan.shares(points.len()) {
                small.push(job);
            } else {
                self.leave_alone(plan, job, &mut frames, done);
            }
        }
        (small, frames)
    }

    /// A job that shares the memory with none: a frame if it can be sent ahead.
    fn leave_alone(&self, plan: &Plan, job: usize, frames: &mut Vec<usize>, done: &mut Done) {
        let points = self.jobs[job].len();
        if points <= MAX_FRAME_POINTS && self.link.takes_ahead() {
            frames.push(job);
        } else {
            done.singles.push(Single { job, contexts: Some(plan.frame_contexts(points)) });
        }
    }

    /// Puts the small jobs in order and into groups; those that are better off alone join the frames. What needs no device is answered here.
    fn group(
        &self,
        plan: &Plan,
        small: Vec<usize>,
        frames: &mut Vec<usize>,
        done: &mut Done,
    ) -> Result<Vec<Group>, Error> {
        let mut shared = self.in_order(small, done)?;
        // Jobs of one length side by side: none waits long for another.
        shared.sort_by_key(|ordered| std::cmp::Reverse(ordered.vertices()));
        let lengths: Vec<usize> = shared.iter().map(Ordered::vertices).collect();
        let mut rest = shared.into_iter();
        let mut groups = Vec::new();
        for part in plan.divide(&lengths) {
            match part {
                Part::Group(jobs) => groups.push(Group::sharing(rest.by_ref().take(jobs).collect())),
                // Put in order once more, for several contexts, when its turn comes.
                Part::Frame => {
                    if let Some(own) = rest.next() {
                        self.leave_alone(plan, own.job, frames, done);
                    }
                }
            }
        }
        Ok(groups)
    }

    /// These jobs in order, each for one context, but those that need no device: they are answered here.
    fn in_order(&self, small: Vec<usize>, done: &mut Done) -> Result<Vec<Ordered>, Error> {
        let total = small.iter().map(|&job| self.jobs[job].len()).sum();
        let (mut shared, mut seen) = (Vec::new(), 0);
        for (place, job) in small.into_iter().enumerate() {
            if place % JOBS_PER_LOOK == 0 {
                tell(self.options, Stage::Order, seen, total)?;
            }
            let points = &self.jobs[job];
            seen += points.len();
            let prepared = prepare(points, self.options.order, 1);
            let is_answered = prepared.collinear;
            shared.extend(self.answer_here(Ordered { job, prepared }, done)?);
            if is_answered {
                done.passed += points.len();
            }
        }
        Ok(shared)
    }

    /// Answers a job that needs no device; gives back one that does. An error if the device cannot hold it.
    fn answer_here(&self, ordered: Ordered, done: &mut Done) -> Result<Option<Ordered>, Error> {
        let (distinct, capacity) = (ordered.vertices(), self.identity.capacity);
        if distinct > capacity as usize {
            let source = Box::new(Error::Capacity { distinct, capacity, device: self.link.name() });
            return Err(Error::InJob { job: ordered.job, source });
        }
        if !ordered.prepared.collinear {
            return Ok(Some(ordered));
        }
        let Ordered { job, prepared } = ordered;
        done.meshes[job] = Some(self.mesh(job, Vec::new(), prepared.order.clone(), prepared));
        Ok(None)
    }

    /// Everything but the points.
    fn mesh(&self, job: usize, triangles: Vec<[u32; 3]>, hull: Vec<u32>, prepared: Prepared) -> Solution {
        let report = Report {
            points: self.jobs[job].len(),
            distinct: self.jobs[job].len() - prepared.duplicates.len(),
            duplicates: prepared.duplicates.len(),
            triangles: triangles.len(),
            hull: hull.len(),
            collinear: prepared.collinear,
            backend: self.link.name(),
            order: self.options.order.name(),
            coord_bits: self.identity.coord_bits,
            capacity: self.identity.capacity,
            contexts: 1,
            ..Report::default()
        };
        Solution { mesh: Mesh::new(Vec::new(), triangles, hull, prepared.duplicates), report }
    }
}

/// Puts frames in order in a thread of its own, each for so many contexts, so that it is done while the device works. It ends when nobody
/// wants the next one.
fn order_frames<'s>(
    scope: &'s Scope<'s, '_>,
    jobs: &'s [Vec<Point>],
    frames: Vec<(usize, u32)>,
    order: Order,
) -> impl Iterator<Item = Group> + use<'s> {
    // It has one in hand until that is wanted: no more are kept.
    let (sender, ordered) = sync_channel(0);
    let in_order = move |(job, contexts): (usize, u32)| {
        Group::frame(Ordered { job, prepared: prepare(&jobs[job], order, contexts) }, contexts)
    };
    let kept = frames.clone();
    let has_thread = !frames.is_empty()
        && Builder::new()
            .spawn_scoped(scope, move || frames.into_iter().try_for_each(|frame| sender.send(in_order(frame))))
            .is_ok();
    // A system that gives no thread leaves the work here.
    let here = if has_thread { Vec::new() } else { kept };
    ordered.into_iter().chain(here.into_iter().map(in_order))
}
