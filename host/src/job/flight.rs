//! Carrying loads to a device: sending them, receiving and checking the answers, and trying once more after a passing
//! fault.
//!
//! If the transport takes commands ahead, the commands of the next load are sent before the answers to the current one
//! are received. A device of several engines gets loads for all of them. Their answers may come in any order, and are
//! taken in the order of the loads.

use std::collections::VecDeque;

use incircle_protocol::{Identity, InsertReport, Opcode, COUNTER_WORDS, INSERT_REPORT_WORDS, LATENCY_BUCKETS};

use super::answer::Answer;
use super::counters::{Counters, Latencies};
use super::group::{Group, Ordered};
use super::load::{Assembled, Load, Meshes, Step};
use super::options::{Options, Stage};
use super::read_form::ReadForm;
use super::report::Report;
use super::watch::{tell, Stopwatch};
use crate::commands::{Came, CommandChannel};
use crate::error::{DeviceFault, Error};
use crate::limit::Limit;
use incircle_geometry::Point;

/// Most loads under way for each engine of several: the engine works on one, while the answers to the load before it or
/// the commands of the load after it are on their way. One more load is under way, because the device holds a job until
/// some engine is free.
const MOST_SENT: usize = 2;
/// Most loads under way on any device: half of the tags.
const MOST_TAGGED: usize = 128;

/// An error, with the index of the job that it is about, if it is about one job.
#[derive(Debug)]
pub(crate) struct JobError {
    pub(crate) job: Option<usize>,
    pub(crate) error: Error,
}

impl From<Error> for JobError {
    fn from(error: Error) -> Self {
        Self { job: None, error }
    }
}

impl JobError {
    /// The error as the caller of a batch gets it.
    pub(crate) fn in_batch(self) -> Error {
        match self.job {
            Some(job) => Error::InJob { job, source: Box::new(self.error) },
            None => self.error,
        }
    }
}

/// The answers so far.
pub(crate) struct Done {
    /// Answers in the order of the caller, `None` for jobs that are not done.
    pub(crate) answers: Vec<Option<Answer>>,
    /// Points of the jobs that have been begun or answered. A listener hears this number, which is ahead by the points
    /// of the jobs under way.
    pub(crate) passed: usize,
}

impl Done {
    pub(crate) fn nothing_of(jobs: &[Vec<Point>]) -> Self {
        Self { answers: jobs.iter().map(|_| None).collect(), passed: 0 }
    }
}

/// The loads under way, in the order in which their answers are taken.
struct Flight {
    loads: VecDeque<Load>,
    /// Number of loads whose commands have been sent.
    sent: usize,
    /// Limit of the first load, if its time has begun.
    limit: Option<Limit>,
    /// Whether the first load is under way for the second time.
    is_second_try: bool,
    /// Clock of the device in which the last answer to the previous load ended.
    clock: Option<u64>,
}

/// The content of the answers to a load.
#[derive(Default)]
struct Answered {
    assembled: Vec<Assembled>,
    counters: Option<Counters>,
    latencies: Option<Latencies>,
    /// The engine that got stuck, so that the load must be sent once more.
    stuck: Option<u32>,
}

/// Carries jobs to a device and back.
pub(crate) struct Carrier<'c> {
    pub(crate) identity: Identity,
    pub(crate) channel: &'c mut CommandChannel,
    pub(crate) options: &'c Options<'c>,
    /// Limit for all loads that have no time of their own.
    pub(crate) limit: Limit,
    /// Whether no load has a time of its own.
    pub(crate) shares_limit: bool,
    /// Stopwatch for the stages of a job that goes step by step.
    pub(crate) watch: Stopwatch,
    pub(crate) jobs: &'c [Vec<Point>],
}

