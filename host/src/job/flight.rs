//! Groups on their way: the words of the next are sent before the answers of the last are received.

use std::collections::VecDeque;
use std::time::Duration;

use incircle_protocol::{InsertReport, Opcode, COUNTER_WORDS};

use super::commands::{Command, Load};
use super::group::{Group, Ordered};
use super::{points_of, Batch, Done};
use crate::counters::Counters;
use crate::error::Error;
use crate::limit::Limit;
use crate::options::{Options, Stage};
use crate::session::tell;

/// Groups that are under way at most, where words may be sent ahead: one in the device, one behind it.
const MOST_SENT: usize = 2;

/// Groups under way, in their order: the first is answered first.
struct Flight {
    loads: VecDeque<Load>,
    /// How many of them the link has.
    sent: usize,
    /// Until when the first may take.
    limit: Option<Limit>,
    /// The first is under way for the second time.
    is_second_try: bool,
    /// Clock of the device in which the last answer of the group before ended.
    clock: Option<u64>,
}

/// What the device answered to a group.
struct Answered {
    counters: Option<Counters>,
    /// Words of the records, or of their vertices.
    records: Vec<u32>,
}

impl Batch<'_> {
    /// Does these groups, one behind the other. A listener that ends the batch, and a frame that does not fit, end it when all that was
    /// sent is answered: the session stays in step.
    pub(super) fn carry(&mut self, mut groups: impl Iterator<Item = Group>, done: &mut Done) -> Result<(), Error> {
        let clock = self.link.clocks();
        let mut flight = Flight { loads: VecDeque::new(), sent: 0, limit: None, is_second_try: false, clock };
        let most = if self.link.takes_ahead() { MOST_SENT } else { 1 };
        let mut stop = None;
        loop {
            let has_room = flight.loads.len() < most && stop.is_none();
            let next = if has_room { self.next(&mut groups, done) } else { Ok(None) };
            let next = next.unwrap_or_else(|error| {
                stop = Some(error);
                None
            });
            if next.is_none() && flight.loads.is_empty() {
                return stop.map_or(Ok(()), Err);
            }
            let went = match next {
                Some(group) => {
                    flight.loads.push_back(self.load(group));
                    self.send(&mut flight)
                }
                None => self.finish(&mut flight, done),
            };
            if let Err(error) = went {
                self.try_again(&mut flight, error)?;
            }
        }
    }

    /// The next group that the device must do.
    fn next(&self, groups: &mut impl Iterator<Item = Group>, done: &mut Done) -> Result<Option<Group>, Error> {
        for mut group in groups {
            tell(self.options, Stage::Insert, done.passed, points_of(self.jobs))?;
            done.passed += group.jobs.iter().map(|ordered| self.jobs[ordered.job].len()).sum::<usize>();
            if group.is_frame {
                let rest: Result<Vec<_>, _> =
                    group.jobs.into_iter().map(|frame| self.answer_here(frame, done)).collect();
                group.jobs = rest?.into_iter().flatten().collect();
            }
            if !group.jobs.is_empty() {
                return Ok(Some(group));
            }
        }
        Ok(None)
    }

    /// Sends what the link does not have yet. Where each command must be answered before the next, that is done with the answers.
    fn send(&mut self, flight: &mut Flight) -> Result<(), Error> {
        let limit = self.limit_of(flight);
        while let Some(load) = flight.loads.get(flight.sent) {
            if self.link.takes_ahead() {
                let words = load.commands.iter().map(|command| &command.words[..]).collect::<Vec<_>>().concat();
                self.link.send_ahead(Opcode::Insert, &words, limit)?;
            }
            flight.sent += 1;
        }
        Ok(())
    }

    /// Receives the answers to the first group and makes its meshes.
    fn finish(&mut self, flight: &mut Flight, done: &mut Done) -> Result<(), Error> {
        self.send(flight)?;
        let limit = self.limit_of(flight);
        let Some(load) = flight.loads.front() else {
            return Ok(());
        };
        let Answered { counters, records } = self.receive(load, limit)?;
        let assembled = self.assemble(load, &records);
        let opcode = if self.link.packs_records() { Opcode::Triangles } else { Opcode::Read };
        let assembled = assembled.map_err(|fault| self.link.distrust(opcode, fault))?;
        let clock = self.link.answer_clock();
        let clocks =
            clock.zip(flight.clock).and_then(|(end, begin)| end.checked_sub(begin)).filter(|_| load.group.is_frame);
        let contexts = load.group.contexts;
        let jobs = flight.loads.pop_front().map_or_else(Vec::new, |load| load.group.jobs);
        for (Ordered { job, prepared }, (triangles, hull)) in jobs.into_iter().zip(assembled) {
            let mut mesh = self.mesh(job, triangles, hull, prepared);
            (mesh.report.counters, mesh.report.clocks, mesh.report.contexts) = (counters, clocks, contexts);
            done.meshes[job] = Some(mesh);
        }
        (flight.sent, flight.limit, flight.is_second_try, flight.clock) = (flight.sent - 1, None, false, clock);
        Ok(())
    }

    /// The checked answers to a group.
    fn receive(&mut self, load: &Load, limit: Limit) -> Result<Answered, Error> {
        let mut answered = Answered { counters: None, records: Vec::new() };
        let is_sent = self.link.takes_ahead();
        for Command { opcode, words, payload } in &load.commands {
            if !is_sent {
                self.link.send_ahead(*opcode, words, limit)?;
            }
            let mut answer = vec![0; *payload];
            self.link.receive_answer(*opcode, &mut answer, limit)?;
            match opcode {
                Opcode::Insert => self.check_insert(load, &answer)?,
                Opcode::Counters => {
                    answered.counters = <&[u32; COUNTER_WORDS]>::try_from(&answer[..]).ok().map(Counters::from_words);
                }
                Opcode::Read | Opcode::Triangles => answered.records = answer,
                _ => {}
            }
        }
        Ok(answered)
    }

    fn check_insert(&mut self, load: &Load, answer: &[u32]) -> Result<(), Error> {
        let words = std::array::from_fn(|place| answer.get(place).copied().unwrap_or(0));
        let checked = load.group.check_report(&InsertReport::from_words(words), load.points);
        checked.map_err(|fault| self.link.distrust(Opcode::Insert, fault))
    }

    /// After an error: if the device is back as after its reset, all that was under way is sent once more, but a group only once.
    fn try_again(&mut self, flight: &mut Flight, error: Error) -> Result<(), Error> {
        let job = flight.loads.front().and_then(|load| load.group.only_job());
        let in_job = |error| match job {
            Some(job) => Error::InJob { job, source: Box::new(error) },
            None => error,
        };
        let limit = self.limit_of(flight);
        if flight.is_second_try || !self.link.recover(&error, limit).map_err(in_job)? {
            return Err(in_job(error));
        }
        (flight.sent, flight.is_second_try) = (0, true);
        Ok(())
    }

    /// Until when the first group may take: a frame has its own time from the end of the one before it on, groups that share the memory have
    /// theirs together. While a frame is sent ahead its time is added, since nobody can tell which of the two is at work.
    fn limit_of(&self, flight: &mut Flight) -> Limit {
        let mut loads = flight.loads.iter();
        let head = loads.next().and_then(|load| self.time_of(&load.group));
        let own = *flight.limit.get_or_insert_with(|| head.map_or(self.limit, Limit::of));
        loads.filter_map(|load| self.time_of(&load.group)).fold(own, Limit::longer)
    }

    /// The time that a frame may take.
    fn time_of(&self, group: &Group) -> Option<Duration> {
        let points = self.jobs[group.only_job().filter(|_| group.is_frame)?].len();
        let default = || Options::default_timeout(points).saturating_mul(self.link.pace().slow);
        Some(self.options.timeout.unwrap_or_else(default))
    }
}
