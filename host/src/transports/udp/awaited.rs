//! The answers that are still to come, and which question each of them belongs to.
//!
//! An answer has a number, and the header in it has the tag of its job. The answers to one job come in the order of its
//! questions. A device of one engine answers all jobs in one order, so there the number alone tells the question. A
//! device of several engines answers jobs side by side, so there the tag tells the job.
//!
//! The tag of a lost answer is not known. A job goes to an engine that owes no answer, so the lost answer belongs to
//! one of the first unfinished jobs, as many as there are engines. If there is more than one, all of them begin again.

use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

use incircle_protocol::{answer_engine, answer_tag};

use super::fault::UdpFault;

/// Number of datagrams behind the one that overtook an answer after which the answer counts as lost, on a device of one
/// engine.
const OVERTAKEN: u32 = 3;

/// A question whose answer is awaited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Asked {
    pub unit: u64,
    pub run: u32,
    pub question: usize,
    /// Words of the answer, header and length included.
    pub words: usize,
}

/// The fate of one answer of the device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    /// The answer to this question came.
    Came(Asked, Vec<u32>),
    /// The answer to this question is lost.
    Lost(Asked),
    /// An answer to one of these runs of units is lost. The host cannot tell which.
    LostOfOne(Vec<(u64, u32)>),
}

/// The place of an answer, by its number.
#[derive(Debug)]
struct Slot {
    /// Bytes of the session up to the end of the question with this number. The device cannot have given an answer with
    /// this number before it took these.
    end: u64,
    words: Option<Vec<u32>>,
    /// Time at which a later answer was first seen, or heard of, and number of datagrams since.
    passed_at: Option<Duration>,
    passed_by: u32,
    is_lost: bool,
}

/// The questions of a job that are not answered.
#[derive(Debug, Default)]
struct OfJob {
    asked: VecDeque<Asked>,
    /// The engine that has answered.
    engine: Option<u8>,
    /// Number of jobs before this one.
    place: u64,
    /// An answer may be lost, so the device may owe one answer less than there are questions here, or more.
    is_unsure: bool,
}

/// The answers that are still to come in a session.
#[derive(Debug, Default)]
pub(super) struct Awaited {
    /// Number of engines of the device.
    engines: usize,
    /// The answers from number `first` on.
    slots: VecDeque<Slot>,
    first: u64,
    /// Number up to which the device has sent answers.
    horizon: u64,
    /// The questions without an answer, by the tag of their job; all under tag 0 if there is one engine.
    jobs: BTreeMap<u8, OfJob>,
    /// The tag that was given last.
    last_tag: u8,
    /// Number of jobs so far.
    begun: u64,
    words: usize,
}

impl Awaited {
    /// No answers, at the beginning of a session.
    pub fn new(engines: u32) -> Self {
        Self { engines: engines as usize, ..Self::default() }
    }

    fn has_tags(&self) -> bool {
        self.engines > 1
    }

    /// Number of words of the answers to come.
    pub fn words(&self) -> usize {
        self.words
    }

    /// Number of questions of the session so far, and so of its answers.
    pub fn asked(&self) -> u64 {
        self.first + self.slots.len() as u64
    }

    /// Whether the fate of all answers is known.
    pub fn is_settled(&self) -> bool {
        self.slots.is_empty()
    }

    /// The tag for the next job on a device of several engines, which no answer to come has; `None` on a device of one.
    pub fn new_tag(&mut self) -> Option<u8> {
        for _ in 0..=u8::MAX {
            self.last_tag = self.last_tag.wrapping_add(1);
            if self.last_tag != 0 && !self.jobs.contains_key(&self.last_tag) {
                break;
            }
        }
        self.has_tags().then_some(self.last_tag)
    }

    /// Notes a question of the job with this tag, whose last word is that with byte `end` of the session.
    pub fn ask(&mut self, tag: u8, asked: Asked, end: u64) {
        let tag = if self.has_tags() { tag } else { 0 };
        let job = self.jobs.entry(tag).or_insert_with(|| {
            self.begun += 1;
            OfJob { place: self.begun, ..OfJob::default() }
        });
        job.asked.push_back(asked);
        self.slots.push_back(Slot { end, words: None, passed_at: None, passed_by: 0, is_lost: false });
        self.words += asked.words;
    }

    /// Takes the words of the answer with this number. Returns true if it was awaited. `taken_bytes` are the bytes of
    /// the session that the device has taken.
    ///
    /// # Errors
    /// There cannot be an answer with this number.
    pub fn take(&mut self, number: u32, words: &[u32], taken_bytes: u64) -> Result<bool, UdpFault> {
        let number = u64::from(number);
        let Some(place) = number.checked_sub(self.first) else { return Ok(false) };
        let slot = usize::try_from(place).ok().and_then(|place| self.slots.get_mut(place));
        let slot = slot.filter(|slot| slot.end <= taken_bytes).ok_or(UdpFault::Unasked { number })?;
        if slot.is_lost || slot.words.is_some() {
            return Ok(false);
        }
        slot.words = Some(words.to_vec());
        self.horizon = self.horizon.max(number + 1);
        Ok(true)
    }

