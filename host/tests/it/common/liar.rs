//! A device that lies.

use std::time::{Duration, Instant};

use incircle::{ModelTransport, Transport, TransportError};
use incircle_protocol::{command_opcode, Opcode};

/// What a lying device does with an answer: opcode, header and length, payload.
type Lie = Box<dyn FnMut(Opcode, &mut Vec<u32>)>;

/// A real model whose answers pass through a liar.
pub struct Liar {
    model: ModelTransport,
    lie: Lie,
    answer: Vec<u32>,
    pub silent_for: Duration,
    packs: bool,
}

impl Liar {
    pub fn new(coord_bits: u32, lie: impl FnMut(Opcode, &mut Vec<u32>) + 'static) -> Self {
        Self {
            model: ModelTransport::new(coord_bits, 64).expect("a model"),
            lie: Box::new(lie),
            answer: Vec::new(),
            silent_for: Duration::ZERO,
            packs: true,
        }
    }

    /// A way on which the host reads whole records.
    pub fn with_links(self) -> Self {
        Self { packs: false, ..self }
    }
}

impl Transport for Liar {
    fn send(&mut self, words: &[u32], deadline: Instant) -> Result<(), TransportError> {
        self.model.send(words, deadline)?;
        let mut answer = vec![0; 2];
        self.model.receive(&mut answer, deadline)?;
        answer.resize(2 + answer[1] as usize, 0);
        self.model.receive(&mut answer[2..], deadline)?;
        let opcode = Opcode::from_u8(command_opcode(words[0])).expect("the host knows its opcodes");
        (self.lie)(opcode, &mut answer);
        self.answer.extend(answer);
        Ok(())
    }

    fn receive(&mut self, words: &mut [u32], _deadline: Instant) -> Result<(), TransportError> {
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

    fn name(&self) -> String {
        "liar".to_owned()
    }

    fn packs_records(&self) -> bool {
        self.packs
    }
}
