//! Many jobs on one device.
//!
//! A small mesh has no room for many insertions at once, so a device with several contexts gets a *group* of small
//! jobs, a mesh for each context. A job too large for that, or one that is left over, is a *frame*: it has the whole
//! memory ([`plan`]). Where the way to the device takes commands ahead, those of the next group or frame are sent
//! before the answers of the last are received ([`super::flight`]), so that the device never waits for the host.

mod plan;

use std::sync::mpsc::sync_channel;
use std::thread::{Builder, Scope};
use std::time::Duration;

use super::flight::{Carrier, Done, JobError};
use super::group::{Group, Ordered};
use super::load::Load;
use super::options::{Options, Stage};
use super::prepare::prepare;
use super::watch::tell;
use incircle_geometry::Order;
use incircle_geometry::Point;
use plan::{Part, Plan};

/// Most points of a job that others are done beside: in a group on a device, whose records are read at once, or by the
/// other threads of the processor.
pub(crate) const MAX_JOB_POINTS: usize = 8192;
/// Most points of a frame: its records are read at once.
const MAX_FRAME_POINTS: usize = 65_536;
/// Jobs that are taken between two looks at the listener; where threads share the jobs, for each thread.
pub(crate) const JOBS_PER_LOOK: usize = 64;

/// A batch on a device.
pub(crate) struct Batch<'b> {
    carrier: Carrier<'b>,
    /// Contexts that work.
    contexts: u32,
    done: Done,
    /// For each job that must go by itself how many contexts work on it.
    left: Vec<Option<u32>>,
}

impl<'b> Batch<'b> {
    pub(crate) fn new(carrier: Carrier<'b>, contexts: u32) -> Self {
        let (done, left) = (Done::nothing_of(carrier.jobs), vec![None; carrier.jobs.len()]);
        Self { carrier, contexts, done, left }
    }

    /// Does all jobs but those that must go one by one: those that share the memory with none on a way that takes
    /// nothing ahead, and very large ones on any. Of those it says how many contexts are to work on each.
    pub(crate) fn run(mut self) -> Result<(Done, Vec<Option<u32>>), JobError> {
        let (jobs, options) = (self.carrier.jobs, self.carrier.options);
        let plan = Plan::new(self.contexts, self.carrier.identity.capacity);
        let (small, mut frames) = self.divide(&plan);
        let groups = self.group(&plan, small, &mut frames)?;
        let Self { mut carrier, mut done, left, .. } = self;
        std::thread::scope(|scope| {
            let contexts = |job: usize| plan.frame_contexts(jobs[job].len());
            let frames = frames.into_iter().map(|job| (job, contexts(job))).collect();
            let mut groups = groups.into_iter().chain(order_frames(scope, jobs, frames, options.order));
            carrier.carry(&mut done, |carrier, done| next_load(carrier, &mut groups, done))
        })?;
        Ok((done, left))
    }

    /// The jobs that may share the memory, and the frames.
    fn divide(&mut self, plan: &Plan) -> (Vec<usize>, Vec<usize>) {
        let (mut small, mut frames) = (Vec::new(), Vec::new());
        for (job, points) in self.carrier.jobs.iter().enumerate() {
            if points.len() <= MAX_JOB_POINTS && plan.shares(points.len()) {
                small.push(job);
            } else {
                self.leave_alone(plan, job, &mut frames);
            }
        }
        (small, frames)
    }

    /// A job that shares the memory with none: a frame if it can be sent ahead.
    fn leave_alone(&mut self, plan: &Plan, job: usize, frames: &mut Vec<usize>) {
        let points = self.carrier.jobs[job].len();
        if points <= MAX_FRAME_POINTS && self.carrier.channel.capabilities().takes_ahead {
            frames.push(job);
        } else {
            self.left[job] = Some(plan.frame_contexts(points));
        }
    }

    /// Puts the small jobs in order and into groups; those that are better off alone join the frames. What needs no
    /// device is answered here.
    fn group(&mut self, plan: &Plan, small: Vec<usize>, frames: &mut Vec<usize>) -> Result<Vec<Group>, JobError> {
        let mut shared = self.in_order(small)?;
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
                        self.leave_alone(plan, own.job, frames);
                    }
                }
            }
        }
        Ok(groups)
    }

    /// These jobs in order, each for one context, but those that need no device: they are answered here.
    fn in_order(&mut self, small: Vec<usize>) -> Result<Vec<Ordered>, JobError> {
        let Carrier { jobs, options, .. } = self.carrier;
        let total = small.iter().map(|&job| jobs[job].len()).sum();
        let (mut shared, mut seen) = (Vec::new(), 0);
        for (place, job) in small.into_iter().enumerate() {
            if place % JOBS_PER_LOOK == 0 {
                tell(options, Stage::Order, seen, total)?;
            }
            let points = &jobs[job];
            seen += points.len();
            let ordered = Ordered { job, prepared: prepare(points, options.order, 1) };
            match self.carrier.answer_here(ordered, 1, &mut self.done)? {
                Some(ordered) => shared.push(ordered),
                None => self.done.passed += points.len(),
            }
        }
        Ok(shared)
    }
}

/// The commands of the next group that the device must do. A listener may end the batch here.
fn next_load(
    carrier: &Carrier<'_>,
    groups: &mut impl Iterator<Item = Group>,
    done: &mut Done,
) -> Result<Option<Load>, JobError> {
    for mut group in groups {
        tell(carrier.options, Stage::Insert, done.passed, carrier.points())?;
        done.passed += group.jobs.iter().map(|ordered| carrier.jobs[ordered.job].len()).sum::<usize>();
        if group.is_shared {
            return Ok(Some(Load::at_once(group, None)));
        }
        let time = group.only_job().map(|job| frame_time(carrier, job));
        let jobs = group.jobs.drain(..).map(|frame| carrier.answer_here(frame, 1, done)).collect::<Result<Vec<_>, _>>();
        group.jobs = jobs?.into_iter().flatten().collect();
        if !group.jobs.is_empty() {
            return Ok(Some(Load::at_once(group, time)));
        }
    }
    Ok(None)
}

/// The time that a frame may take.
fn frame_time(carrier: &Carrier<'_>, job: usize) -> Duration {
    let slow = carrier.channel.capabilities().pace.slow;
    let default = || Options::default_timeout(carrier.jobs[job].len()).saturating_mul(slow);
    carrier.options.timeout.unwrap_or_else(default)
}

/// Puts frames in order in a thread of its own, each for so many contexts, so that it is done while the device works.
/// It ends when nobody wants the next one.
fn order_frames<'s>(
    scope: &'s Scope<'s, '_>,
    jobs: &'s [Vec<Point>],
    frames: Vec<(usize, u32)>,
    order: Order,
) -> impl Iterator<Item = Group> + use<'s> {
    // It has one in hand until that is wanted: no more are kept.
    let (sender, ordered) = sync_channel(0);
    let in_order = move |(job, contexts): (usize, u32)| {
        Group::alone(Ordered { job, prepared: prepare(&jobs[job], order, contexts) }, contexts)
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
