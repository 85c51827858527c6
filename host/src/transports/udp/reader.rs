//! Receiving answers: asking for them, putting them together, and asking again for those that were lost.

use std::collections::VecDeque;
use std::time::Duration;

use incircle_protocol::{Command, Layout, ANSWER_HEAD_WORDS};

use super::fault::UdpFault;
use super::sender::Sender;
use super::unit::{Answer, State, Unit};

/// Number of later datagrams after which an answer that they overtook counts as lost.
const OVERTAKEN: u32 = 3;
/// Share of units with a lost answer, of 256, from which on no job is sent ahead of the one before it, because a lost
/// answer then costs a whole job; and the share below which jobs are sent ahead again. The two are far apart, so that
/// chance does not switch between them.
const LOSSY: u32 = 96;
const CLEAN: u32 = 24;
/// The weight of the last unit in that share is one part in so many.
const MEMORY: u32 = 8;

/// A question whose answer is awaited.
#[derive(Clone, Copy, Debug)]
struct Asked {
    unit: u64,
    run: u32,
    question: usize,
    /// Words of the answer, header and length included.
    words: usize,
    /// Bytes of the session up to the end of the question.
    end: u64,
    /// Time at which a later answer was first seen, or heard of, and number of datagrams since.
    passed_at: Option<Duration>,
    passed_by: u32,
}

/// The receiving half of a session. It also decides what is asked, and when.
#[derive(Debug)]
pub(super) struct Reader {
    layout: Layout,
    /// Most words of answers that may be awaited at a time.
    window: usize,
    /// Units whose answers have not been taken, in the order in which they came.
    units: VecDeque<Unit>,
    /// Number of the next unit, and of the last one that began with a `Clear`.
    next_unit: u64,
    last_anew: Option<u64>,
    /// Number of the unit whose questions are being sent, or were sent last.
    current: Option<u64>,
    /// Number of the unit whose points are in the device once all commands are carried out.
    memory: Option<u64>,
    /// Questions by the numbers of their answers, `None` where the answer has come or was lost.
    asked: VecDeque<Option<Asked>>,
    /// Number of the first answer in `asked`.
    first: u64,
    /// Number up to which the device has sent answers.
    horizon: u64,
    awaited_words: usize,
    /// The window was full, and more than half of it is still awaited.
    is_filled: bool,
    /// Answers of finished units.
    ready: VecDeque<Answer>,
    /// Share of units with a lost answer, of 256.
    lossy: u32,
    /// Whether jobs are sent ahead of each other.
    goes_ahead: bool,
    /// Number of answers asked for again, and of units sent again.
    repeated: u64,
    restarted: u64,
}

impl Reader {
    pub fn new(window: usize) -> Self {
        Self {
            layout: Layout { point_words: 1, record_words: 3 },
            window,
            units: VecDeque::new(),
            next_unit: 0,
            last_anew: None,
            current: None,
            memory: None,
            asked: VecDeque::new(),
            first: 0,
            horizon: 0,
            awaited_words: 0,
            is_filled: false,
            ready: VecDeque::new(),
            lossy: 0,
            goes_ahead: true,
            repeated: 0,
            restarted: 0,
        }
    }

    /// Begins a session: the device has forgotten everything, and units that were not begun will be sent.
    pub fn begin_session(&mut self, layout: Layout) {
        self.layout = layout;
        (self.first, self.horizon, self.awaited_words, self.is_filled) = (0, 0, 0, false);
        (self.current, self.memory) = (None, None);
        self.asked.clear();
    }

    /// Number of answers asked for again, and of units sent again.
    pub fn repeats(&self) -> (u64, u64) {
        (self.repeated, self.restarted)
    }

