//! Loads on their way: sent, answered, checked, and sent once more if a fault passes. The commands of the next load are
//! sent before the answers of the last are received, where the way to the device takes them.

use std::collections::VecDeque;

use incircle_protocol::{Identity, InsertReport, Opcode, COUNTER_WORDS, INSERT_REPORT_WORDS, LATENCY_BUCKETS};

use super::answer::Answer;
use super::counters::{Counters, Latencies};
use super::group::Ordered;
use super::load::{Assembled, Load, Meshes, Step};
use super::options::{Options, Stage};
use super::report::Report;
use super::watch::{tell, Stopwatch};
use crate::commands::CommandChannel;
use crate::error::{DeviceFault, Error};
use crate::limit::Limit;
use incircle_geometry::Point;

/// Loads that are under way at most, where commands may be sent ahead: one in the device, one behind it.
const MOST_SENT: usize = 2;

/// An error, and the job of a list that it is about, if it is about one.
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
    /// As the caller of a batch is told it.
    pub(crate) fn in_batch(self) -> Error {
        match self.job {
            Some(job) => Error::InJob { job, source: Box::new(self.error) },
            None => self.error,
        }
    }
}

/// What has become of jobs, in the order of the caller.
pub(crate) struct Done {
    pub(crate) answers: Vec<Option<Answer>>,
    /// Points of the jobs that have been begun or answered: what a listener hears is ahead by the jobs under way at
    /// most.
    pub(crate) passed: usize,
}

impl Done {
    pub(crate) fn nothing_of(jobs: &[Vec<Point>]) -> Self {
        Self { answers: jobs.iter().map(|_| None).collect(), passed: 0 }
    }
}

/// Loads under way, in their order: the first is answered first.
struct Flight {
    loads: VecDeque<Load>,
    /// How many of them the link has.
    sent: usize,
    /// Until when the first may take.
    limit: Option<Limit>,
    /// The first is under way for the second time.
    is_second_try: bool,
    /// Clock of the device in which the last answer of the load before ended.
    clock: Option<u64>,
}

/// What the device answered to a load.
#[derive(Default)]
struct Answered {
    assembled: Vec<Assembled>,
    counters: Option<Counters>,
    latencies: Option<Latencies>,
}

/// Jobs that a device does.
pub(crate) struct Carrier<'c> {
    pub(crate) identity: Identity,
    pub(crate) channel: &'c mut CommandChannel,
    pub(crate) options: &'c Options<'c>,
    /// For all loads that have no time of their own.
    pub(crate) limit: Limit,
    /// Times the stages of a job that goes step by step.
    pub(crate) watch: Stopwatch,
    pub(crate) jobs: &'c [Vec<Point>],
}

