//! The way from the line to the core: bytes, frames, payload, command words.
//!
//! 1. Payload enters the FIFO as it comes, and counts once its frame has turned out to be sound. A frame then needs no
//!    buffer of its own.
//!
//! ```text
//! rx -> UartReceiver -> CobsDecoder -> FrameReader -> FrameJudge -> asked
//!                                           +--> ReceiveFifo -> CommandWords -> commands
//!                                           +--> PayloadDigest
//! ```

use super::cobs_decoder::CobsDecoder;
use super::command_words::CommandWords;
use super::frame_judge::{Asked, FrameJudge};
use super::frame_reader::FrameReader;
use super::payload_digest::PayloadDigest;
use super::receive_fifo::ReceiveFifo;
use super::types::{Byte, Receipt, Session, Step};
use super::uart_receiver::UartReceiver;
use crate::commands::types::Word;
use crate::commands::CommandSource;
use incircle_protocol::LinkConfig;
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct LinkReceiver {
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// Rate of the line, and the line itself.
    pub step: Signal<In, Step>,
    pub rx: Signal<In, Bit>,
    pub open: Signal<In, Session>,
    /// Forget the payload: the FIFO, the digest and an unfinished word.
    pub forgets: Signal<In, Bit>,
    /// The request of the last frame, the session that the frame names, and the last four bytes of its payload.
    pub asked: Signal<Out, Asked>,
    pub named: Signal<Out, Byte>,
    pub value: Signal<Out, Word>,
    pub receipt: Signal<Out, Receipt>,
    /// The line is low at present.
    pub is_low: Signal<Out, Bit>,
    pub command: CommandSource,
    uart: UartReceiver,
    decoder: CobsDecoder,
    reader: FrameReader,
    judge: FrameJudge,
    fifo: ReceiveFifo<8>,
    payload_digest: PayloadDigest,
    words: CommandWords,
    pushes: Signal<Local, Bit>,
    clears: Signal<Local, Bit>,
}

impl LinkReceiver {
    /// The receiver of a link that has passed [`LinkConfig::check`].
    pub fn new(link: LinkConfig) -> Self {
        Self { uart: UartReceiver::new(), fifo: ReceiveFifo::new(link.fifo_bytes), ..Self::default() }
    }
}

impl Logic for LinkReceiver {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, uart, decoder, reader, judge, fifo, payload_digest, words);
        self.uart.reset.next = self.reset.val();
        self.uart.step.next = self.step.val();
        self.uart.rx.next = self.rx.val();
        self.is_low.next = self.uart.is_low.val();

        self.decoder.reset.next = self.reset.val();
        self.decoder.byte_valid.next = self.uart.byte_valid.val();
        self.decoder.byte_data.next = self.uart.byte_data.val();
        self.decoder.noise.next = self.uart.noise.val();

        self.reader.reset.next = self.reset.val();
        self.reader.data_valid.next = self.decoder.data_valid.val();
        self.reader.data.next = self.decoder.data.val();
        self.reader.frame_ends.next = self.decoder.frame_ends.val();
        self.reader.is_broken.next = self.decoder.is_broken.val();
        self.named.next = self.reader.head.val().session;
        self.value.next = self.reader.value.val();

        self.judge.reset.next = self.reset.val();
        self.judge.head.next = self.reader.head.val();
        self.judge.header_comes.next = self.reader.header_comes.val();
        self.judge.comes.next = self.reader.comes.val();
        self.judge.is_sound.next = self.reader.is_sound.val();
        self.judge.open.next = self.open.val();
        self.judge.free.next = self.fifo.room.val().free;
        self.asked.next = self.judge.asked.val();

        self.pushes.next = self.reader.payload_valid.val() & self.judge.takes_payload.val();
        self.clears.next = self.reset.val() | self.forgets.val();
        self.fifo.reset.next = self.clears.val();
        self.fifo.begins.next = self.reader.header_comes.val();
        self.fifo.push.next = self.pushes.val();
        self.fifo.push_data.next = self.reader.payload.val();
        self.fifo.commits.next = self.judge.asked.val().takes;
        self.receipt.next.free = self.fifo.room.val().free;
        self.payload_digest.reset.next = self.clears.val();
        self.payload_digest.begins.next = self.reader.header_comes.val();
        self.payload_digest.push.next = self.pushes.val();
        self.payload_digest.push_data.next = self.reader.payload.val();
        self.payload_digest.commits.next = self.judge.asked.val().takes;
        self.receipt.next.digest = self.payload_digest.state.val();

        self.words.reset.next = self.clears.val();
        self.words.byte_valid.next = self.fifo.entry_valid.val();
        self.words.byte_data.next = self.fifo.entry_data.val();
        self.fifo.takes.next = self.words.takes.val();
        self.command.valid.next = self.words.word_valid.val();
        self.command.data.next = self.words.word.val();
        self.words.word_ready.next = self.command.ready.val();
    }
}