    /// Takes commands, whose answers will come in their order.
    pub fn add(&mut self, commands: &[Command<&[u32]>]) {
        let mut rest = commands;
        while let Some((first, behind)) = rest.split_first() {
            let length = behind.iter().take_while(|command| !matches!(command, Command::Clear(_))).count() + 1;
            let (of_unit, behind) = rest.split_at(length);
            rest = behind;
            let is_anew = matches!(first, Command::Clear(_));
            let commands = of_unit.iter().map(|command| command.map(<[u32]>::to_vec)).collect();
            let needs = if is_anew { None } else { self.last_anew };
            self.units.push_back(Unit::new(self.next_unit, commands, needs));
            if is_anew {
                self.last_anew = Some(self.next_unit);
            }
            self.next_unit += 1;
        }
    }

    /// Whether an answer is awaited, or a unit has not begun.
    pub fn is_waiting(&self) -> bool {
        !self.units.is_empty()
    }

    /// Whether every unit can be carried out on a device that has just been reset.
    pub fn needs_no_memory(&self) -> bool {
        self.units.front().is_none_or(Unit::needs_no_memory)
    }

    /// Forgets all units, and begins again with the units that come next.
    pub fn abandon(&mut self) {
        self.units.clear();
        self.ready.clear();
    }

    /// Takes the next answer, if all answers of its unit are there and the device has proved what it took.
    pub fn take_answer(&mut self, sender: &Sender) -> Option<Answer> {
        while self.ready.is_empty() {
            let is_whole = |unit: &mut Unit| unit.is_done() && unit.end <= sender.proved_bytes();
            let unit = self.units.pop_front_if(is_whole)?;
            let share = if unit.had_loss { 256 } else { 0 };
            self.lossy = (self.lossy * (MEMORY - 1) + share) / MEMORY;
            self.goes_ahead = self.lossy < if self.goes_ahead { LOSSY } else { CLEAN };
            self.ready = unit.into_answers();
        }
        self.ready.pop_front()
    }

    /// Sends the questions that may be sent. Once the window is full, half of it must come before more is asked, so that
    /// a datagram carries many questions: each datagram costs both sides a receipt.
    pub fn ask_more(&mut self, sender: &mut Sender) -> Result<(), UdpFault> {
        self.is_filled &= self.awaited_words > self.window / 2;
        if self.is_filled {
            return Ok(());
        }
        loop {
            let unit = self.units.iter_mut().find(|unit| Some(unit.number) == self.current && unit.is_started);
            let due = unit.and_then(|unit| unit.due().map(|question| (unit, question)));
            let Some((unit, question)) = due else {
                if self.start_next()? {
                    continue;
                }
                return Ok(());
            };
            let words = ANSWER_HEAD_WORDS + unit.questions.get(question).map_or(0, |question| question.words);
            if self.awaited_words > 0 && self.awaited_words + words > self.window {
                self.is_filled = true;
                return Ok(());
            }
            let (number, run) = (unit.number, unit.run);
            let Some(command) = unit.ask(question) else { return Ok(()) };
            let end = sender.push(&command);
            unit.end = end;
            let asked = Asked { unit: number, run, question, words, end, passed_at: None, passed_by: 0 };
            self.asked.push_back(Some(asked));
            self.awaited_words += words;
        }
    }

    /// Starts the next unit that has not been started, if it may be started now.
    fn start_next(&mut self) -> Result<bool, UdpFault> {
        let Some(index) = self.units.iter().position(|unit| !unit.is_started) else { return Ok(false) };
        let unit = &self.units[index];
        let others_are_done = self.units.iter().all(|other| !other.is_started || other.is_done());
        // A unit that cannot be sent again must have the device to itself until its answers are there.
        let may_overtake = |other: &Unit| !other.is_started || other.is_done() || other.begins_anew();
        let may_go_ahead = unit.begins_anew() && self.goes_ahead && self.units.iter().all(may_overtake);
        if !others_are_done && !may_go_ahead {
            return Ok(false);
        }
        if !unit.needs_no_memory() && unit.needs != self.memory {
            return Err(UdpFault::Command("the points that this command needs are no longer in the device"));
        }
        let is_anew = unit.begins_anew();
        let number = unit.number;
        self.units[index].start(self.layout)?;
        self.current = Some(number);
        if is_anew {
            self.memory = Some(number);
        }
        Ok(true)
    }

