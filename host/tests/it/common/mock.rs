//! The software model with five contexts, over any kind of transport.

use std::cell::Cell;
use std::rc::Rc;
use std::time::Instant;

use incircle::transports::{receive_in_pieces, AnswerHead, Capabilities};
use incircle::{Device, Transport, TransportError};
use incircle_model::CommandModel;
use incircle_protocol::{answer_opcode, Command, Opcode};

/// The model for 512 points, behind a transport that refuses calls that its kind must not get. One word of its answers
/// may be a lie.
pub struct Mock {
    model: CommandModel,
    takes_ahead: bool,
    packs_records: bool,
    /// Number of the word that is a lie, and the bits that are flipped in it.
    lie: (usize, u32),
    received: usize,
    /// Number of commands whose answers are outstanding.
    open: usize,
    /// Number of jobs, or groups of them, that were sent and whose first answer is outstanding.
    ahead: usize,
    /// Largest value of `ahead` so far.
    most_ahead: Rc<Cell<usize>>,
}

impl Mock {
    pub fn device(takes_ahead: bool, packs_records: bool, lie: (usize, u32)) -> Device {
        Self::watched(takes_ahead, packs_records, lie).0
    }

    /// A device, with the largest number of jobs, or groups of them, that were under way at one time.
    pub fn watched(takes_ahead: bool, packs_records: bool, lie: (usize, u32)) -> (Device, Rc<Cell<usize>>) {
        let model = CommandModel::new(16, 512, 32).expect("possible").with_contexts(5);
        let most_ahead = Rc::new(Cell::new(0));
        let watch = Rc::clone(&most_ahead);
        let mock = Self { model, takes_ahead, packs_records, lie, received: 0, open: 0, ahead: 0, most_ahead };
        (Device::from_transport(Box::new(mock)), watch)
    }
}

impl Mock {
    fn fill(&mut self, words: &mut [u32]) -> Result<(), TransportError> {
        let wanted = words.len();
        let mut done = 0;
        while done < wanted {
            match self.model.receive(&mut words[done..]) {
                0 => return Err(TransportError::Closed { done, wanted }),
                more => done += more,
            }
        }
        if let Some(word) = self.lie.0.checked_sub(self.received).and_then(|place| words.get_mut(place)) {
            *word ^= self.lie.1;
        }
        self.received += wanted;
        Ok(())
    }
}

impl Transport for Mock {
    fn name(&self) -> String {
        "mock".to_owned()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], _: Instant) -> Result<(), TransportError> {
        assert!(self.takes_ahead || self.open + commands.len() == 1, "one command at a time");
        self.open += commands.len();
        self.ahead += commands.iter().filter(|command| matches!(command, Command::Clear(_))).count();
        self.most_ahead.set(self.most_ahead.get().max(self.ahead));
        let mut words = Vec::new();
        commands.iter().for_each(|command| command.encode(&mut words));
        self.model.send(&words);
        Ok(())
    }

    fn receive(&mut self, head: AnswerHead, payload: &mut [u32], _: Instant) -> Result<AnswerHead, TransportError> {
        self.open = 0;
        let came = receive_in_pieces(head, payload, |words| self.fill(words))?;
        self.ahead -= usize::from(answer_opcode(head[0]) == Opcode::Clear as u8);
        Ok(came)
    }

    fn capabilities(&self) -> Capabilities {
        let Self { takes_ahead, packs_records, .. } = *self;
        Capabilities { takes_ahead, packs_records, ..Capabilities::default() }
    }
}
