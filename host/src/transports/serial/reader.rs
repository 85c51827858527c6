//! Receiving answers: asking for them, putting them together, and asking again where a part was lost.

use std::collections::VecDeque;

use incircle_protocol::{
    answer_head, Command, Layout, RecordRange, ANSWER_HEAD_WORDS as HEADER, COUNTER_WORDS, IDENTITY_WORDS,
    INSERT_REPORT_WORDS, LATENCY_BUCKETS,
};

use super::codec::AnswerPart;
use super::fault::SerialFault;
use super::sender::Sender;
use crate::transports::is_begun_as;
use crate::transports::read_out::ReadOut;
use crate::transports::sendable::check_sendable;
use crate::transports::words::words_of;

/// Most words of payload of a range: with the header they fill three frames.
const RANGE_WORDS: usize = 3 * 256 - HEADER;
/// Most words of payload of the answer to a run, which is asked for as a whole.
pub(super) const RUN_WORDS: usize = RANGE_WORDS;
/// Words of payload of the first ranges. Ranges grow on a clean line.
const FIRST_RANGE_WORDS: usize = 192;
/// Fewest words of payload of a range, to which noise makes them shrink.
const MIN_RANGE_WORDS: usize = 12;
/// Most ranges under way: enough for the round trip through a slow adapter.
const MAX_ASKED: usize = 12;
/// Whole ranges in a row after which ranges grow.
const GROW_AFTER: u32 = 3;

/// A question whose answer has not ended.
#[derive(Debug)]
struct Asked {
    what: Question,
    header: [u32; HEADER],
    /// Words received so far, without a gap.
    came: usize,
    /// Whether a part was lost, so that the rest is of no use.
    is_damaged: bool,
    digest: crc32fast::Hasher,
    /// Bytes of the session up to the end of the question.
    end: u64,
}

/// The part of the command that a question is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Question {
    /// The command as a whole, with the most words of payload that its answer may have.
    Whole { words: usize },
    /// A part of the command's range of records, with the length of its payload.
    Range { first: u32, count: u32, words: usize },
    /// Something that nobody waits for any more.
    Nothing,
}

/// A command and its answer so far.
#[derive(Debug)]
struct Exchange {
    /// Command that brings the same answer again.
    again: Command<Vec<u32>>,
    /// Most words of payload of the answer to the whole command.
    most: usize,
    /// Answer so far: header, length, payload.
    answer: Vec<u32>,
    /// Ranges that are still to be asked for, each as its first record and its number of records.
    todo: VecDeque<(u32, u32)>,
    /// The command's range of records, if it reads any.
    read_out: Option<ReadOut>,
    /// Number of records that have not come.
    missing: u32,
    is_done: bool,
}

/// The receiving half of a session.
#[derive(Debug)]
pub(super) struct Reader {
    /// Layout of points and records of this device in words.
    layout: Layout,
    exchange: Option<Exchange>,
    asked: VecDeque<Asked>,
    /// Number of the answer to the first question in `asked`, modulo 256.
    number: u8,
    /// Words of payload of the next ranges.
    range: usize,
    /// Whole ranges in a row.
    clean: u32,
    /// Number of answers asked for again.
    repeated: u64,
}

impl Reader {
    /// A reader for a device whose points and records have this layout.
    pub fn new(layout: Layout) -> Self {
        Self {
            layout,
            exchange: None,
            asked: VecDeque::new(),
            number: 0,
            range: FIRST_RANGE_WORDS,
            clean: 0,
            repeated: 0,
        }
    }

    /// Number of answers asked for again.
    pub fn repeated(&self) -> u64 {
        self.repeated
    }

    /// Whether an answer is awaited.
    pub fn is_waiting(&self) -> bool {
        self.exchange.as_ref().is_some_and(|exchange| !exchange.is_done)
    }

    /// Whether an answer is whole and has not been taken.
    pub fn has_answer(&self) -> bool {
        self.exchange.as_ref().is_some_and(|exchange| exchange.is_done)
    }

    /// Takes the answer, once all of it has come.
    pub fn take_answer(&mut self) -> Option<Vec<u32>> {
        let exchange = self.exchange.take_if(|exchange| exchange.is_done)?;
        Some(exchange.answer)
    }

    /// Begins a command: asks for the whole answer, or for the first ranges.
    pub fn begin(&mut self, command: &Command<impl AsRef<[u32]>>, sender: &mut Sender) -> Result<(), SerialFault> {
        let exchange = Exchange::of(command, self.layout)?;
        if exchange.todo.is_empty() {
            let end = sender.push_command(command);
            self.asked.push_back(Asked::new(Question::Whole { words: exchange.most }, end));
        }
        self.exchange = Some(exchange);
        self.ask_more(sender);
        Ok(())
    }

