//! Sends the payload of an answer that has no records: asks for one word after the other.
//!
//! 1. The choice of a word takes two ranks of registers, so `index` stays for two clocks before the word is taken.
//!    Blocks that need a clock more get the index one clock earlier, as `index_ahead`.
//!
//! Latency: 2 clocks to a beat, from `runs` or from the beat before.

use super::types::{AnswerBeat, Word, WordIndex};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct PayloadWords {
    pub clock: Signal<In, Clock>,
    /// A reset drops the word.
    pub reset: Signal<In, Bit>,
    /// An answer is about to begin (`prepares`); two clocks later it begins (`starts`) with a payload of `length`
    /// words, at most 255.
    pub prepares: Signal<In, Bit>,
    pub starts: Signal<In, Bit>,
    pub length: Signal<In, Word>,
    /// The payload is being sent.
    pub runs: Signal<In, Bit>,
    /// Index of the wanted word, and the value that the index takes at this edge if it changes.
    pub index: Signal<Out, WordIndex>,
    pub index_ahead: Signal<Out, WordIndex>,
    /// The word whose number was `index` a clock ago goes into a register at this edge, and is `word` from then on.
    pub chooses: Signal<Out, Bit>,
    pub word: Signal<In, Word>,
    /// A beat of one word; `takes` says that it is taken at this edge.
    pub valid: Signal<Out, Bit>,
    pub beat: Signal<Out, AnswerBeat>,
    pub takes: Signal<In, Bit>,
    loaded: DFF<WordIndex>,
    following: DFF<WordIndex>,
    left: DFF<Bits<8>>,
    /// One word of the payload is left.
    is_last: DFF<Bit>,
    /// The first of the two clocks in which a word is chosen has passed.
    waited: DFF<Bit>,
    is_chosen: DFF<Bit>,
    is_choosing: Signal<Local, Bit>,
    no_word: Signal<Local, Word>,
    words: Signal<Local, Bits<8>>,
    one: Signal<Local, Bits<8>>,
    two: Signal<Local, Bits<8>>,
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
        self.words.next = self.length.val().get_bits::<8>(0);
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
            self.left.d.next = self.words.val();
            self.is_last.d.next = self.words.val() == self.one.val();
        }
        if self.reset.val() {
            self.waited.d.next = false;
            self.is_chosen.d.next = false;
        }
    }
}
