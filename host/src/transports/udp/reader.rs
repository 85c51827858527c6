//! Receiving answers: asking for them, putting them together, and asking again for those that were lost.

use std::collections::VecDeque;
use std::time::Duration;

use incircle_protocol::{answer_engine, signed_header, Clear, Command, Layout, ANSWER_HEAD_WORDS};

use super::awaited::{Asked, Awaited, Outcome};
use super::fault::UdpFault;
use super::sender::Sender;
use super::unit::{Answer, State, Unit};

/// Number of datagrams or of answers from which on a session takes no new job: half of the numbers that there are. The
/// jobs under way, and the mesh that stands, may use the other half.
const MOST_NUMBERS: u64 = 1 << 31;
/// Number of datagrams or of answers from which on a session takes no command that needs its mesh: a million below the
/// largest one.
const LAST_NUMBERS: u64 = u32::MAX as u64 - (1 << 20);

/// Once this share of units (of 256) lost an answer, the host sends one job at a time; below [`CLEAN`] it sends ahead
/// again. An answer that is lost while the next job is under way costs a whole job. The two shares are far apart, so
/// that chance does not switch between them.
const LOSSY: u32 = 96;
const CLEAN: u32 = 24;
/// The newest unit counts one part in `MEMORY`.
const MEMORY: u32 = 8;

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
    /// The tag that the library gave to the last job.
    last_tag: u8,
    /// Number of the unit whose questions are being sent, or were sent last.
    current: Option<u64>,
    /// Number of the unit whose points are in the device once all commands are carried out.
    memory: Option<u64>,
    awaited: Awaited,
    /// The tag that the device has for the job whose questions are being sent, if it has several engines.
    tag: Option<u8>,
    /// The window was full, and more than half of it is still awaited.
    is_filled: bool,
    /// Answers of finished units.
    ready: VecDeque<Answer>,
    /// Share of units with a lost answer, of 256.
    lossy: u32,
    /// Whether jobs are sent ahead of each other.
    goes_ahead: bool,
    /// Number of datagrams or of answers from which on the session takes no new job.
    pub most_numbers: u64,
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
            last_tag: 0,
            current: None,
            memory: None,
            awaited: Awaited::default(),
            tag: None,
            is_filled: false,
            ready: VecDeque::new(),
            lossy: 0,
            goes_ahead: true,
            most_numbers: MOST_NUMBERS,
            repeated: 0,
            restarted: 0,
        }
    }

    /// Begins a session: the device has forgotten everything, and units that were not begun will be sent.
    pub fn begin_session(&mut self, layout: Layout, engines: u32) {
        (self.layout, self.awaited, self.tag) = (layout, Awaited::new(engines), None);
        (self.current, self.memory, self.is_filled) = (None, None, false);
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
            let tag = if let Command::Clear(clear) = first { Some(clear.tag) } else { None };
            let is_anew = tag.is_some();
            self.last_tag = tag.unwrap_or(self.last_tag);
            let commands = of_unit.iter().map(|command| command.map(<[u32]>::to_vec)).collect();
            let needs = if is_anew { None } else { self.last_anew };
            self.units.push_back(Unit::new(self.next_unit, commands, needs, self.last_tag));
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

    /// Whether every unit can be carried out on a device that has just been reset. All units behind the first begin
    /// with a `Clear`, so the first decides.
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
            self.note_loss(unit.had_loss);
            self.ready = unit.into_answers();
        }
        self.ready.pop_front()
    }

    /// Notes whether a unit had a loss, and decides whether jobs go ahead of each other.
    fn note_loss(&mut self, had_loss: bool) {
        let share = if had_loss { 256 } else { 0 };
        self.lossy = (self.lossy * (MEMORY - 1) + share) / MEMORY;
        self.goes_ahead = self.lossy < if self.goes_ahead { LOSSY } else { CLEAN };
    }

    /// Sends the questions that may be sent. Once the window is full, half of it must come before more is asked, so
    /// that a datagram carries many questions: each datagram costs both sides a receipt.
    pub fn ask_more(&mut self, sender: &mut Sender) -> Result<(), UdpFault> {
        self.is_filled &= self.awaited.words() > self.window / 2;
        if self.is_filled {
            return Ok(());
        }
        loop {
            let unit = self.units.iter_mut().find(|unit| Some(unit.number) == self.current && unit.is_started);
            let due = unit.and_then(|unit| unit.due().map(|question| (unit, question)));
            let Some((unit, question)) = due else {
                if self.start_next(sender)? {
                    continue;
                }
                return Ok(());
            };
            if unit.waits(question) {
                return Ok(());
            }
            let words = ANSWER_HEAD_WORDS + unit.questions.get(question).map_or(0, |question| question.words);
            if self.awaited.words() > 0 && self.awaited.words() + words > self.window {
                self.is_filled = true;
                return Ok(());
            }
            let (number, run) = (unit.number, unit.run);
            let Some(command) = unit.ask(question) else { return Ok(()) };
            let end = sender.push(&with_tag(command, self.tag));
            unit.end = end;
            self.awaited.ask(self.tag.unwrap_or(0), Asked { unit: number, run, question, words }, end);
        }
    }

    /// Number of datagrams or of answers of the session so far, whichever is larger.
    fn used(&self, sender: &Sender) -> u64 {
        sender.cut().max(self.awaited.asked())
    }

    /// Whether the session has used so many numbers that jobs wait for another one.
    fn is_used_up(&self, sender: &Sender) -> bool {
        self.used(sender) >= self.most_numbers
    }

    /// Whether the session has used so many numbers that another one should be opened, and nothing is under way in it.
    pub fn wants_session(&self, sender: &Sender) -> bool {
        let is_at_job = self.units.iter().any(|unit| unit.is_started);
        self.is_used_up(sender) && sender.is_done() && !is_at_job && self.units.front().is_some_and(Unit::begins_anew)
    }

    /// Starts the next unit that has not been started, if it may be started now.
    fn start_next(&mut self, sender: &Sender) -> Result<bool, UdpFault> {
        let Some(index) = self.units.iter().position(|unit| !unit.is_started) else { return Ok(false) };
        let unit = &self.units[index];
        if unit.begins_anew() && self.is_used_up(sender) {
            return Ok(false);
        }
        let others_are_done = self.units.iter().all(|other| !other.is_started || other.is_done());
        // A unit that cannot be sent again must have the device to itself until its answers are there.
        let may_overtake = |other: &Unit| !other.is_started || other.is_done() || other.begins_anew();
        let may_go_ahead = unit.begins_anew() && self.goes_ahead && self.units.iter().all(may_overtake);
        // On a device of several engines a lost answer may be asked for again only if no other job can have lost it.
        let may_go = may_go_ahead || others_are_done && (self.tag.is_none() || self.awaited.is_settled());
        if !may_go {
            return Ok(false);
        }
        if !unit.needs_no_memory() && unit.needs != self.memory {
            return Err(UdpFault::Command("the points that this command needs are no longer in the device"));
        }
        if self.used(sender) >= LAST_NUMBERS {
            return Err(UdpFault::Command(
                "the session has used up its 4,294,967,295 numbers: open the device again, and give it all points anew",
            ));
        }
        let is_anew = unit.begins_anew();
        let number = unit.number;
        if is_anew {
            self.tag = self.awaited.new_tag();
        }
        self.units[index].start(self.layout)?;
        self.current = Some(number);
        if is_anew {
            self.memory = Some(number);
        }
        Ok(true)
    }

    /// Takes an answer of this number. Returns true if it was awaited.
    pub fn take(&mut self, number: u32, words: &[u32], sender: &Sender) -> Result<bool, UdpFault> {
        let was_awaited = self.awaited.take(number, words, sender.taken_bytes())?;
        self.settle()?;
        Ok(was_awaited)
    }

    /// Hears that the device has sent `answers` answers to their end.
    pub fn passed(&mut self, answers: u32, sender: &Sender) -> Result<(), UdpFault> {
        self.awaited.passed(answers, sender.taken_bytes())
    }

    /// Counts a datagram of the session, or only looks at the time, and makes the questions due again whose answers are
    /// lost.
    pub fn count(&mut self, now: Duration, grace: Duration, is_datagram: bool) -> Result<(), UdpFault> {
        self.awaited.count(now, grace, is_datagram);
        self.settle()
    }

    /// Time at which the next answer counts as lost.
    pub fn lost_at(&self, grace: Duration) -> Option<Duration> {
        self.awaited.lost_at(grace)
    }

    /// Acts on each answer that came or is lost.
    fn settle(&mut self) -> Result<(), UdpFault> {
        while let Some(outcome) = self.awaited.next()? {
            match outcome {
                Outcome::Came(asked, words) => self.hand_on(asked, words)?,
                Outcome::Lost(asked) => self.lose(asked),
                Outcome::LostOfOne(runs) => {
                    // Jobs that begin again and again must not keep the share from growing.
                    self.note_loss(true);
                    runs.into_iter().for_each(|(unit, run)| self.begin_again(unit, run));
                }
            }
        }
        Ok(())
    }

    /// Gives an answer to its unit, with the tag that the library gave to the job.
    fn hand_on(&mut self, asked: Asked, mut words: Vec<u32>) -> Result<(), UdpFault> {
        let (layout, has_tag) = (self.layout, self.tag.is_some());
        let Some(unit) = self.unit_of(asked.unit, asked.run) else { return Ok(()) };
        if let Some(header) = words.first_mut().filter(|_| has_tag) {
            *header = signed_header(*header, answer_engine(*header), unit.tag);
        }
        unit.take(asked.question, &words, layout)
    }

    /// The unit of this number, if it is in this run.
    fn unit_of(&mut self, number: u64, run: u32) -> Option<&mut Unit> {
        self.units.iter_mut().find(|unit| (unit.number, unit.run) == (number, run) && unit.is_started)
    }

    /// Asks once more for what was lost: the question alone while the device still holds the answer, else all of the
    /// unit.
    fn lose(&mut self, asked: Asked) {
        let is_current = self.current == Some(asked.unit);
        let Some(unit) = self.unit_of(asked.unit, asked.run).filter(|unit| !unit.is_done()) else { return };
        if !is_current || unit.is_clear(asked.question) && unit.begins_anew() {
            return self.begin_again(asked.unit, asked.run);
        }
        unit.had_loss = true;
        let Some(question) = unit.questions.get_mut(asked.question) else { return };
        if question.state == State::Asked {
            question.state = State::Due;
            self.repeated += 1;
        }
    }

    /// Sends a unit once more, if it is in this run and needs answers.
    fn begin_again(&mut self, number: u64, run: u32) {
        let Some(unit) = self.unit_of(number, run).filter(|unit| !unit.is_done()) else { return };
        unit.had_loss = true;
        unit.restart();
        self.restarted += 1;
    }
}

/// The command with this tag, if it is a `Clear` and there is a tag.
fn with_tag(command: Command<&[u32]>, tag: Option<u8>) -> Command<&[u32]> {
    match (command, tag) {
        (Command::Clear(clear), Some(tag)) => Command::Clear(Clear { tag, ..clear }),
        (command, _) => command,
    }
}
