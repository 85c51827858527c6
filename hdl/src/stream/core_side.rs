//! The core's side of the stream link.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock` | in | 1 | the core's clock |
//! | `core_reset` | out | 1 | reset of the core, and of the core's side of both FIFOs. A register |
//! | `command_valid`, `command_ready`, `command_data` | out, in, out | 1, 1, 32 | the command stream |
//! | `response_valid`, `response_ready`, `response_data`, `response_both`, `response_last` | in, out, in, in, in | 1, 1, 64, 1, 1 | the answer stream, as in `AnswerPairs` |
//! | `beat_valid`, `beat_data`, `takes`, `is_empty` | in, in, out, in | 1, W, 1, 1 | reader's side of the command FIFO |
//! | `entry_valid`, `entry`, `is_full`, `is_fetched` | out, out, in, in | 1, E, 1, 1 | writer's side of the answer FIFO; the highest bit of an entry marks the last beat of an answer |
//! | `request` | in | 1 | from the bus's clock, a register: reset |
//! | `reply`, `core_beat`, `core_busy` | out | 1 | to the bus's clock, each a register: in reset; changes while this clock runs; something is held or under way |
//!
//! 1. All is in the core's clock. What comes from the bus's clock goes into a `Synchroniser` and nowhere else.
//!
//! Latency: see the blocks.

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

use super::{AnswerBeats, AnswerPairs, BeatWords, Progress, ResetReply};
use crate::leaf::Synchroniser;

/// The core's side; see the top of this file.
#[derive(LogicBlock)]
pub struct CoreSide<const W: usize, const E: usize> {
    /// Clock of the core.
    pub clock: Signal<In, Clock>,
    /// Reset of the core.
    pub core_reset: Signal<Out, Bit>,
    /// A command word is offered.
    pub command_valid: Signal<Out, Bit>,
    /// It is taken.
    pub command_ready: Signal<In, Bit>,
    /// The word.
    pub command_data: Signal<Out, Bits<32>>,
    /// Answer words are offered.
    pub response_valid: Signal<In, Bit>,
    /// They are taken.
    pub response_ready: Signal<Out, Bit>,
    /// The words.
    pub response_data: Signal<In, Bits<64>>,
    /// There are two of them.
    pub response_both: Signal<In, Bit>,
    /// The last one of an answer is among them.
    pub response_last: Signal<In, Bit>,
    /// A command beat is there.
    pub beat_valid: Signal<In, Bit>,
    /// It.
    pub beat_data: Signal<In, Bits<W>>,
    /// It is taken.
    pub takes: Signal<Out, Bit>,
    /// None is there or on its way.
    pub is_empty: Signal<In, Bit>,
    /// An answer beat is offered.
    pub entry_valid: Signal<Out, Bit>,
    /// It, and whether it is the last of its answer.
    pub entry: Signal<Out, Bits<E>>,
    /// It is not taken.
    pub is_full: Signal<In, Bit>,
    /// All answer beats have been fetched.
    pub is_fetched: Signal<In, Bit>,
    /// From the bus's clock: reset.
    pub request: Signal<In, Bit>,
    /// To the bus's clock: in reset.
    pub reply: Signal<Out, Bit>,
    /// To the bus's clock: changes while this one runs.
    pub core_beat: Signal<Out, Bit>,
    /// To the bus's clock: something is held or under way.
    pub core_busy: Signal<Out, Bit>,
    words: BeatWords<W>,
    pairs: AnswerPairs,
    beats: AnswerBeats<W>,
    progress: Progress,
    resetting: ResetReply,
    request_seen: Synchroniser<Bit>,
    busy: DFF<Bit>,
    last_offered: Signal<Local, Bit>,
    wide_beat: Signal<Local, Bits<E>>,
    last_mark: Signal<Local, Bits<E>>,
    mark: Constant<Bits<E>>,
    no_mark: Constant<Bits<E>>,
}

