//! Many jobs on one device.
//!
//! A small mesh has no room for many insertions at once. A device with several contexts therefore gets a *group* of
//! jobs side by side, each with a mesh and a team of contexts of its own. A job that is too large for that, or left
//! over, is an *exclusive job*: it has the whole memory to itself ([`plan`] decides). If the transport takes commands
//! ahead, the commands of the next group or exclusive job are sent before the answers to the current one are received
//! ([`super::flight`]), so that the device never waits for the host.

mod plan;

use std::sync::mpsc::sync_channel;
use std::thread::{Builder, Scope};
use std::time::Duration;

use super::flight::{Carrier, Done, JobError};
use super::group::{Group, Ordered};
use super::load::Load;
use super::options::{Options, Stage};
use super::prepare::prepare;
use super::read_form::ReadForm;
use super::watch::tell;
use incircle_geometry::Order;
use incircle_geometry::Point;
use incircle_protocol::{Identity, ShortIds};
use plan::{Part, Plan};

/// Most points of a job that is done beside others: in a group, whose records are read with one command, or in one of
/// the threads of the back end `cpu`.
pub(crate) const MAX_JOB_POINTS: usize = 8192;
/// Most points of an exclusive job that is sent ahead: its records are read with one command.
const MAX_EXCLUSIVE_POINTS: usize = 65_536;
/// The version of the protocol from which on the jobs of a group may have teams of contexts.
const FIRST_VERSION_WITH_TEAMS: u32 = 2 << 16;
/// Jobs between two calls of the listener; for each thread, where threads share the jobs.
pub(crate) const JOBS_PER_LOOK: usize = 64;

/// The most points of a part of a set of `points` points, which the device cannot hold.
pub(crate) fn part_size(identity: &Identity, contexts: u32, points: usize) -> usize {
    let has_teams = identity.protocol_version >= FIRST_VERSION_WITH_TEAMS;
    let share = points.div_ceil(identity.engines.max(1) as usize);
    let size = Plan::new(contexts, identity.capacity, has_teams).part_size(share);
    // If the engines have one or two parts each, the parts have some room, because cuts do not halve a set exactly.
    let room = if share < identity.capacity as usize { size / 8 } else { 0 };
    (size + room).min(identity.capacity as usize)
}

/// A batch on a device.
pub(crate) struct Batch<'b> {
    carrier: Carrier<'b>,
    /// Contexts that may work.
    contexts: u32,
    done: Done,
    /// For each job that is left to the caller, the number of contexts that are to work on it; `None` for the others.
    left: Vec<Option<u32>>,
}

impl<'b> Batch<'b> {
    pub(crate) fn new(carrier: Carrier<'b>, contexts: u32) -> Self {
        let (done, left) = (Done::nothing_of(carrier.jobs), vec![None; carrier.jobs.len()]);
        Self { carrier, contexts, done, left }
    }

    /// Does the jobs of the batch, except those that must go one by one: very large jobs, and all exclusive jobs if the
    /// transport takes nothing ahead. The second result has, for each job that is left to the caller, the number of
    /// contexts with which it is expected to take the fewest clocks, and `None` for all others.
    pub(crate) fn run(mut self) -> Result<(Done, Vec<Option<u32>>), JobError> {
        let (jobs, options) = (self.carrier.jobs, self.carrier.options);
        let has_teams = self.carrier.identity.protocol_version >= FIRST_VERSION_WITH_TEAMS;
        let plan = Plan::new(self.contexts, self.carrier.identity.capacity, has_teams)
            .sharing_at_most(self.most_shared())
            .on_engines(self.carrier.engines_at_once());
        let (small, mut exclusive) = self.divide(&plan);
        let groups = self.group(&plan, small, &mut exclusive)?;
        let Self { mut carrier, mut done, left, .. } = self;
        std::thread::scope(|scope| {
            let contexts = |job: usize| plan.exclusive_contexts(jobs[job].len());
            let exclusive = exclusive.into_iter().map(|job| (job, contexts(job))).collect();
            let mut groups = groups.into_iter().chain(order_exclusive(scope, jobs, exclusive, options.order));
            carrier.carry(&mut done, |carrier, done| next_load(carrier, &mut groups, done))
        })?;
        Ok((done, left))
    }

    /// The most points that jobs which share the memory may have together, so that the device can keep their meshes for
    /// the line while its core goes on. Where the line may be slower than the core and the device has short ids, the
    /// ids must also be enough to number the points.
    fn most_shared(&self) -> usize {
        let carrier = &self.carrier;
        let capabilities = carrier.channel.capabilities();
        if capabilities.kept_words == usize::MAX && capabilities.pace.words_per_second.is_none() {
            return usize::MAX;
        }
        let most = ShortIds::MOST_IDS as usize;
        let form = ReadForm::of(most, capabilities, carrier.identity.features);
        // A point stands for two records.
        let [records, points] = [ShortIds::WHOLE as usize, ShortIds::WHOLE as usize / 2];
        let words = form.command::<()>(0..records).payload_words(carrier.channel.layout()).max(1);
        let kept = (capabilities.kept_words / usize::try_from(words).unwrap_or(usize::MAX)).saturating_mul(points);
        kept.min(if matches!(form, ReadForm::Short(_)) { most } else { usize::MAX })
    }

