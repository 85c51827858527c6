//! The core's model, clock by clock, as a transport: the answers, records and cycle counts of the core without a
//! simulator.

use std::collections::VecDeque;
use std::time::Instant;

use incircle_model::{ChipModel, Inputs};
use incircle_protocol::{Command, Config};

use super::transport::{receive_in_pieces, receive_next_in_pieces, AnswerHead, Capabilities, DeviceClocks, Transport};
use crate::error::{Error, TransportError};

/// Name of the back end in reports, before the name of the configuration.
pub(crate) const CLOCK_NAME: &str = "clock";

/// Clocks between two looks at the deadline, which is about a millisecond.
const SLICE: u32 = 4096;

/// The model of a core or of a chip of several engines, clock by clock, as a transport.
///
/// [`Device::clock_model`](crate::Device::clock_model) makes a device of it. Clocks pass only while words are sent or
/// awaited. Answers are taken as they come, also while words are sent, and kept until they are asked for, so no order
/// of calls can block the core. Each word is offered as soon as the previous one is taken, so the cycle counts are
/// those of a core whose host never keeps it waiting within a command.
pub struct ClockTransport {
    model: ChipModel,
    config: Config,
    /// Words of answers that have not been received, each with the clock at whose end it came.
    answers: VecDeque<(u32, u64)>,
    clocks: u64,
    answer_clock: Option<u64>,
}

impl ClockTransport {
    /// Makes a core of this configuration, as after its reset. A core of one engine has the commands for a mesh that
    /// stands.
    ///
    /// # Errors
    /// [`Error::Model`] for a configuration that no core can be built with.
    pub fn new(config: Config) -> Result<Self, Error> {
        let model = ChipModel::new(config).map_err(|refusal| Error::Model(refusal.to_string()))?;
        Ok(Self::around(model.with_runs(), config))
    }

    /// A transport to a model of this configuration that may differ from a sound one, such as a model with a defect.
    pub fn around(model: ChipModel, config: Config) -> Self {
        Self { model, config, answers: VecDeque::new(), clocks: 0, answer_clock: None }
    }

    /// Runs one clock in which the core is offered this word, or none. Returns true if the core takes the word.
    fn clock(&mut self, command: Option<u32>) -> bool {
        let outputs = self.model.outputs();
        self.clocks += 1;
        self.answers.extend(outputs.answer_words().map(|word| (word, self.clocks)));
        self.model.clock(Inputs {
            reset: false,
            command_valid: command.is_some(),
            command_data: command.unwrap_or(0),
            response_ready: true,
        });
        command.is_some() && outputs.command_ready
    }
}

impl ClockTransport {
    /// Hands all words to the core, one after another.
    fn send(&mut self, words: &[u32], deadline: Instant) -> Result<(), TransportError> {
        let mut left = SLICE;
        for (done, &word) in words.iter().enumerate() {
            let mut is_taken = false;
            while !is_taken {
                is_taken = self.clock(Some(word));
                go_on(&mut left, deadline, done + usize::from(is_taken), words.len())?;
            }
        }
        Ok(())
    }

    /// Fills the whole of `words` with the next words of the core.
    fn fill(&mut self, words: &mut [u32], deadline: Instant) -> Result<(), TransportError> {
        let mut left = SLICE;
        while self.answers.len() < words.len() {
            self.clock(None);
            go_on(&mut left, deadline, self.answers.len(), words.len())?;
        }
        let answers = self.answers.drain(..words.len());
        for (place, (word, clock)) in words.iter_mut().zip(answers) {
            *place = word;
            self.answer_clock = Some(clock);
        }
        Ok(())
    }
}

impl Transport for ClockTransport {
    fn name(&self) -> String {
        format!("{CLOCK_NAME}:{}", self.config.name)
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], deadline: Instant) -> Result<(), TransportError> {
        let mut words = Vec::with_capacity(commands.iter().map(Command::words).sum());
        commands.iter().for_each(|command| command.encode(&mut words));
        self.send(&words, deadline)
    }

    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        receive_in_pieces(head, payload, |words| self.fill(words, deadline))
    }

    fn receive_next(
        &mut self,
        words_of: &mut dyn FnMut(AnswerHead) -> Option<usize>,
        payload: &mut Vec<u32>,
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        receive_next_in_pieces(words_of, payload, |words| self.fill(words, deadline))
    }

    fn capabilities(&self) -> Capabilities {
        Capabilities { takes_ahead: true, any_order: true, ..Capabilities::default() }
    }

    fn clocks(&self) -> Option<DeviceClocks> {
        Some(DeviceClocks { now: self.clocks, answer: self.answer_clock })
    }
}

/// Counts a clock, and fails once the deadline has passed. Reading the time is slow, so it is read once a slice.
fn go_on(left: &mut u32, deadline: Instant, done: usize, wanted: usize) -> Result<(), TransportError> {
    *left -= 1;
    if *left == 0 {
        *left = SLICE;
        if Instant::now() >= deadline {
            return Err(TransportError::Timeout { done, wanted });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_protocol::{answer_head, Opcode, IDENTITY_WORDS, MAGIC, SMALL, TINY};
    use std::time::Duration;

    #[test]
    fn it_answers_as_a_core() {
        let mut transport = ClockTransport::new(TINY).expect("a named configuration");
        let deadline = Instant::now() + Duration::from_secs(60);
        // Both commands are sent before an answer is taken, so the transport must keep the first answer.
        transport.submit(&[Command::Hello; 2], deadline).expect("in time");
        let head = answer_head(Opcode::Hello, IDENTITY_WORDS as u32);
        for _ in 0..2 {
            let mut identity = [0; IDENTITY_WORDS];
            assert_eq!(transport.receive(head, &mut identity, deadline).expect("in time"), head);
            assert_eq!(identity[0], MAGIC);
        }
        assert_eq!(transport.name(), "clock:tiny");
    }

    #[test]
    fn silence_ends_at_the_deadline() {
        let mut transport = ClockTransport::new(SMALL).expect("a named configuration");
        let error = transport
            .receive([0; 2], &mut [], Instant::now() + Duration::from_millis(20))
            .expect_err("nothing was asked");
        assert!(matches!(error, TransportError::Timeout { done: 0, wanted: 2 }), "{error}");
        let error = transport.submit(&[Command::Hello; 100_000], Instant::now()).expect_err("too late");
        assert!(matches!(error, TransportError::Timeout { wanted: 100_000, .. }), "{error}");
    }

    #[test]
    fn what_cannot_be_built_is_refused() {
        for config in [Config { points: 9, ..TINY }, Config { ring: 2, ..TINY }, Config { contexts: 25, ..TINY }] {
            let error = ClockTransport::new(config).err().expect("impossible");
            assert!(matches!(error, Error::Model(_)), "{error}");
        }
    }
}