impl Carrier<'_> {
    /// Carries the loads that `next` gives, one after another. After an error of `next` no more are asked for, but the
    /// answers to what was sent are still received, so that the session stays in step.
    pub(crate) fn carry(
        &mut self,
        done: &mut Done,
        mut next: impl FnMut(&Self, &mut Done) -> Result<Option<Load>, JobError>,
    ) -> Result<(), JobError> {
        let clock = self.channel.clocks().map(|clocks| clocks.now);
        let mut flight = Flight { loads: VecDeque::new(), sent: 0, limit: None, is_second_try: false, clock };
        let most = self.most_sent();
        let mut stop = None;
        loop {
            let has_room = flight.loads.len() < most && stop.is_none();
            let next = if has_room { next(self, done) } else { Ok(None) };
            let next = next.unwrap_or_else(|error| {
                stop = Some(error);
                None
            });
            if next.is_none() && flight.loads.is_empty() {
                return stop.map_or(Ok(()), Err);
            }
            let went = match next {
                Some(load) => {
                    flight.loads.push_back(load);
                    self.send(&mut flight)
                }
                None => self.finish(&mut flight, done),
            };
            if let Err(error) = went {
                self.try_again(&mut flight, error)?;
            }
        }
    }

    /// The form in which the records of a group are read.
    pub(crate) fn read_form(&self, group: &Group) -> ReadForm {
        ReadForm::of(group.sent(), self.channel.capabilities(), self.identity.features)
    }

    /// Number of engines that work side by side: one, if the link takes one command at a time.
    pub(crate) fn engines_at_once(&self) -> usize {
        let goes_ahead = self.channel.capabilities().takes_ahead && self.channel.takes_any_order();
        if goes_ahead {
            self.identity.engines as usize
        } else {
            1
        }
    }

    /// Most loads under way at a time.
    fn most_sent(&self) -> usize {
        let capabilities = self.channel.capabilities();
        match (self.identity.engines, self.engines_at_once()) {
            (1, _) if capabilities.takes_ahead => capabilities.jobs_ahead.clamp(1, MOST_TAGGED),
            (_, 1) => 1,
            // A tag has a byte, and a load that was dropped keeps its tag until its last answer has come.
            (_, engines) => (MOST_SENT * engines + 1).min(MOST_TAGGED),
        }
    }

    /// Answers a job that needs no device, and gives back one that does. `contexts` is the number of contexts that
    /// would work on the job, for the report.
    pub(crate) fn answer_here(&self, ordered: Ordered, contexts: u32, done: &mut Done) -> Option<Ordered> {
        if !ordered.prepared.collinear {
            return Some(ordered);
        }
        let Ordered { job, prepared } = ordered;
        let (hull, duplicates) = (prepared.order, prepared.duplicates);
        done.answers[job] = Some(Answer { triangles: Vec::new(), hull, duplicates, report: self.report(contexts) });
        None
    }

    /// A report with what is known of a job before it is done.
    fn report(&self, contexts: u32) -> Report {
        Report {
            backend: self.channel.name(),
            order: self.options.order.name(),
            coord_bits: self.identity.coord_bits,
            capacity: self.identity.capacity,
            contexts,
            engines: self.identity.engines,
            stages: self.watch.stages.clone(),
            ..Report::default()
        }
    }

    /// Sends the loads that have not been sent. Where each command must be answered before the next, this only counts
    /// them as sent: [`receive`](Self::receive) sends each command when its turn comes.
    fn send(&mut self, flight: &mut Flight) -> Result<(), Error> {
        let limit = self.limit_of(flight);
        while let Some(load) = flight.loads.get_mut(flight.sent) {
            load.tag = self.channel.new_tag();
            let load = &*load;
            if self.goes_ahead(load) {
                self.submit(load, &load.steps, limit)?;
            }
            flight.sent += 1;
        }
        Ok(())
    }

    /// Whether all commands of this load are sent before the first of them is answered.
    fn goes_ahead(&self, load: &Load) -> bool {
        self.channel.capabilities().takes_ahead && !load.is_step_by_step
    }

    /// Submits the commands of these steps to the transport.
    fn submit(&mut self, load: &Load, steps: &[Step], limit: Limit) -> Result<(), Error> {
        let layout = self.channel.layout();
        let mut words = Vec::new();
        let commands = steps.iter().filter_map(|step| load.command(step, self.jobs, layout, &mut words));
        let commands: Vec<_> = commands.collect();
        let commands: Vec<_> = commands.into_iter().map(|command| command.map(|points| &words[points])).collect();
        self.channel.submit(load.tag, &commands, limit)
    }

    /// Receives the answers to the first load, makes its meshes and takes the load out of the flight.
    fn finish(&mut self, flight: &mut Flight, done: &mut Done) -> Result<(), Error> {
        self.send(flight)?;
        let limit = self.limit_of(flight);
        let Some(load) = flight.loads.front() else {
            return Ok(());
        };
        let Answered { assembled, counters, latencies, stuck } = self.receive(load, limit)?;
        if let Some(engine) = stuck {
            return self.send_elsewhere(flight, engine);
        }
        let clock = self.channel.clocks().and_then(|clocks| clocks.answer);
        let clocks = clock.zip(flight.clock).and_then(|(end, begin)| end.checked_sub(begin));
        let is_alone = !load.group.is_shared && !load.is_step_by_step && self.identity.engines == 1;
        let (clocks, stuck_engines) = (clocks.filter(|_| is_alone), load.stuck_engines.clone());
        let report = Report { counters, latencies, clocks, stuck_engines, ..self.report(load.group.contexts) };
        let jobs = flight.loads.pop_front().map_or_else(Vec::new, |load| load.group.jobs);
        for (Ordered { job, prepared }, (triangles, hull)) in jobs.into_iter().zip(assembled) {
            let (duplicates, report) = (prepared.duplicates, report.clone());
            done.answers[job] = Some(Answer { triangles, hull, duplicates, report });
        }
        (flight.sent, flight.limit, flight.is_second_try, flight.clock) = (flight.sent - 1, None, false, clock);
        Ok(())
    }

    /// Puts the first load, over which this engine got stuck, behind all others, to be sent once more. The device gives
    /// it to another engine. Fails if that has happened to the load as often as there are engines.
    fn send_elsewhere(&mut self, flight: &mut Flight, engine: u32) -> Result<(), Error> {
        // The load stays in front until it is certain that it goes again: an error names the job in front.
        let Some(load) = flight.loads.front_mut() else {
            return Ok(());
        };
        load.stuck_engines.push(engine);
        if load.stuck_engines.len() >= self.identity.engines as usize {
            let fault = DeviceFault::AllStuck { engines: self.identity.engines };
            return Err(self.channel.distrust(Opcode::Insert, fault));
        }
        self.watch.again();
        flight.loads.rotate_left(1);
        flight.sent -= 1;
        (flight.limit, flight.is_second_try) = (None, false);
        Ok(())
    }

    /// Receives and checks the answers to a load, up to one that says that the engine is stuck.
    fn receive(&mut self, load: &Load, limit: Limit) -> Result<Answered, Error> {
        let layout = self.channel.layout();
        let mut meshes = Meshes::new(&load.group, self.jobs, self.identity.capacity, load.form, layout);
        let (mut answered, mut words) = (Answered::default(), Vec::new());
        for step in &load.steps {
            self.tell_before(load, step)?;
            let Some(command) = load.bare_command(step) else {
                continue;
            };
            if !self.goes_ahead(load) {
                self.submit(load, std::slice::from_ref(step), limit)?;
            }
            if let Came::Stuck(engine) = self.channel.receive(load.tag, &command, &mut words, limit)? {
                return Ok(Answered { stuck: Some(engine), ..answered });
            }
            let checked = match step {
                Step::Insert(points) => check_insert(load, &words, points.end),
                Step::Read(records) => meshes.take(records, &words),
                Step::Counters => {
                    answered.counters = Some(Counters::from_words(&first_of::<COUNTER_WORDS>(&words)));
                    Ok(())
                }
                Step::Latencies => {
                    let buckets = first_of::<LATENCY_BUCKETS>(&words);
                    answered.latencies = answered.counters.and_then(|counters| Latencies::of(&counters, &buckets));
                    Ok(())
                }
                Step::Clear | Step::Ended(_) => Ok(()),
            };
            checked.map_err(|fault| self.channel.distrust(command.opcode(), fault))?;
        }
        self.assemble(load, meshes, answered)
    }

    /// Makes the meshes when all records are there.
    fn assemble(&mut self, load: &Load, meshes: Meshes<'_>, answered: Answered) -> Result<Answered, Error> {
        if load.is_step_by_step {
            tell(self.options, Stage::Assemble, 0, self.points())?;
        }
        let assembled = meshes.finish().map_err(|fault| self.channel.distrust(load.form.opcode(), fault))?;
        if load.is_step_by_step {
            self.watch.ended(Stage::Assemble);
        }
        Ok(Answered { assembled, ..answered })
    }

    /// Tells the listener how far a load is, before this step, if the load goes step by step.
    fn tell_before(&mut self, load: &Load, step: &Step) -> Result<(), Error> {
        if !load.is_step_by_step {
            return Ok(());
        }
        let (points, records) = (load.group.sent(), load.group.records());
        let (stage, done, total) = match step {
            Step::Insert(range) => (Stage::Insert, range.start, points),
            Step::Read(range) => (Stage::Read, range.start, records),
            Step::Ended(Stage::Insert) => (Stage::Insert, points, points),
            Step::Ended(stage) => (*stage, records, records),
            Step::Clear | Step::Counters | Step::Latencies => return Ok(()),
        };
        tell(self.options, stage, done, total)?;
        if let Step::Ended(stage) = step {
            self.watch.ended(*stage);
        }
        Ok(())
    }

    /// Number of points of all jobs, duplicates included.
    pub(crate) fn points(&self) -> usize {
        self.jobs.iter().map(Vec::len).sum()
    }

    /// Recovers from an error. If the device is as after its reset, everything under way will be sent once more. The
    /// error stands if the device is not, or if this was the second try of the first load.
    fn try_again(&mut self, flight: &mut Flight, error: Error) -> Result<(), JobError> {
        let job = flight.loads.front().and_then(|load| load.group.only_job());
        let in_job = |error| JobError { job, error };
        let limit = self.limit_of(flight);
        if flight.is_second_try || !self.channel.recover(&error, limit).map_err(in_job)? {
            return Err(in_job(error));
        }
        self.watch.again();
        (flight.sent, flight.is_second_try) = (0, true);
        Ok(())
    }

    /// Limit of the first load. A load with a time of its own has that time from the end of the previous load on; all
    /// others share one limit. The time of a load that is sent ahead is added, since the host cannot tell which of the
    /// two the device is working on.
    fn limit_of(&self, flight: &mut Flight) -> Limit {
        let mut loads = flight.loads.iter();
        let head = loads.next().and_then(|load| load.time);
        let own = *flight.limit.get_or_insert_with(|| head.map_or(self.limit, Limit::of));
        loads.filter_map(|load| load.time).fold(own, Limit::longer)
    }
}

/// Checks the answer to an `Insert`: all points sent so far must be in.
fn check_insert(load: &Load, words: &[u32], sent: usize) -> Result<(), DeviceFault> {
    load.group.check_report(&InsertReport::from_words(first_of::<INSERT_REPORT_WORDS>(words)), sent)
}

/// The first words of a payload, whose length has been checked.
fn first_of<const N: usize>(words: &[u32]) -> [u32; N] {
    std::array::from_fn(|place| words.get(place).copied().unwrap_or(0))
}
