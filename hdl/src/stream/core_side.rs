//! The half of the stream link in the clock of the core: beats become command words, and answer words become beats.
//!
//! 1. All is in the core's clock. A signal from the bus's clock goes into a `Synchroniser` and nowhere else.

use super::answer_beats::AnswerBeats;
use super::answer_pairs::AnswerPairs;
use super::beat_words::BeatWords;
use super::command_under_way::CommandUnderWay;
use super::reset_reply::ResetReply;
use crate::commands::{AnswerSink, CommandSource};
use crate::leaf::{Parameter, Synchroniser};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct CoreSide<const W: usize, const E: usize> {
    /// The clock of the core.
    pub clock: Signal<In, Clock>,
    /// Reset of the core and of the core's side of both FIFOs; a register.
    pub core_reset: Signal<Out, Bit>,
    pub command: CommandSource,
    pub response: AnswerSink,
    /// The device holds words of commands, or owes answers, that do not show in the streams.
    pub device_busy: Signal<In, Bit>,
    /// The reader's side of the command FIFO.
    pub beat_valid: Signal<In, Bit>,
    pub beat_data: Signal<In, Bits<W>>,
    pub takes: Signal<Out, Bit>,
    pub is_empty: Signal<In, Bit>,
    /// The writer's side of the answer FIFO; the highest bit of an entry marks the last beat of an answer.
    pub entry_valid: Signal<Out, Bit>,
    pub entry: Signal<Out, Bits<E>>,
    pub is_full: Signal<In, Bit>,
    pub is_fetched: Signal<In, Bit>,
    /// The bus wants a reset; a register in the bus's clock.
    pub request: Signal<In, Bit>,
    /// Three registers for the bus's clock: this side is in reset; `core_beat` toggles while this clock runs; this side
    /// holds words or is at work.
    pub reply: Signal<Out, Bit>,
    pub core_beat: Signal<Out, Bit>,
    pub core_busy: Signal<Out, Bit>,
    words: BeatWords<W>,
    pairs: AnswerPairs,
    beats: AnswerBeats<W>,
    under_way: CommandUnderWay,
    resetting: ResetReply,
    request_seen: Synchroniser<Bit>,
    busy: DFF<Bit>,
    last_offered: Signal<Local, Bit>,
    wide_beat: Signal<Local, Bits<E>>,
    last_mark: Signal<Local, Bits<E>>,
    mark: Parameter<Bits<E>>,
}

impl<const W: usize, const E: usize> CoreSide<W, E> {
    /// The core's half of a link with beats of W bits.
    ///
    /// # Panics
    /// If E is not W + 1, or W not 64 or 128.
    pub fn new() -> Self {
        assert!(E == W + 1, "a beat of {W} bits makes entries of {} bits, not {E}", W + 1);
        let one: Bits<E> = Bits::from(1);
        Self {
            words: BeatWords::new(),
            beats: AnswerBeats::new(),
            resetting: ResetReply::new(),
            mark: Parameter::new(one << W as u64),
            ..Self::default()
        }
    }
}

impl<const W: usize, const E: usize> Logic for CoreSide<W, E> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, busy);
        clock!(self, clock, words, pairs, beats, under_way, resetting, request_seen);

        // The link's blocks share the core's reset, so that none of them keeps part of a command or answer
        // that the core forgets.
        self.request_seen.sent.next = self.request.val();
        self.resetting.request.next = self.request_seen.received.val();
        self.reply.next = self.resetting.reply.val();
        self.core_beat.next = self.resetting.beat.val();
        self.core_reset.next = self.resetting.resets.val();
        self.words.reset.next = self.resetting.resets.val();
        self.pairs.reset.next = self.resetting.resets.val();
        self.beats.reset.next = self.resetting.resets.val();
        self.under_way.reset.next = self.resetting.resets.val();

        self.words.beat_valid.next = self.beat_valid.val();
        self.words.beat_data.next = self.beat_data.val();
        self.takes.next = self.words.takes.val();
        CommandSource::link(&mut self.command, &mut self.words.command);

        AnswerSink::link(&mut self.response, &mut self.pairs.response);
        self.pairs.is_stalled.next = self.beats.is_stalled.val();
        self.beats.pair_valid.next = self.pairs.pair_valid.val();
        self.beats.pair_data.next = self.pairs.pair_data.val();
        self.beats.pair_last.next = self.pairs.pair_last.val();
        self.beats.is_full.next = self.is_full.val();
        self.wide_beat.next = bit_cast::<E, W>(self.beats.beat_data.val());
        self.last_mark.next = 0.into();
        if self.beats.beat_last.val() {
            self.last_mark.next = self.mark.val();
        }
        self.entry_valid.next = self.beats.beat_valid.val();
        self.entry.next = self.wide_beat.val() | self.last_mark.val();

        // Each place that can hold a word counts: the host takes a link that is not busy to be empty.
        self.last_offered.next = self.response.valid.val() & self.response.last.val();
        self.under_way.takes.next = self.command.valid.val() & self.command.ready.val();
        self.under_way.word.next = self.command.data.val();
        self.under_way.offers_last.next = self.last_offered.val();
        self.under_way.ends.next = self.last_offered.val() & self.response.ready.val();
        self.busy.d.next = (!self.is_empty.val())
            | self.words.is_held.val()
            | self.under_way.is_busy.val()
            | self.device_busy.val()
            | self.pairs.is_held.val()
            | self.beats.is_held.val()
            | (!self.is_fetched.val());
        self.core_busy.next = self.busy.q.val();
    }
}
