//! A unit of work: the commands of a job, or of a step of one, with the questions that bring their answers.

use std::collections::VecDeque;

use incircle_protocol::{answer_head, Command, Layout, ANSWER_HEAD_WORDS as HEAD, MAX_DATAGRAM_WORDS};

use super::fault::UdpFault;
use crate::transports::read_out::ReadOut;
use crate::transports::sendable::check_sendable;
use crate::transports::{is_begun_as, AnswerHead};

/// Most words of payload of an answer in one datagram. The answer to a run may have no more, because a run cannot be
/// asked for in parts.
pub(super) const MOST_PAYLOAD: usize = MAX_DATAGRAM_WORDS - HEAD;

/// The state of a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    /// The question is to be sent.
    Due,
    /// The question was sent, and its answer is awaited.
    Asked,
    /// The answer has come, or is no longer needed.
    Done,
}

/// A question whose answer fits one datagram: a command, or a range of the records that a command reads.
#[derive(Clone, Debug)]
pub(super) struct Question {
    /// Index of the command in the unit.
    command: usize,
    /// The command that reads a part of the range, if the answer to the whole command may be longer than a datagram.
    part: Option<Command<()>>,
    /// Words of payload of the answer, if the device does as it is told.
    pub words: usize,
    /// Index of the first of them in the payload of the command's answer.
    place: usize,
    pub state: State,
    /// Whether it was sent before in this run.
    was_asked: bool,
}

impl Question {
    fn new(command: usize, part: Option<Command<()>>, words: usize, place: usize) -> Self {
        Self { command, part, words, place, state: State::Due, was_asked: false }
    }
}

/// An answer: its beginning and its payload.
pub(super) type Answer = (AnswerHead, Vec<u32>);

/// Commands that belong together: from a `Clear` up to the next one, or what was submitted at once behind it.
#[derive(Debug)]
pub(super) struct Unit {
    pub number: u64,
    commands: Vec<Command<Vec<u32>>>,
    answers: Vec<Answer>,
    pub questions: Vec<Question>,
    /// Number of runs that were begun again.
    pub run: u32,
    /// Whether its questions have begun to be sent in this run.
    pub is_started: bool,
    /// Number of questions that are not done.
    missing: usize,
    /// Whether an answer was lost.
    pub had_loss: bool,
    /// Bytes of the session up to the end of its last question.
    pub end: u64,
    /// Number of the unit whose memory it needs, if it does not begin with a `Clear`.
    pub needs: Option<u64>,
    /// The tag that the library gave to the job.
    pub tag: u8,
}

impl Unit {
    pub fn new(number: u64, commands: Vec<Command<Vec<u32>>>, needs: Option<u64>, tag: u8) -> Self {
        Self {
            number,
            commands,
            answers: Vec::new(),
            questions: Vec::new(),
            run: 0,
            is_started: false,
            missing: usize::MAX,
            had_loss: false,
            end: 0,
            needs,
            tag,
        }
    }

    /// Whether it empties the memory first, so that it may be sent again as a whole.
    pub fn begins_anew(&self) -> bool {
        matches!(self.commands.first(), Some(Command::Clear(_)))
    }

    /// Whether all its answers are there.
    pub fn is_done(&self) -> bool {
        self.missing == 0
    }

    /// Whether it can be carried out on a device that has just been reset.
    pub fn needs_no_memory(&self) -> bool {
        self.begins_anew() || self.commands.iter().all(|command| matches!(command, Command::Hello))
    }

    /// Makes all questions due, as if none had been asked.
    pub fn start(&mut self, layout: Layout) -> Result<(), UdpFault> {
        const NO_ROOM: UdpFault = UdpFault::Command("there is no memory for an answer of this length");
        (self.answers, self.questions) = (Vec::new(), Vec::new());
        for (index, command) in self.commands.iter().enumerate() {
            check_sendable(command, layout, MOST_PAYLOAD).map_err(UdpFault::Command)?;
            let words = usize::try_from(command.payload_words(layout)).map_err(|_| NO_ROOM)?;
            let mut payload = Vec::new();
            payload.try_reserve_exact(words).map_err(|_| NO_ROOM)?;
            payload.resize(words, 0);
            self.answers.push(([0; HEAD], payload));
            match ReadOut::of(command.bare(), layout) {
                Some(read_out) => parts_of(index, &read_out, &mut self.questions)?,
                None => self.questions.push(Question::new(index, None, words, 0)),
            }
        }
        (self.missing, self.is_started) = (self.questions.len(), true);
        Ok(())
    }