impl<const W: usize, const E: usize> Default for CoreSide<W, E> {
    fn default() -> Self {
        assert!(E == W + 1, "a beat of {W} bits makes entries of {} bits, not {E}", W + 1);
        let one: Bits<E> = Bits::from(1);
        Self {
            clock: Signal::default(),
            core_reset: Signal::default(),
            command_valid: Signal::default(),
            command_ready: Signal::default(),
            command_data: Signal::default(),
            response_valid: Signal::default(),
            response_ready: Signal::default(),
            response_data: Signal::default(),
            response_both: Signal::default(),
            response_last: Signal::default(),
            beat_valid: Signal::default(),
            beat_data: Signal::default(),
            takes: Signal::default(),
            is_empty: Signal::default(),
            entry_valid: Signal::default(),
            entry: Signal::default(),
            is_full: Signal::default(),
            is_fetched: Signal::default(),
            request: Signal::default(),
            reply: Signal::default(),
            core_beat: Signal::default(),
            core_busy: Signal::default(),
            words: BeatWords::default(),
            pairs: AnswerPairs::default(),
            beats: AnswerBeats::default(),
            progress: Progress::default(),
            resetting: ResetReply::default(),
            request_seen: Synchroniser::default(),
            busy: DFF::default(),
            last_offered: Signal::default(),
            wide_beat: Signal::default(),
            last_mark: Signal::default(),
            mark: Constant::new(one << W as u64),
            no_mark: Constant::new(Bits::default()),
        }
    }
}

impl<const W: usize, const E: usize> Logic for CoreSide<W, E> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, busy);
        clock!(self, clock, words, pairs, beats, progress, resetting, request_seen);

        // Resets.
        self.request_seen.sent.next = self.request.val();
        self.resetting.request.next = self.request_seen.received.val();
        self.reply.next = self.resetting.reply.val();
        self.core_beat.next = self.resetting.beat.val();
        self.core_reset.next = self.resetting.resets.val();
        self.words.reset.next = self.resetting.resets.val();
        self.pairs.reset.next = self.resetting.resets.val();
        self.beats.reset.next = self.resetting.resets.val();
        self.progress.reset.next = self.resetting.resets.val();

        // Commands.
        self.words.beat_valid.next = self.beat_valid.val();
        self.words.beat_data.next = self.beat_data.val();
        self.takes.next = self.words.takes.val();
        self.command_valid.next = self.words.command_valid.val();
        self.command_data.next = self.words.command_data.val();
        self.words.command_ready.next = self.command_ready.val();

        // Answers.
        self.pairs.response_valid.next = self.response_valid.val();
        self.pairs.response_data.next = self.response_data.val();
        self.pairs.response_both.next = self.response_both.val();
        self.pairs.response_last.next = self.response_last.val();
        self.pairs.is_stalled.next = self.beats.is_stalled.val();
        self.response_ready.next = self.pairs.response_ready.val();
        self.beats.pair_valid.next = self.pairs.pair_valid.val();
        self.beats.pair_data.next = self.pairs.pair_data.val();
        self.beats.pair_last.next = self.pairs.pair_last.val();
        self.beats.is_full.next = self.is_full.val();
        self.wide_beat.next = bit_cast::<E, W>(self.beats.beat_data.val());
        self.last_mark.next = self.no_mark.val();
        if self.beats.beat_last.val() {
            self.last_mark.next = self.mark.val();
        }
        self.entry_valid.next = self.beats.beat_valid.val();
        self.entry.next = self.wide_beat.val() | self.last_mark.val();

        // What is under way.
        self.last_offered.next = self.response_valid.val() & self.response_last.val();
        self.progress.takes.next = self.words.command_valid.val() & self.command_ready.val();
        self.progress.word.next = self.words.command_data.val();
        self.progress.offers_last.next = self.last_offered.val();
        self.progress.ends.next = self.last_offered.val() & self.pairs.response_ready.val();
        self.busy.d.next = (!self.is_empty.val())
            | self.words.is_held.val()
            | self.progress.is_busy.val()
            | self.pairs.is_held.val()
            | self.beats.is_held.val()
            | (!self.is_fetched.val());
        self.core_busy.next = self.busy.q.val();
    }
}