    /// Hears that the device has sent `answers` answers to their end.
    ///
    /// # Errors
    /// The device cannot have sent this many answers.
    pub fn passed(&mut self, answers: u32, taken_bytes: u64) -> Result<(), UdpFault> {
        let answers = u64::from(answers);
        let last = answers.checked_sub(self.first + 1).and_then(|last| usize::try_from(last).ok());
        let Some(last) = last else { return Ok(()) };
        if self.slots.get(last).is_none_or(|slot| slot.end > taken_bytes) {
            return Err(UdpFault::Unasked { number: answers - 1 });
        }
        self.horizon = self.horizon.max(answers);
        Ok(())
    }

    /// Counts a datagram of the session, or only looks at the time, and finds the answers that are lost.
    pub fn count(&mut self, now: Duration, grace: Duration, is_datagram: bool) {
        let passed = usize::try_from(self.horizon.saturating_sub(self.first)).unwrap_or(usize::MAX);
        // With several engines a loss costs more than to wait for a late answer, so there only the time counts.
        let overtaken = if self.has_tags() { u32::MAX } else { OVERTAKEN };
        for slot in self.slots.iter_mut().take(passed).filter(|slot| slot.words.is_none()) {
            let passed_at = *slot.passed_at.get_or_insert(now);
            slot.passed_by += u32::from(is_datagram);
            slot.is_lost |= slot.passed_by > overtaken || now >= passed_at + grace;
        }
    }

    /// Time at which the next answer counts as lost.
    pub fn lost_at(&self, grace: Duration) -> Option<Duration> {
        self.slots.front()?.passed_at.map(|passed_at| passed_at + grace)
    }

    /// The fate of the next answer in the order of numbers, once it is known.
    ///
    /// # Errors
    /// The answer belongs to no question.
    pub fn next(&mut self) -> Result<Option<Outcome>, UdpFault> {
        let Some(slot) = self.slots.pop_front_if(|slot| slot.is_lost || slot.words.is_some()) else {
            return Ok(None);
        };
        let number = self.first;
        self.first += 1;
        let outcome = match slot.words {
            Some(words) => {
                let asked = self.question_of(&words).ok_or(UdpFault::Unasked { number })?;
                Outcome::Came(asked, words)
            }
            None => self.lose(),
        };
        if self.slots.is_empty() {
            // The device owes nothing, so what is left stands for answers that were lost.
            self.jobs.clear();
            self.words = 0;
        }
        Ok(Some(outcome))
    }

    /// Takes the question that the answer with these words belongs to.
    fn question_of(&mut self, words: &[u32]) -> Option<Asked> {
        let header = words.first().copied()?;
        let (tag, engine) = if self.has_tags() { (answer_tag(header), answer_engine(header)) } else { (0, 0) };
        let job = self.jobs.get_mut(&tag)?;
        let asked = job.asked.pop_front()?;
        self.words -= asked.words;
        if job.engine.replace(engine).is_none() {
            self.end_others(tag, engine);
        }
        self.forget_if_answered(tag);
        Some(asked)
    }

    /// An engine gets a job when it owes no answer, so its first answer to this job ends all others that it had.
    fn end_others(&mut self, tag: u8, engine: u8) {
        let words = &mut self.words;
        self.jobs.retain(|&other, job| {
            let is_over = other != tag && job.engine == Some(engine);
            *words -= if is_over { job.asked.iter().map(|asked| asked.words).sum() } else { 0 };
            !is_over
        });
    }

    /// The loss of an answer whose tag is not known.
    fn lose(&mut self) -> Outcome {
        let mut jobs: Vec<_> = self.jobs.iter_mut().collect();
        jobs.sort_by_key(|(_, job)| job.place);
        // A job that is unsure may have ended, so it does not keep an engine from the jobs behind it.
        let mut unfinished = 0;
        let may_be_of = |(_, job): &&mut (&u8, &mut OfJob)| {
            let is_begun = unfinished < self.engines.max(1);
            unfinished += usize::from(!job.is_unsure);
            is_begun
        };
        let count = jobs.iter_mut().take_while(may_be_of).count();
        jobs.truncate(count);
        if let [(tag, job)] = &mut jobs[..] {
            if let Some(asked) = job.asked.pop_front() {
                let tag = **tag;
                self.words -= asked.words;
                self.forget_if_answered(tag);
                return Outcome::Lost(asked);
            }
        }
        let mut runs = Vec::new();
        for (_, job) in jobs {
            job.is_unsure = true;
            runs.extend(job.asked.iter().map(|asked| (asked.unit, asked.run)));
        }
        runs.dedup();
        Outcome::LostOfOne(runs)
    }

    fn forget_if_answered(&mut self, tag: u8) {
        if self.jobs.get(&tag).is_some_and(|job| job.asked.is_empty()) {
            self.jobs.remove(&tag);
        }
    }
}

#[cfg(test)]
mod tests;