    /// Takes an answer of this number. Returns true if it was awaited.
    pub fn take(&mut self, number: u32, words: &[u32], sender: &Sender) -> Result<bool, UdpFault> {
        let number = u64::from(number);
        let Some(place) = number.checked_sub(self.first) else { return Ok(false) };
        let slot = usize::try_from(place).ok().and_then(|place| self.asked.get_mut(place));
        let slot = slot.ok_or(UdpFault::Unasked { number })?;
        let Some(asked) = *slot else { return Ok(false) };
        if asked.end > sender.taken_bytes() {
            return Err(UdpFault::Unasked { number });
        }
        *slot = None;
        self.awaited_words -= asked.words;
        self.horizon = self.horizon.max(number + 1);
        self.forget_done();
        let layout = self.layout;
        let unit = self.units.iter_mut().find(|unit| (unit.number, unit.run) == (asked.unit, asked.run));
        if let Some(unit) = unit.filter(|unit| unit.is_started) {
            unit.take(asked.question, words, layout)?;
        }
        Ok(true)
    }

    /// Hears that the device has sent `answers` answers to their end.
    pub fn passed(&mut self, answers: u32, sender: &Sender) -> Result<(), UdpFault> {
        let answers = u64::from(answers);
        let last = answers.checked_sub(self.first + 1).and_then(|last| usize::try_from(last).ok());
        let Some(last) = last else { return Ok(()) };
        match self.asked.get(last) {
            None => return Err(UdpFault::Unasked { number: answers - 1 }),
            Some(Some(asked)) if asked.end > sender.taken_bytes() => {
                return Err(UdpFault::Unasked { number: answers - 1 });
            }
            Some(_) => self.horizon = self.horizon.max(answers),
        }
        Ok(())
    }

    /// Counts a datagram of the session, and makes the questions due again whose answers are lost.
    pub fn count(&mut self, now: Duration, grace: Duration, is_datagram: bool) {
        let passed = usize::try_from(self.horizon.saturating_sub(self.first)).unwrap_or(usize::MAX);
        let mut lost = Vec::new();
        for slot in self.asked.iter_mut().take(passed) {
            let Some(asked) = slot else { continue };
            let passed_at = *asked.passed_at.get_or_insert(now);
            asked.passed_by += u32::from(is_datagram);
            if asked.passed_by > OVERTAKEN || now >= passed_at + grace {
                lost.push(*asked);
                *slot = None;
            }
        }
        for asked in lost {
            self.awaited_words -= asked.words;
            self.lose(asked);
        }
        self.forget_done();
    }

    /// Time at which the next answer counts as lost.
    pub fn lost_at(&self, grace: Duration) -> Option<Duration> {
        self.asked.iter().flatten().next()?.passed_at.map(|passed_at| passed_at + grace)
    }

    /// Asks once more for what was lost: the question alone while the device still holds the answer, else all of the
    /// unit.
    fn lose(&mut self, asked: Asked) {
        let is_current = self.current == Some(asked.unit);
        let unit = self.units.iter_mut().find(|unit| (unit.number, unit.run) == (asked.unit, asked.run));
        let Some(unit) = unit.filter(|unit| unit.is_started && !unit.is_done()) else { return };
        unit.had_loss = true;
        if is_current && !(unit.is_clear(asked.question) && unit.begins_anew()) {
            let Some(question) = unit.questions.get_mut(asked.question) else { return };
            if question.state == State::Asked {
                question.state = State::Due;
                self.repeated += 1;
            }
            return;
        }
        unit.restart();
        self.restarted += 1;
    }

    fn forget_done(&mut self) {
        while self.asked.pop_front_if(|slot| slot.is_none()).is_some() {
            self.first += 1;
        }
    }
}
