//! The words of commands that wait for an engine, so that a command behind a long one does not hold up the stream.
//!
//! 1. `has_room` depends on registers only, and `push` is allowed only while it is high. A word on its way into the
//!    queue counts as waiting there.
//!
//! Latency: 1 clock from `push` to the command stream while the queue is empty.

use crate::commands::types::Word;
use crate::commands::CommandSource;
use crate::leaf::DeepFifo;
use crate::prelude::*;
use incircle_protocol::ENGINE_QUEUE_WORDS;

#[derive(LogicBlock, Default)]
pub struct CommandQueue {
    pub clock: Signal<In, Clock>,
    /// A reset drops all words.
    pub reset: Signal<In, Bit>,
    /// Take `word` at this edge.
    pub push: Signal<In, Bit>,
    pub word: Signal<In, Word>,
    pub has_room: Signal<Out, Bit>,
    pub command: CommandSource,
    /// Number of words that wait.
    waiting: DFF<Bits<9>>,
    /// The word that came at the edge before: a register keeps the router's logic away from the engine's.
    came: DFF<Bit>,
    newest: DFF<Word>,
    words: DeepFifo<8, 32>,
    takes: Signal<Local, Bit>,
    one: Signal<Local, Bits<9>>,
    all: Signal<Local, Bits<9>>,
}

// The kernel holds the number as a literal, because rust-hdl allows no constants there.
const _: () = assert!(ENGINE_QUEUE_WORDS == 256, "the FIFO of this block has as many words as the protocol says");

impl Logic for CommandQueue {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, waiting, came, newest);
        clock!(self, clock, words);
        self.one.next = 1.into();
        self.all.next = 256.into();
        self.has_room.next = self.waiting.q.val() != self.all.val();
        self.came.d.next = self.push.val();
        self.newest.d.next = self.word.val();
        self.words.reset.next = self.reset.val();
        self.words.push.next = self.came.q.val();
        self.words.push_data.next = self.newest.q.val();
        self.command.valid.next = self.words.valid.val();
        self.command.data.next = self.words.data.val();
        self.takes.next = self.words.valid.val() & self.command.ready.val();
        self.words.pop.next = self.takes.val();
        if self.push.val() & (!self.takes.val()) {
            self.waiting.d.next = self.waiting.q.val() + self.one.val();
        }
        if self.takes.val() & (!self.push.val()) {
            self.waiting.d.next = self.waiting.q.val() - self.one.val();
        }
        if self.reset.val() {
            self.waiting.d.next = 0.into();
            self.came.d.next = false;
        }
    }
}
