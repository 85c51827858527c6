//! The payload of an answer that is no record: asks for one word after the other.
//!
//! 1. A word is asked for through two ranks of registers, so that its number stands for two clocks before it is taken; numbers for
//!    what takes a clock longer to choose come a clock earlier.
//!
//! Latency: 2 clocks from `runs`, or from the beat before, to a beat.

use super::types::{AnswerBeat, Word, WordIndex};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Words of a payload, one after the other; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct PayloadWords {
    pub clock: Signal<In, Clock>,
    /// Reset drops the word.
    pub reset: Signal<In, Bit>,
    /// An answer is about to begin, and two clocks later it begins, with a payload of so many words.
    pub prepares: Signal<In, Bit>,
    pub starts: Signal<In, Bit>,
    pub length: Signal<In, Word>,
    /// The payload is being sent.
    pub runs: Signal<In, Bit>,
    /// Number of the word that is wanted, and what it becomes at this edge, if it changes.
    pub index: Signal<Out, WordIndex>,
    pub index_ahead: Signal<Out, WordIndex>,
    /// The word that `index` was a clock ago is taken into a register at this edge, and is then `word`.
    pub chooses: Signal<Out, Bit>,
    pub word: Signal<In, Word>,
    /// A word is there; it is taken at this edge.
    pub valid: Signal<Out, Bit>,
    pub beat: Signal<Out, AnswerBeat>,
    pub takes: Signal<In, Bit>,
    loaded: DFF<WordIndex>,
    following: DFF<WordIndex>,
    left: DFF<Word>,
    /// One word is left.
    is_last: DFF<Bit>,
    /// The first of the two clocks in which a word is chosen is over.
    waited: DFF<Bit>,
    is_chosen: DFF<Bit>,
    is_choosing: Signal<Local, Bit>,
    no_word: Signal<Local, Word>,
    one: Signal<Local, Word>,
    two: Signal<Local, Word>,
    one_word: Signal<Local, WordIndex>,
}

impl Logic for PayloadWords {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, loaded, following, left, is_last, waited, is_chosen);
        self.no_word.next = 0.into();
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.one_word.next = 1.into();
        self.index.next = self.loaded.q.val();
        self.index_ahead.next = self.following.q.val();
        self.valid.next = self.is_chosen.q.val();
        self.beat.next.low = self.word.val();
        self.beat.next.high = self.no_word.val();
        self.beat.next.both = false;
        self.beat.next.last = self.is_last.q.val();
        self.is_choosing.next = self.runs.val() & (!self.is_chosen.q.val());
        self.chooses.next = self.is_choosing.val() & self.waited.q.val();
        if self.is_choosing.val() {
            self.following.d.next = self.loaded.q.val() + self.one_word.val();
            self.waited.d.next = !self.waited.q.val();
            self.is_chosen.d.next = self.waited.q.val();
        }
        if self.takes.val() {
            self.loaded.d.next = self.loaded.q.val() + self.one_word.val();
            self.left.d.next = self.left.q.val() - self.one.val();
            self.is_last.d.next = self.left.q.val() == self.two.val();
            self.is_chosen.d.next = false;
        }
        if self.prepares.val() {
            self.following.d.next = 0.into();
        }
        if self.starts.val() {
            self.loaded.d.next = 0.into();
            self.left.d.next = self.length.val();
            self.is_last.d.next = self.length.val() == self.one.val();
        }
        if self.reset.val() {
            self.waited.d.next = false;
            self.is_chosen.d.next = false;
        }
    }
}
