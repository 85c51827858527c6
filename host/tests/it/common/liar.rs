//! A device whose answers are changed on the way.

use std::time::{Duration, Instant};

use incircle::transports::{receive_in_pieces, AnswerHead, Capabilities};
use incircle::{Transport, TransportError};
use incircle_model::CommandModel;
use incircle_protocol::{Command, Opcode};

/// Changes an answer, which has the opcode of its command, its header and length, and its payload.
type Lie = Box<dyn FnMut(Opcode, &mut Vec<u32>)>;

/// A sound model whose answers pass through a lie.
pub struct Liar {
    model: CommandModel,
    lie: Lie,
    answer: Vec<u32>,
    pub silent_for: Duration,
    packs: bool,
    /// Change of the words of points on their way to the model.
    moving: fn(u32) -> u32,
}

impl Liar {
    pub fn new(coord_bits: u32, lie: impl FnMut(Opcode, &mut Vec<u32>) + 'static) -> Self {
        Self {
            model: CommandModel::new(coord_bits, 64, 32).expect("a model"),
            lie: Box::new(lie),
            answer: Vec::new(),
            silent_for: Duration::ZERO,
            packs: true,
            moving: |word| word,
        }
    }

    /// The same device, whose model gets other points than the host sends: each has the y of its word four times as
    /// large. Every mesh is then a sound triangulation of the host's points, but seldom that of Delaunay.
    pub fn stretching(self) -> Self {
        Self { moving: |word| word & 0xffff | word >> 16 << 18, ..self }
    }

    /// The same device over a transport that reads whole records, with their neighbours.
    pub fn with_links(self) -> Self {
        Self { packs: false, ..self }
    }
}

impl Liar {
    fn fill(&mut self, words: &mut [u32]) -> Result<(), TransportError> {
        std::thread::sleep(self.silent_for);
        let wanted = words.len();
        if self.answer.len() < wanted {
            return Err(TransportError::Timeout { done: self.answer.len(), wanted });
        }
        for (word, answer) in words.iter_mut().zip(self.answer.drain(..wanted)) {
            *word = answer;
        }
        Ok(())
    }
}

impl Transport for Liar {
    fn name(&self) -> String {
        "liar".to_owned()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], _: Instant) -> Result<(), TransportError> {
        for command in commands {
            let mut words = Vec::new();
            match command {
                Command::Insert { count, points } => {
                    let moved: Vec<u32> = points.iter().map(|&word| (self.moving)(word)).collect();
                    Command::Insert { count: *count, points: &moved[..] }.encode(&mut words);
                }
                command => command.encode(&mut words),
            }
            self.model.send(&words);
            let mut answer = vec![0; 2];
            // If a lie made the host send too few points, the model waits for more and does not answer.
            if self.model.receive(&mut answer) < answer.len() {
                return Err(TransportError::Closed { done: 0, wanted: 2 });
            }
            answer.resize(2 + answer[1] as usize, 0);
            assert_eq!(self.model.receive(&mut answer[2..]), answer.len() - 2);
            (self.lie)(command.opcode(), &mut answer);
            self.answer.extend(answer);
        }
        Ok(())
    }

    fn receive(&mut self, head: AnswerHead, payload: &mut [u32], _: Instant) -> Result<AnswerHead, TransportError> {
        receive_in_pieces(head, payload, |words| self.fill(words))
    }

    fn capabilities(&self) -> Capabilities {
        Capabilities { packs_records: self.packs, ..Capabilities::default() }
    }
}
