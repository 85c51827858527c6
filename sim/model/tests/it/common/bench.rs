//! A test bench for the model clock by clock, which drives both channels by command words.

use super::Random;
use incircle_model::{ClockModel, Defect, Inputs};
use incircle_protocol::{
    answer_opcode, answer_status, clear_word, command_word, Config, Counter, InsertReport, Opcode, Status,
};

/// Number of clocks that a job of `points` points may take: a hundred times what one context needs.
pub fn limit(points: usize) -> u64 {
    100 * (2000 + 40 * points as u64)
}

/// The ways in which the two channels are held up.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stalls {
    /// In one of this many clocks the next word is not offered yet; 0 means never.
    pub idle: u32,
    /// In one of this many clocks no answer is taken; 0 means never.
    pub full: u32,
    /// Words are offered first in every clock of this many; 0 means in any clock.
    pub beat: u64,
}

/// An answer of the core.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    pub opcode: u8,
    pub status: u8,
    pub payload: Vec<u32>,
}

impl Answer {
    pub fn is(&self, status: Status) -> bool {
        self.status == status as u8
    }

    /// The payload of an answer to `Insert`.
    pub fn report(&self) -> InsertReport {
        InsertReport::from_words(self.payload[..].try_into().expect("an insert report"))
    }

    /// The value of a counter in an answer to `Counters`.
    pub fn counter(&self, counter: Counter) -> u64 {
        let high = match counter {
            Counter::InsertCycles | Counter::WaitCycles | Counter::ReadCycles => self.payload[counter as usize + 1],
            _ => 0,
        };
        u64::from(self.payload[counter as usize]) | u64::from(high) << 32
    }
}

/// The error that the clocks ran out, with the state of the core.
#[derive(Clone, Debug)]
pub struct Hang(pub String);

/// Puts answers together from their words.
#[derive(Debug, Default)]
pub struct Answers {
    pub whole: Vec<Answer>,
    header: Option<u32>,
    /// Number of words of the payload that are still to come.
    left: Option<u32>,
    payload: Vec<u32>,
}

impl Answers {
    pub fn take(&mut self, word: u32) {
        match (self.header, self.left) {
            (None, _) => self.header = Some(word),
            (Some(_), None) => self.left = Some(word),
            (Some(_), Some(left)) => {
                self.payload.push(word);
                self.left = Some(left - 1);
            }
        }
        if let (Some(header), Some(0)) = (self.header, self.left) {
            let payload = std::mem::take(&mut self.payload);
            self.whole.push(Answer { opcode: answer_opcode(header), status: answer_status(header), payload });
            (self.header, self.left) = (None, None);
        }
    }

    /// Whether no part of another answer has come.
    pub fn are_whole(&self) -> bool {
        self.header.is_none()
    }
}

/// A core, and the number of clocks that it has run.
pub struct Bench {
    pub core: ClockModel,
    pub config: Config,
    pub clocks: u64,
}

impl Bench {
    pub fn new(config: Config) -> Self {
        Self { core: ClockModel::new(config).expect("a core that can be built"), config, clocks: 0 }
    }

    pub fn with_defect(config: Config, defect: Option<Defect>) -> Self {
        let mut bench = Self::new(config);
        if let Some(defect) = defect {
            bench.core = bench.core.with_defect(defect);
        }
        bench
    }

    pub fn reset(&mut self) {
        self.core.clock(Inputs { reset: true, ..Inputs::default() });
    }

    /// Sends words, and waits for this many answers.
    ///
    /// # Errors
    /// The clocks ran out.
    pub fn run(
        &mut self,
        words: &[u32],
        count: usize,
        stalls: Stalls,
        limit: u64,
        random: &mut Random,
    ) -> Result<Vec<Answer>, Hang> {
        let mut answers = Answers::default();
        let mut rest = words;
        // A word that was offered must stay offered until it is taken.
        let mut offered = false;
        let last = self.clocks + limit;
        while answers.whole.len() < count || !rest.is_empty() {
            let outputs = self.core.outputs();
            let off_beat = stalls.beat != 0 && !self.clocks.is_multiple_of(stalls.beat);
            let idle = off_beat || stalls.idle != 0 && random.below(stalls.idle) == 0;
            offered |= !rest.is_empty() && !idle;
            let full = stalls.full != 0 && random.below(stalls.full) == 0;
            let inputs = Inputs {
                reset: false,
                command_valid: offered,
                command_data: rest.first().copied().unwrap_or(0xdead_beef),
                response_ready: !full,
            };
            if inputs.command_valid && outputs.command_ready {
                rest = &rest[1..];
                offered = false;
            }
            if inputs.response_ready && outputs.response_valid {
                outputs.answer_words().for_each(|word| answers.take(word));
            }
            self.core.clock(inputs);
            self.clocks += 1;
            if self.clocks > last {
                return Err(Hang(self.core.describe()));
            }
        }
        assert!(answers.are_whole(), "words after the last answer");
        Ok(answers.whole)
    }

    /// Clears the core for `contexts` contexts, 0 for all, and inserts points with one command.
    ///
    /// # Errors
    /// The clocks ran out.
    pub fn insert(&mut self, contexts: u32, points: &[u32]) -> Result<Answer, Hang> {
        self.insert_after(clear_word(contexts), points)
    }

    /// Sends this `Clear`, and inserts points with one command.
    ///
    /// # Errors
    /// The clocks ran out.
    pub fn insert_after(&mut self, clear: u32, points: &[u32]) -> Result<Answer, Hang> {
        let mut words = vec![clear, command_word(Opcode::Insert), points.len() as u32];
        words.extend(points);
        let mut answers = self.run(&words, 2, Stalls::default(), limit(points.len()), &mut Random(0))?;
        Ok(answers.swap_remove(1))
    }

    /// The current values of the counters.
    ///
    /// # Errors
    /// The clocks ran out.
    pub fn counters(&mut self) -> Result<Answer, Hang> {
        let words = [command_word(Opcode::Counters)];
        let mut answers = self.run(&words, 1, Stalls::default(), 1000, &mut Random(0))?;
        Ok(answers.swap_remove(0))
    }

    /// The first `count` records of the memory.
    pub fn records(&self, count: u32) -> Vec<[u32; 3]> {
        (0..count).map(|id| self.core.record_words(id)).collect()
    }
}