    /// Asks for more ranges, as many as may be under way.
    pub fn ask_more(&mut self, sender: &mut Sender) {
        let Some(exchange) = &mut self.exchange else { return };
        let Some(read_out) = exchange.read_out else { return };
        let most = read_out.most(self.range);
        while self.asked.len() < MAX_ASKED {
            let Some((first, count)) = exchange.todo.pop_front() else { return };
            let now = count.min(most);
            if count > now {
                exchange.todo.push_front((first + now, count - now));
            }
            let end = sender.push_command(&read_out.part::<[u32; 0]>(first, now));
            self.asked.push_back(Asked::new(Question::Range { first, count: now, words: read_out.words(now) }, end));
        }
    }

    /// Takes a part of an answer. Returns true if the part was new.
    pub fn take(&mut self, part: &AnswerPart<'_>, sender: &mut Sender) -> Result<bool, SerialFault> {
        let passed = usize::from(part.number.wrapping_sub(self.number));
        if passed >= self.asked.len() {
            // This answer has ended already, or nobody asked for it.
            return Ok(false);
        }
        self.check_taken(passed + 1, sender)?;
        // Answers come in order, so the rest of each earlier answer is lost.
        for _ in 0..passed {
            self.end_first(sender);
        }
        let Some(asked) = self.asked.front_mut() else { return Ok(false) };
        let is_news = asked.take(part, self.exchange.as_mut())?;
        if part.digest.is_some() && (is_news || asked.is_damaged) {
            self.end_first(sender);
        }
        Ok(is_news)
    }

    /// Hears that the device has sent `answers` answers to their end, modulo 256. Those among them that have
    /// not come are lost.
    pub fn passed(&mut self, answers: u8, sender: &mut Sender) -> Result<(), SerialFault> {
        let passed = usize::from(answers.wrapping_sub(self.number));
        if passed <= self.asked.len() {
            self.check_taken(passed, sender)?;
            for _ in 0..passed {
                self.end_first(sender);
            }
        }
        Ok(())
    }

    /// Refuses answers to the first `count` questions unless the device has taken all of these questions. Without this
    /// rule, a device could make up answers, each of which would be asked for again, and the bytes that wait to be sent
    /// would grow without end.
    fn check_taken(&self, count: usize, sender: &Sender) -> Result<(), SerialFault> {
        let last = count.checked_sub(1).and_then(|last| self.asked.get(last));
        match last.filter(|asked| asked.end > sender.taken_bytes()) {
            Some(asked) => Err(SerialFault::Unasked { awaited: asked.end, taken: sender.taken_bytes() }),
            None => Ok(()),
        }
    }

    /// Drops the command under way, or its answer if nobody has taken it.
    pub fn abandon(&mut self) {
        self.exchange = None;
    }

    /// Ends the first question: either its answer is whole, or it is asked again.
    fn end_first(&mut self, sender: &mut Sender) {
        let Some(asked) = self.asked.pop_front() else { return };
        self.number = self.number.wrapping_add(1);
        let Some(exchange) = self.exchange.as_mut().filter(|exchange| !exchange.is_done) else { return };
        if asked.is_whole() {
            self.clean += 1;
            if self.clean >= GROW_AFTER {
                self.clean = 0;
                self.range = (2 * self.range).min(RANGE_WORDS);
            }
            if !exchange.finish(&asked) {
                return self.ask_more(sender);
            }
            // Nobody waits for the answers that are still to come.
            self.asked.iter_mut().for_each(|asked| asked.what = Question::Nothing);
            return;
        }
        self.clean = 0;
        self.range = (self.range / 2).max(MIN_RANGE_WORDS);
        match asked.what {
            Question::Nothing => return,
            Question::Whole { .. } => {
                let end = sender.push_command(&exchange.again);
                self.asked.push_back(Asked::new(Question::Whole { words: exchange.most }, end));
            }
            Question::Range { first, count, .. } => exchange.todo.push_front((first, count)),
        }
        self.repeated += 1;
        self.ask_more(sender);
    }
}

impl Asked {
    fn new(what: Question, end: u64) -> Self {
        Self { what, header: [0; HEADER], came: 0, is_damaged: false, digest: crc32fast::Hasher::new(), end }
    }

    /// Whether all words of the answer have come.
    fn is_whole(&self) -> bool {
        !self.is_damaged && self.came >= HEADER && self.came == HEADER + self.header[1] as usize
    }

    /// Takes the next words. Returns false if they are not the next ones: they came before, or others were lost.
    fn take(&mut self, part: &AnswerPart<'_>, exchange: Option<&mut Exchange>) -> Result<bool, SerialFault> {
        if self.is_damaged {
            return Ok(false);
        }
        // The index counts modulo 65,536, but every answer is shorter than that.
        let (index, count) = (usize::from(part.index), part.bytes.len() / 4);
        if index < self.came && index + count <= self.came {
            return Ok(false);
        }
        if index != self.came {
            self.is_damaged = true;
            return Ok(false);
        }
        let most = match self.what {
            Question::Range { words, .. } | Question::Whole { words } => HEADER + words,
            // This was a range once, and its length is forgotten.
            Question::Nothing => HEADER + RANGE_WORDS,
        };
        if index + count > most {
            return Err(SerialFault::Endless { due: most });
        }
        self.digest.update(part.bytes);
        self.came += count;
        self.keep(index, part.bytes, exchange);
        match part.digest {
            Some(announced) => self.check_end(announced).map(|()| true),
            None => Ok(true),
        }
    }

