//! The way from the core to the line: answers and control frames, their headers and check sums, bytes.
//!
//! 1. The header of a frame says what was true when the frame began.
//!
//! ```text
//! asked -> Replies -----+-> FrameChoice -> FrameSender -> CobsEncoder -> UartTransmitter -> tx
//! answers -> WordNarrower -> AnswerPacker -+   | ^
//!    FrameHeader, Greeting, Crc32 -> FrameBytes -+
//! ```

use super::answer_packer::AnswerPacker;
use super::cobs_encoder::CobsEncoder;
use super::crc32::Crc32;
use super::frame_bytes::FrameBytes;
use super::frame_choice::FrameChoice;
use super::frame_header::FrameHeader;
use super::frame_judge::Asked;
use super::frame_sender::FrameSender;
use super::greeting::Greeting;
use super::replies::Replies;
use super::types::{Receipt, Session, Step};
use super::uart_transmitter::UartTransmitter;
use super::word_narrower::WordNarrower;
use crate::commands::types::Word;
use incircle_protocol::{Config, LinkConfig};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct LinkTransmitter {
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// Rate of the line, and the line itself.
    pub step: Signal<In, Step>,
    pub tx: Signal<Out, Bit>,
    /// The request of the host's last frame; `saw_gap` says that a gap came before it.
    pub asked: Signal<In, Asked>,
    pub saw_gap: Signal<In, Bit>,
    /// For the headers of frames to the host: the session, the receipt, and two bits of the status.
    pub open: Signal<In, Session>,
    pub receipt: Signal<In, Receipt>,
    pub is_refused: Signal<In, Bit>,
    pub is_busy: Signal<In, Bit>,
    /// The session ends at this edge (`fails`); its answers are void (`forgets`); no frame may begin (`holds`).
    pub fails: Signal<In, Bit>,
    pub forgets: Signal<In, Bit>,
    pub holds: Signal<In, Bit>,
    /// The control frame that begins at this edge is an `Ack` or `Nak` (`acknowledges`), or a `Closed` (`closes`).
    pub acknowledges: Signal<Out, Bit>,
    pub closes: Signal<Out, Bit>,
    /// No frame is under way, and the last stop bit has ended.
    pub is_quiet: Signal<Out, Bit>,
    /// The frame with the last word of an answer has ended.
    pub answer_ended: Signal<Out, Bit>,
    /// The answer stream of the core.
    pub response_valid: Signal<In, Bit>,
    pub response_ready: Signal<Out, Bit>,
    pub response_data: Signal<In, Bits<64>>,
    /// Bits 63 to 32 hold a second word, which follows the first.
    pub response_both: Signal<In, Bit>,
    replies: Replies,
    narrower: WordNarrower,
    packer: AnswerPacker,
    choice: FrameChoice,
    sender: FrameSender,
    header: FrameHeader,
    greeting: Greeting,
    bytes: FrameBytes,
    frame_sum: Crc32,
    answer_digest: Crc32,
    encoder: CobsEncoder,
    uart: UartTransmitter,
    is_over: Signal<Local, Bit>,
    first_state: Signal<Local, Word>,
}

const _: () = assert!(Crc32::FIRST == 0xffff_ffff, "the literal of this block follows the check sum");

impl LinkTransmitter {
    /// The transmitter of a core behind a link that has passed [`LinkConfig::check`].
    pub fn new(config: Config, link: LinkConfig) -> Self {
        Self { uart: UartTransmitter::new(), greeting: Greeting::new(config, link), ..Self::default() }
    }

    /// The transmitter of a core with runs behind a link that has passed [`LinkConfig::check`].
    pub fn with_runs(config: Config, link: LinkConfig) -> Self {
        Self { greeting: Greeting::with_runs(config, link), ..Self::new(config, link) }
    }
}