    /// Prepares to be started once more.
    pub fn restart(&mut self) {
        self.run = self.run.wrapping_add(1);
        (self.is_started, self.missing) = (false, usize::MAX);
        self.questions.clear();
    }

    /// Index of the next question that is to be sent.
    pub fn due(&self) -> Option<usize> {
        self.questions.iter().position(|question| question.state == State::Due)
    }

    /// Whether a question that is due must wait for an answer: a run waits for all answers before it, and all later
    /// questions wait for the answer to the run. So a run that is sent again finds the mesh as its first copy left it.
    pub fn waits(&self, question: usize) -> bool {
        let is_run = |question: &Question| matches!(self.commands.get(question.command), Some(Command::Run { .. }));
        let asks_run = self.questions.get(question).is_some_and(is_run);
        self.questions.iter().any(|other| other.state == State::Asked && (asks_run || is_run(other)))
    }

    /// The command that asks this question, now.
    pub fn ask(&mut self, question: usize) -> Option<Command<&[u32]>> {
        let question = self.questions.get_mut(question)?;
        let command = self.commands.get(question.command)?;
        let was_asked = std::mem::replace(&mut question.was_asked, true);
        question.state = State::Asked;
        Some(match (command, question.part) {
            (_, Some(part)) => part.map(|()| &[][..]),
            // Inserting no points brings the report of the points before them once more.
            (Command::Insert { .. }, _) if was_asked => Command::Insert { count: 0, points: &[] },
            _ => command.borrowed(),
        })
    }

    /// Whether this question is a `Clear`, which cannot be asked again without the rest.
    pub fn is_clear(&self, question: usize) -> bool {
        let command = self.questions.get(question).and_then(|question| self.commands.get(question.command));
        matches!(command, Some(Command::Clear(_)))
    }

    /// Takes the words of the answer to a question.
    ///
    /// # Errors
    /// The answer announces another length than it has.
    pub fn take(&mut self, question: usize, words: &[u32], layout: Layout) -> Result<(), UdpFault> {
        let Some((head, payload)) = words.split_first_chunk::<HEAD>() else {
            return Err(UdpFault::AnswerLength { announced: 0, came: 0 });
        };
        if payload.len() != head[1] as usize {
            return Err(UdpFault::AnswerLength { announced: head[1], came: payload.len() });
        }
        let Some(asked) = self.questions.get_mut(question).filter(|asked| asked.state != State::Done) else {
            return Ok(());
        };
        let Some(command) = self.commands.get(asked.command) else { return Ok(()) };
        let Some(answer) = self.answers.get_mut(asked.command) else { return Ok(()) };
        let due = u32::try_from(asked.words).unwrap_or(u32::MAX);
        let place = answer.1.get_mut(asked.place..asked.place + asked.words);
        match place.filter(|_| is_begun_as(*head, answer_head(command.opcode(), due))) {
            Some(place) => {
                place.copy_from_slice(payload);
                let total = u32::try_from(command.payload_words(layout)).unwrap_or(u32::MAX);
                answer.0 = [head[0], total];
                asked.state = State::Done;
                self.missing -= 1;
            }
            // A refusal, or a wrong length, stands for the answer to the whole command: the session judges it.
            None => {
                *answer = (*head, payload.to_vec());
                self.end_command(question);
            }
        }
        Ok(())
    }

    /// Ends all questions of the command that this question belongs to.
    fn end_command(&mut self, question: usize) {
        let Some(command) = self.questions.get(question).map(|question| question.command) else { return };
        for question in self.questions.iter_mut().filter(|question| question.command == command) {
            self.missing -= usize::from(question.state != State::Done);
            question.state = State::Done;
        }
    }

    /// The answers in the order of the commands.
    pub fn into_answers(self) -> VecDeque<Answer> {
        self.answers.into()
    }
}

/// Cuts a range of records so that each answer fits a datagram.
fn parts_of(index: usize, read_out: &ReadOut, questions: &mut Vec<Question>) -> Result<(), UdpFault> {
    let range = read_out.range();
    let end = range.first.checked_add(range.count);
    let end = end.ok_or(UdpFault::Command("the range goes beyond the last record number"))?;
    let most = read_out.most(MOST_PAYLOAD);
    let mut first = range.first;
    loop {
        let count = (end - first).min(most);
        let part = Some(read_out.part(first, count));
        questions.push(Question::new(index, part, read_out.words(count), read_out.place(first)));
        first += count;
        if first == end {
            return Ok(());
        }
    }
}