    /// Puts words into their places in the answer.
    fn keep(&mut self, index: usize, bytes: &[u8], exchange: Option<&mut Exchange>) {
        let mut exchange = exchange.filter(|exchange| !exchange.is_done);
        for (word, place) in words_of(bytes).zip(index..) {
            if let Some(header) = self.header.get_mut(place) {
                *header = word;
            }
            let Some(exchange) = exchange.as_deref_mut() else { continue };
            let place = match (self.what, exchange.read_out) {
                (Question::Whole { .. }, _) => place,
                (Question::Range { first, .. }, Some(read_out)) if place >= HEADER => place + read_out.place(first),
                _ => continue,
            };
            if let Some(kept) = exchange.answer.get_mut(place) {
                *kept = word;
            }
        }
    }

    fn check_end(&self, announced: u32) -> Result<(), SerialFault> {
        let found = self.digest.clone().finalize();
        if found != announced {
            return Err(SerialFault::AnswerDigest { found, expected: announced });
        }
        if !self.is_whole() {
            return Err(SerialFault::AnswerLength {
                announced: self.header[1],
                came: self.came.saturating_sub(HEADER),
            });
        }
        Ok(())
    }
}

/// Most words of payload of an answer to a whole command other than a run.
const LONGEST_WHOLE: usize = LATENCY_BUCKETS;
// The answers to all commands but ranges and runs must fit.
const _: () =
    assert!(COUNTER_WORDS <= LONGEST_WHOLE && IDENTITY_WORDS <= LONGEST_WHOLE && INSERT_REPORT_WORDS <= LONGEST_WHOLE);

impl Exchange {
    fn of(command: &Command<impl AsRef<[u32]>>, layout: Layout) -> Result<Self, SerialFault> {
        check_sendable(command, layout, RUN_WORDS).map_err(SerialFault::Command)?;
        let again = match command.bare() {
            // A question may be asked again. A change that was made is made no second time: its outcome says so.
            Command::Run { .. } => command.bare().map(|()| command.points().to_vec()),
            // Inserting no points brings the report of the points before them once more.
            Command::Insert { .. } => Command::Insert { count: 0, points: Vec::new() },
            command => command.map(|()| Vec::new()),
        };
        let most = if matches!(again, Command::Run { .. }) { RUN_WORDS } else { LONGEST_WHOLE };
        let (answer, todo) = (Vec::new(), VecDeque::new());
        let whole = Self { again, most, answer, todo, read_out: None, missing: 0, is_done: false };
        match ReadOut::of(command.bare(), layout) {
            Some(read_out) => whole.in_ranges(read_out, command.payload_words(layout)),
            None => Ok(Self { answer: vec![0; HEADER + most], ..whole }),
        }
    }

    /// Prepares to ask for the answer in ranges of these records.
    fn in_ranges(self, read_out: ReadOut, payload: u64) -> Result<Self, SerialFault> {
        const NO_ROOM: SerialFault = SerialFault::Command("there is no memory for an answer of this length");
        let RecordRange { first, count } = read_out.range();
        first.checked_add(count).ok_or(SerialFault::Command("the range goes beyond the last record number"))?;
        let words = usize::try_from(payload).ok().and_then(|payload| payload.checked_add(HEADER)).ok_or(NO_ROOM)?;
        let mut answer = Vec::new();
        answer.try_reserve_exact(words).map_err(|_| NO_ROOM)?;
        answer.resize(words, 0);
        let todo = VecDeque::from([(first, count)]);
        Ok(Self { answer, todo, read_out: Some(read_out), missing: count, ..self })
    }

    /// Takes a whole answer to a question. Returns true if nothing is missing any more.
    fn finish(&mut self, asked: &Asked) -> bool {
        let [header, length] = asked.header;
        match asked.what {
            Question::Nothing => false,
            Question::Whole { .. } => {
                self.answer.truncate(HEADER + length as usize);
                self.is_done = true;
                true
            }
            Question::Range { count, words, .. } => {
                let due = u32::try_from(words).unwrap_or(u32::MAX);
                let is_right = is_begun_as([header, length], answer_head(self.again.opcode(), due));
                // A refusal, or a wrong length, stands for the answer to the whole command: the session judges it.
                self.missing = if is_right { self.missing - count.min(self.missing) } else { 0 };
                if is_right {
                    let payload = self.answer.len() - HEADER;
                    [self.answer[0], self.answer[1]] = [header, u32::try_from(payload).unwrap_or(u32::MAX)];
                } else {
                    self.answer = vec![header, length];
                }
                self.is_done = self.missing == 0 && (!is_right || self.todo.is_empty());
                self.is_done
            }
        }
    }
}