impl Carrier<'_> {
    /// Does the loads that `next` gives, one behind the other. An error of `next` ends them when all that was sent is
    /// answered: the session stays in step.
    pub(crate) fn carry(
        &mut self,
        done: &mut Done,
        mut next: impl FnMut(&Self, &mut Done) -> Result<Option<Load>, JobError>,
    ) -> Result<(), JobError> {
        let clock = self.channel.clocks().map(|clocks| clocks.now);
        let mut flight = Flight { loads: VecDeque::new(), sent: 0, limit: None, is_second_try: false, clock };
        let most = if self.channel.capabilities().takes_ahead { MOST_SENT } else { 1 };
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

    /// Answers a job that needs no device, for which so many contexts would work; gives back one that does. An error if
    /// the device cannot hold it.
    pub(crate) fn answer_here(
        &self,
        ordered: Ordered,
        contexts: u32,
        done: &mut Done,
    ) -> Result<Option<Ordered>, JobError> {
        let (distinct, capacity) = (ordered.vertices(), self.identity.capacity);
        if distinct > capacity as usize {
            let error = Error::Capacity { distinct, capacity, device: self.channel.name() };
            return Err(JobError { job: Some(ordered.job), error });
        }
        if !ordered.prepared.collinear {
            return Ok(Some(ordered));
        }
        let Ordered { job, prepared } = ordered;
        let (hull, duplicates) = (prepared.order, prepared.duplicates);
        done.answers[job] = Some(Answer { triangles: Vec::new(), hull, duplicates, report: self.report(contexts) });
        Ok(None)
    }

    /// What is known of a job before it is done.
    fn report(&self, contexts: u32) -> Report {
        Report {
            backend: self.channel.name(),
            order: self.options.order.name(),
            coord_bits: self.identity.coord_bits,
            capacity: self.identity.capacity,
            contexts,
            stages: self.watch.stages.clone(),
            ..Report::default()
        }
    }

    /// Sends what the link does not have yet. Where each command must be answered before the next, that is done with
    /// the answers.
    fn send(&mut self, flight: &mut Flight) -> Result<(), Error> {
        let limit = self.limit_of(flight);
        while let Some(load) = flight.loads.get(flight.sent) {
            if self.goes_ahead(load) {
                self.submit(load, &load.steps, limit)?;
            }
            flight.sent += 1;
        }
        Ok(())
    }

    /// All commands of this load are sent before the first of them is answered.
    fn goes_ahead(&self, load: &Load) -> bool {
        self.channel.capabilities().takes_ahead && !load.is_step_by_step
    }

    /// Submits the commands of these steps.
    fn submit(&mut self, load: &Load, steps: &[Step], limit: Limit) -> Result<(), Error> {
        let (capabilities, layout) = (self.channel.capabilities(), self.channel.layout());
        let mut words = Vec::new();
        let commands = steps.iter().filter_map(|step| load.command(step, self.jobs, capabilities, layout, &mut words));
        let commands: Vec<_> = commands.collect();
        let commands: Vec<_> = commands.into_iter().map(|command| command.map(|points| &words[points])).collect();
        self.channel.submit(&commands, limit)
    }

    /// Receives the answers to the first load and makes its meshes.
    fn finish(&mut self, flight: &mut Flight, done: &mut Done) -> Result<(), Error> {
        self.send(flight)?;
        let limit = self.limit_of(flight);
        let Some(load) = flight.loads.front() else {
            return Ok(());
        };
        let Answered { assembled, counters, latencies } = self.receive(load, limit)?;
        let clock = self.channel.clocks().and_then(|clocks| clocks.answer);
        let clocks = clock.zip(flight.clock).and_then(|(end, begin)| end.checked_sub(begin));
        let clocks = clocks.filter(|_| !load.group.is_shared && !load.is_step_by_step);
        let report = Report { counters, latencies, clocks, ..self.report(load.group.contexts) };
        let jobs = flight.loads.pop_front().map_or_else(Vec::new, |load| load.group.jobs);
        for (Ordered { job, prepared }, (triangles, hull)) in jobs.into_iter().zip(assembled) {
            let (duplicates, report) = (prepared.duplicates, report.clone());
            done.answers[job] = Some(Answer { triangles, hull, duplicates, report });
        }
        (flight.sent, flight.limit, flight.is_second_try, flight.clock) = (flight.sent - 1, None, false, clock);
        Ok(())
    }

    /// The checked answers to a load.
    fn receive(&mut self, load: &Load, limit: Limit) -> Result<Answered, Error> {
        let (capabilities, layout) = (self.channel.capabilities(), self.channel.layout());
        let mut meshes = Meshes::new(&load.group, self.jobs, self.identity.capacity, capabilities, layout);
        let (mut answered, mut words) = (Answered::default(), Vec::new());
        for step in &load.steps {
            self.tell_before(load, step)?;
            let Some(command) = load.bare_command(step, capabilities) else {
                continue;
            };
            if !self.goes_ahead(load) {
                self.submit(load, std::slice::from_ref(step), limit)?;
            }
            self.channel.receive(&command, &mut words, limit)?;
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

    /// Puts the meshes together when all records are there.
    fn assemble(&mut self, load: &Load, meshes: Meshes<'_>, answered: Answered) -> Result<Answered, Error> {
        if load.is_step_by_step {
            tell(self.options, Stage::Assemble, 0, self.points())?;
        }
        let read_out = if self.channel.capabilities().packs_records { Opcode::Triangles } else { Opcode::Read };
        let assembled = meshes.finish().map_err(|fault| self.channel.distrust(read_out, fault))?;
        if load.is_step_by_step {
            self.watch.ended(Stage::Assemble);
        }
        Ok(Answered { assembled, ..answered })
    }

    /// Tells how far a load is that goes step by step.
    fn tell_before(&mut self, load: &Load, step: &Step) -> Result<(), Error> {
        if !load.is_step_by_step {
            return Ok(());
        }
        let (points, records) = (load.group.sent(), load.group.records());
        let (stage, done, total) = match step {
            Step::Insert(stretch) => (Stage::Insert, stretch.start, points),
            Step::Read(stretch) => (Stage::Read, stretch.start, records),
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

    /// Points of all jobs.
    pub(crate) fn points(&self) -> usize {
        self.jobs.iter().map(Vec::len).sum()
    }

    /// After an error: if the device is back as after its reset, all that was under way is sent once more, but a load
    /// only once.
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

    /// Until when the first load may take: one that has a time of its own has it from the end of the one before on, all
    /// others have theirs together. While such a load is sent ahead its time is added, since nobody can tell which of
    /// the two is at work.
    fn limit_of(&self, flight: &mut Flight) -> Limit {
        let mut loads = flight.loads.iter();
        let head = loads.next().and_then(|load| load.time);
        let own = *flight.limit.get_or_insert_with(|| head.map_or(self.limit, Limit::of));
        loads.filter_map(|load| load.time).fold(own, Limit::longer)
    }
}

/// All points sent so far must be in.
fn check_insert(load: &Load, words: &[u32], sent: usize) -> Result<(), DeviceFault> {
    load.group.check_report(&InsertReport::from_words(first_of::<INSERT_REPORT_WORDS>(words)), sent)
}

/// The first words of a payload, whose length has been checked.
fn first_of<const N: usize>(words: &[u32]) -> [u32; N] {
    std::array::from_fn(|place| words.get(place).copied().unwrap_or(0))
}