impl Logic for LinkTransmitter {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, replies, narrower, packer, choice, sender, header, greeting, bytes);
        clock!(self, clock, frame_sum, answer_digest, encoder, uart);
        self.first_state.next = 0xffff_ffffu64.into();
        self.is_over.next = self.forgets.val() | self.reset.val();

        // Only a reset clears the control frames: a `Closed` must still go out when its session is over.
        self.replies.reset.next = self.reset.val();
        self.replies.asked.next = self.asked.val();
        self.replies.saw_gap.next = self.saw_gap.val();
        self.replies.fails.next = self.fails.val();
        self.replies.starts.next = self.choice.starts_reply.val();
        self.choice.is_idle.next = self.sender.is_idle.val();
        self.choice.reply_is_due.next = self.replies.is_due.val();
        self.choice.reply_kind.next = self.replies.kind.val();
        self.choice.answer_is_due.next = self.packer.is_due.val();
        self.choice.answer_is_last.next = self.packer.is_last.val();
        self.choice.holds.next = self.holds.val();
        self.choice.cuts.next = self.is_over.val();
        self.acknowledges.next = self.choice.starts_reply.val() & self.replies.acknowledges.val();
        self.closes.next = self.choice.starts_reply.val() & self.replies.closes.val();

        // The end of a session empties the path of its answers, so that none of their words can reach the next session.
        self.packer.reset.next = self.is_over.val();
        self.narrower.reset.next = self.is_over.val();
        self.narrower.pair_valid.next = self.response_valid.val();
        self.narrower.pair.next = self.response_data.val();
        self.narrower.both.next = self.response_both.val();
        self.response_ready.next = self.narrower.pair_ready.val();
        self.packer.word_valid.next = self.narrower.word_valid.val();
        self.packer.word_data.next = self.narrower.word.val();
        self.narrower.word_ready.next = self.packer.word_ready.val();
        self.packer.starts.next = self.choice.starts_answer.val();
        self.packer.takes.next = self.sender.loads_word.val();
        self.packer.ended.next = self.sender.answer_ended.val();
        self.answer_ended.next = self.sender.answer_ended.val();
        self.answer_digest.sets.next = self.packer.awaits.val();
        self.answer_digest.start.next = self.first_state.val();
        self.answer_digest.takes.next = self.sender.loads_word.val();
        self.answer_digest.byte_data.next = self.bytes.byte_data.val();

        // Both check sums must have covered a byte before the sender loads the next, because words go into both.
        self.sender.reset.next = self.reset.val();
        self.sender.starts.next = self.choice.starts.val();
        self.sender.contents.next = self.choice.contents.val();
        self.sender.cuts.next = self.is_over.val();
        self.sender.byte_data.next = self.bytes.byte_data.val();
        self.sender.sum_is_busy.next = self.frame_sum.is_busy.val() | self.answer_digest.is_busy.val();
        self.sender.word_byte_valid.next = self.packer.byte_valid.val();
        self.sender.word_byte_is_last.next = self.packer.byte_is_last.val();
        self.frame_sum.sets.next = self.choice.starts.val();
        self.frame_sum.start.next = self.first_state.val();
        self.frame_sum.takes.next = self.sender.loads.val();
        self.frame_sum.byte_data.next = self.bytes.byte_data.val();

        // All sources see the place of the wanted byte at the same time; only `FrameBytes` knows which one counts.
        self.header.reset.next = self.reset.val();
        self.header.starts.next = self.choice.starts.val();
        self.header.open.next = self.open.val();
        self.header.answers.next = self.packer.answer.val().number;
        self.header.receipt.next = self.receipt.val();
        self.header.is_refused.next = self.is_refused.val();
        self.header.is_busy.next = self.is_busy.val();
        self.header.drops.next = self.asked.val().drops;
        self.header.kind.next = self.choice.kind.val();
        self.header.index.next = bit_cast::<3, 6>(self.sender.at.val().index);
        self.greeting.index.next = self.sender.at.val().index;
        self.bytes.part.next = self.sender.at.val().part;
        self.bytes.index.next = bit_cast::<2, 6>(self.sender.at.val().index);
        self.bytes.ends_answer.next = self.choice.contents.val().ends_answer;
        self.bytes.header.next = self.header.byte_data.val();
        self.bytes.greeting.next = self.greeting.byte_data.val();
        self.bytes.word.next = self.packer.byte_data.val();
        self.bytes.answer.next = self.packer.answer.val();
        self.bytes.payload_state.next = self.header.digest_taken.val();
        self.bytes.answer_state.next = self.answer_digest.state.val();
        self.bytes.sum_state.next = self.frame_sum.state.val();

        // The line is quiet only if both the sender and the UART are idle: the sender is done while the last byte is
        // still on its way.
        self.encoder.reset.next = self.reset.val();
        self.encoder.data_valid.next = self.sender.data_valid.val();
        self.encoder.data.next = self.sender.data.val();
        self.sender.data_ready.next = self.encoder.data_ready.val();
        self.encoder.ends.next = self.sender.ends.val();
        self.encoder.cuts.next = self.sender.is_cut.val();
        self.sender.ended.next = self.encoder.ended.val();
        self.uart.reset.next = self.reset.val();
        self.uart.step.next = self.step.val();
        self.uart.byte_valid.next = self.encoder.byte_valid.val();
        self.uart.byte_data.next = self.encoder.byte_data.val();
        self.encoder.byte_ready.next = self.uart.byte_ready.val();
        self.tx.next = self.uart.tx.val();
        self.is_quiet.next = self.sender.is_idle.val() & self.uart.is_idle.val();
    }
}
