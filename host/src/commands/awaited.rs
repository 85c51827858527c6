//! The answers that are still to come from a device of several engines.
//!
//! Answers of one job come in the order of its commands. Those of different jobs come in any order, and the tag in
//! their headers says to which job they belong. An answer that comes before its turn is kept.

use std::collections::{BTreeMap, VecDeque};

use incircle_protocol::{answer_engine, answer_opcode, answer_status, answer_tag, Opcode, Status, INSERT_REPORT_WORDS};

use crate::transports::AnswerHead;

/// An answer: its beginning and its payload.
pub(super) type Answer = (AnswerHead, Vec<u32>);

/// The answers to the commands of one job.
#[derive(Default)]
struct OfJob {
    /// The commands whose answers have not come: their opcodes, and the words of the payloads.
    commands: VecDeque<(Opcode, u32)>,
    /// Answers that have come and were not taken.
    early: VecDeque<Answer>,
    /// Nobody wants the answers any more.
    is_dropped: bool,
}

/// The answers that are still to come, by the tag of their job.
#[derive(Default)]
pub(super) struct Awaited {
    jobs: BTreeMap<u8, OfJob>,
    /// The tag that was given last.
    last: u8,
}

impl Awaited {
    /// A tag that no answer to come has, and not 0, which is the tag of a device that was reset.
    pub(super) fn new_tag(&mut self) -> u8 {
        for _ in 0..=u8::MAX {
            self.last = self.last.wrapping_add(1);
            if self.last != 0 && !self.jobs.contains_key(&self.last) {
                break;
            }
        }
        self.last
    }

    /// Notes a command of the job with this tag, whose answer will have a payload of `words` words.
    pub(super) fn add(&mut self, tag: u8, opcode: Opcode, words: u32) {
        self.jobs.entry(tag).or_default().commands.push_back((opcode, words));
    }

    /// Number of words of the payload of an answer that begins so; `None` if the next command of its job has no such
    /// answer, or if the device, which has `engines` engines, has none of this number.
    pub(super) fn words_of(&self, [header, length]: AnswerHead, engines: u32) -> Option<usize> {
        let (opcode, words) = *self.jobs.get(&answer_tag(header))?.commands.front()?;
        if answer_opcode(header) != opcode as u8 || u32::from(answer_engine(header)) >= engines {
            return None;
        }
        let is_right = match Status::from_u8(answer_status(header))? {
            Status::Ok => length == words,
            _ if opcode == Opcode::Insert => length as usize == INSERT_REPORT_WORDS,
            _ => length == 0,
        };
        is_right.then_some(length as usize)
    }

    /// Keeps an answer for which [`words_of`](Self::words_of) has a number.
    pub(super) fn keep(&mut self, head: AnswerHead, payload: Vec<u32>) {
        let tag = answer_tag(head[0]);
        let Some(job) = self.jobs.get_mut(&tag) else {
            return;
        };
        job.commands.pop_front();
        if !job.is_dropped {
            job.early.push_back((head, payload));
        }
        self.forget_if_done(tag);
    }

    /// Takes the next answer to the job with this tag, if it has come.
    pub(super) fn take(&mut self, tag: u8) -> Option<Answer> {
        let answer = self.jobs.get_mut(&tag)?.early.pop_front();
        self.forget_if_done(tag);
        answer
    }

    /// Drops all answers to the job with this tag, those to come included.
    pub(super) fn drop_rest(&mut self, tag: u8) {
        if let Some(job) = self.jobs.get_mut(&tag) {
            job.early.clear();
            job.is_dropped = true;
        }
        self.forget_if_done(tag);
    }

    /// Expects no more answers, as after a reset of the device.
    pub(super) fn clear(&mut self) {
        self.jobs.clear();
    }

    fn forget_if_done(&mut self, tag: u8) {
        if self.jobs.get(&tag).is_some_and(|job| job.commands.is_empty() && job.early.is_empty()) {
            self.jobs.remove(&tag);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_protocol::{answer_header, signed_header};

    fn head(opcode: Opcode, status: Status, tag: u8, words: u32) -> AnswerHead {
        [signed_header(answer_header(opcode as u8, status), 1, tag), words]
    }

    #[test]
    fn answers_are_kept_for_their_job() {
        let mut awaited = Awaited::default();
        let tags = [(); 2].map(|()| awaited.new_tag());
        for tag in tags {
            awaited.add(tag, Opcode::Clear, 0);
            awaited.add(tag, Opcode::Triangles, 9);
        }
        let first = head(Opcode::Clear, Status::Ok, tags[1], 0);
        assert_eq!(awaited.words_of(first, 2), Some(0));
        assert_eq!(awaited.words_of(first, 1), None, "there is no engine 1");
        awaited.keep(first, vec![]);
        let second = head(Opcode::Triangles, Status::Ok, tags[1], 9);
        assert_eq!(awaited.words_of(second, 2), Some(9));
        assert_eq!(awaited.words_of(head(Opcode::Triangles, Status::Ok, tags[1], 8), 2), None);
        assert_eq!(awaited.words_of(head(Opcode::Triangles, Status::Ok, tags[0], 9), 2), None, "out of order");
        assert_eq!(awaited.words_of(head(Opcode::Triangles, Status::Ok, 77, 9), 2), None, "no such job");
        awaited.keep(second, vec![5; 9]);
        assert!(awaited.take(tags[0]).is_none());
        assert_eq!(awaited.take(tags[1]), Some((first, vec![])));
        assert_eq!(awaited.take(tags[1]), Some((second, vec![5; 9])));
        assert!(awaited.take(tags[1]).is_none());
    }

    #[test]
    fn a_job_that_failed_is_dropped_to_its_last_answer() {
        let mut awaited = Awaited::default();
        let tag = awaited.new_tag();
        awaited.add(tag, Opcode::Insert, 5);
        awaited.add(tag, Opcode::Triangles, 9);
        let stuck = head(Opcode::Insert, Status::Stuck, tag, 5);
        assert_eq!(awaited.words_of(stuck, 2), Some(5));
        awaited.keep(stuck, vec![0; 5]);
        assert!(awaited.take(tag).is_some());
        awaited.drop_rest(tag);
        // Until the last answer has come, no other job gets the tag.
        assert!((0..300).all(|_| awaited.new_tag() != tag));
        let refused = head(Opcode::Triangles, Status::BadRange, tag, 0);
        assert_eq!(awaited.words_of(refused, 2), Some(0));
        awaited.keep(refused, vec![]);
        assert!(awaited.take(tag).is_none());
        assert!((0..300).any(|_| awaited.new_tag() == tag));
    }
}