    /// The jobs that may share the memory, and the exclusive ones.
    fn divide(&mut self, plan: &Plan) -> (Vec<usize>, Vec<usize>) {
        let (mut small, mut exclusive) = (Vec::new(), Vec::new());
        for (job, points) in self.carrier.jobs.iter().enumerate() {
            if points.len() <= MAX_JOB_POINTS && plan.shares(points.len()) {
                small.push(job);
            } else {
                self.add_exclusive(plan, job, &mut exclusive);
            }
        }
        (small, exclusive)
    }

    /// Adds a job to the exclusive ones if it can be sent ahead, and leaves it to the caller if not.
    fn add_exclusive(&mut self, plan: &Plan, job: usize, exclusive: &mut Vec<usize>) {
        let points = self.carrier.jobs[job].len();
        if points <= MAX_EXCLUSIVE_POINTS && self.carrier.channel.capabilities().takes_ahead {
            exclusive.push(job);
        } else {
            self.left[job] = Some(plan.exclusive_contexts(points));
        }
    }

    /// Puts the small jobs in order and into groups, and adds those that are faster by themselves to the exclusive
    /// ones. Jobs that need no device are answered at once.
    fn group(&mut self, plan: &Plan, small: Vec<usize>, exclusive: &mut Vec<usize>) -> Result<Vec<Group>, JobError> {
        let mut shared = self.in_order(small)?;
        // A group takes as long as its longest job, so jobs of about one length belong together.
        shared.sort_by_key(|ordered| std::cmp::Reverse(ordered.vertices()));
        let lengths: Vec<usize> = shared.iter().map(Ordered::vertices).collect();
        let mut rest = shared.into_iter();
        let mut groups = Vec::new();
        for part in plan.divide(&lengths) {
            match part {
                Part::Group { jobs, contexts } => {
                    let dealt = rest.by_ref().take(jobs).map(|ordered| ordered.dealt(contexts));
                    groups.push(Group::sharing(dealt.collect(), contexts));
                }
                // The order at hand is for one context. The job is put in order again, for several, when its turn
                // comes.
                Part::Exclusive => {
                    if let Some(own) = rest.next() {
                        self.add_exclusive(plan, own.job, exclusive);
                    }
                }
            }
        }
        Ok(groups)
    }

    /// Puts these jobs in order, each for one context. Jobs that need no device are answered at once and left out.
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
            match self.carrier.answer_here(ordered, 1, &mut self.done) {
                Some(ordered) => shared.push(ordered),
                None => self.done.passed += points.len(),
            }
        }
        Ok(shared)
    }
}

/// The next load for the device, if there is one. The listener hears how far the batch is, and may cancel it here.
fn next_load(
    carrier: &Carrier<'_>,
    groups: &mut impl Iterator<Item = Group>,
    done: &mut Done,
) -> Result<Option<Load>, JobError> {
    for mut group in groups {
        tell(carrier.options, Stage::Insert, done.passed, carrier.points())?;
        done.passed += group.jobs.iter().map(|ordered| carrier.jobs[ordered.job].len()).sum::<usize>();
        if group.is_shared {
            let form = carrier.read_form(&group);
            return Ok(Some(Load::at_once(group, form, None)));
        }
        let own = group.only_job().filter(|_| !carrier.shares_limit);
        let time = own.map(|job| exclusive_time(carrier, job));
        let jobs = std::mem::take(&mut group.jobs);
        group.jobs = jobs.into_iter().filter_map(|ordered| carrier.answer_here(ordered, 1, done)).collect();
        if !group.jobs.is_empty() {
            let form = carrier.read_form(&group);
            return Ok(Some(Load::at_once(group, form, time)));
        }
    }
    Ok(None)
}

/// The time that an exclusive job may take.
fn exclusive_time(carrier: &Carrier<'_>, job: usize) -> Duration {
    let slow = carrier.channel.capabilities().pace.slow;
    let default = || Options::default_timeout(carrier.jobs[job].len()).saturating_mul(slow);
    carrier.options.timeout.unwrap_or_else(default)
}

/// Puts the exclusive jobs in order, each for its number of contexts, in a thread of their own, so that the host's work
/// is done while the device works. The thread ends when the iterator is dropped.
fn order_exclusive<'s>(
    scope: &'s Scope<'s, '_>,
    jobs: &'s [Vec<Point>],
    exclusive: Vec<(usize, u32)>,
    order: Order,
) -> impl Iterator<Item = Group> + use<'s> {
    // A channel without room: the thread holds one ordered job until it is wanted, which bounds the memory.
    let (sender, ordered) = sync_channel(0);
    let in_order = move |(job, contexts): (usize, u32)| {
        Group::alone(Ordered { job, prepared: prepare(&jobs[job], order, contexts) }, contexts)
    };
    let kept = exclusive.clone();
    let has_thread = !exclusive.is_empty()
        && Builder::new()
            .spawn_scoped(scope, move || exclusive.into_iter().try_for_each(|job| sender.send(in_order(job))))
            .is_ok();
    // If the system will not start a thread, the caller's thread does the work.
    let here = if has_thread { Vec::new() } else { kept };
    ordered.into_iter().chain(here.into_iter().map(in_order))
}
