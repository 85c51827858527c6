//! The way from the core to the Ethernet port: answers and receipts, their headers and check sums, bytes.
//!
//! 1. The header of a datagram says what was true when the datagram began.
//! 2. A datagram begins only when the port has room for all of it, so no byte of it waits for the port. The port sends
//!    it when its last byte has come. So a datagram may wait for words of the core.
//! 3. The end of a session drops that session's datagram under way.
//!
//! ```text
//! asks -> DatagramReplies --------------+-> FrameChoice -> DatagramParts -> DatagramBytes -> DatagramSums -> bytes
//! answers -> WordNarrower -> AnswerParts -+                    | DatagramHeader -^
//! ```

use super::answer_parts::AnswerParts;
use super::datagram_bytes::DatagramBytes;
use super::datagram_header::DatagramHeader;
use super::datagram_parts::DatagramParts;
use super::datagram_replies::DatagramReplies;
use super::datagram_sums::DatagramSums;
use super::types::{DatagramAsks, DatagramState, HeadIndex};
use crate::prelude::*;
use crate::serial::types::Byte;
use crate::serial::{FrameChoice, WordNarrower};
use incircle_protocol::{Config, UdpLinkConfig};

#[derive(LogicBlock, Default)]
pub struct UdpTransmitter {
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The request of the last datagram of a host; `saw_gap` says that a gap came before it.
    pub asks: Signal<In, DatagramAsks>,
    pub saw_gap: Signal<In, Bit>,
    pub state: Signal<In, DatagramState>,
    /// The answers of the session are void (`forgets`); no datagram may begin (`holds`).
    pub forgets: Signal<In, Bit>,
    pub holds: Signal<In, Bit>,
    pub place_is_taken: Signal<Out, Bit>,
    /// A byte of the addresses and the session of a question, or of the open session.
    pub reads_question: Signal<Out, Bit>,
    pub read_index: Signal<Out, HeadIndex>,
    pub read_data: Signal<In, Byte>,
    /// The datagram with the last word of an answer has ended.
    pub answer_ended: Signal<Out, Bit>,
    /// The answer stream of the core.
    pub response_valid: Signal<In, Bit>,
    pub response_ready: Signal<Out, Bit>,
    pub response_data: Signal<In, Bits<64>>,
    pub response_both: Signal<In, Bit>,
    /// The bytes for the port, which is ready for a whole datagram while `byte_ready` is high. With `byte_drops` it
    /// forgets the bytes of a datagram that has not ended.
    pub byte_valid: Signal<Out, Bit>,
    pub byte_ready: Signal<In, Bit>,
    pub byte_data: Signal<Out, Byte>,
    pub byte_is_last: Signal<Out, Bit>,
    pub byte_drops: Signal<Out, Bit>,
    replies: DatagramReplies,
    narrower: WordNarrower,
    packer: AnswerParts,
    choice: FrameChoice,
    parts: DatagramParts,
    header: DatagramHeader,
    bytes: DatagramBytes,
    sums: DatagramSums,
    is_over: Signal<Local, Bit>,
    is_end: Signal<Local, Bit>,
    place: Signal<Local, Bits<7>>,
    words_part: Signal<Local, Bits<3>>,
}

impl UdpTransmitter {
    /// The transmitter of a core behind a link whose parameters are in range.
    pub fn new(config: Config, link: UdpLinkConfig) -> Self {
        Self { bytes: DatagramBytes::new(config, link), ..Self::default() }
    }

    /// The transmitter of a core with runs behind a link whose parameters are in range.
    pub fn with_runs(config: Config, link: UdpLinkConfig) -> Self {
        Self { bytes: DatagramBytes::with_runs(config, link), ..Self::default() }
    }
}

impl Logic for UdpTransmitter {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, replies, narrower, packer, choice, parts, header, bytes, sums);
        self.words_part.next = 4.into();
        self.is_over.next = self.forgets.val() | self.reset.val();

        // Only a reset clears the answer in the place: a `Closed` must still go out when its session is over.
        self.replies.reset.next = self.reset.val();
        self.replies.asks.next = self.asks.val();
        self.replies.saw_gap.next = self.saw_gap.val();
        self.replies.forgets.next = self.is_over.val();
        self.replies.starts.next = self.choice.starts_reply.val();
        self.replies.ended.next = self.parts.is_last.val();
        self.place_is_taken.next = self.replies.place_is_taken.val();
        self.choice.is_idle.next = self.parts.is_idle.val() & (!self.sums.is_busy.val()) & self.byte_ready.val();
        self.choice.reply_is_due.next = self.replies.is_due.val();
        self.choice.reply_kind.next = self.replies.kind.val();
        self.choice.answer_is_due.next = self.packer.is_due.val();
        self.choice.answer_is_last.next = self.packer.is_last.val();
        self.choice.holds.next = self.holds.val();
        self.choice.cuts.next = self.is_over.val();

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
        self.is_end.next = self.parts.is_last.val() & self.choice.contents.val().ends_answer;
        self.packer.ended.next = self.is_end.val();
        self.answer_ended.next = self.is_end.val();

        self.parts.reset.next = self.reset.val();
        self.parts.starts.next = self.choice.starts.val();
        self.parts.contents.next = self.choice.contents.val();
        self.parts.cuts.next = self.is_over.val() & (!self.replies.is_in_place.val());
        self.parts.word_byte_valid.next = self.packer.byte_valid.val();
        self.parts.word_byte_is_last.next = self.packer.byte_is_last.val();
        self.packer.takes.next = self.parts.moves.val() & (self.parts.at.val().part == self.words_part.val());

        self.place.next = self.parts.at.val().index;
        self.header.reset.next = self.reset.val();
        self.header.starts.next = self.choice.starts.val();
        self.header.state.next = self.state.val();
        self.header.drops.next = self.asks.val().drops;
        self.header.kind.next = self.choice.kind.val();
        self.header.index.next = self.place.val().get_bits::<3>(0);
        self.reads_question.next = self.replies.is_in_place.val();
        self.read_index.next = self.place.val().get_bits::<5>(0);
        self.bytes.at.next = self.parts.at.val();
        self.bytes.address_byte.next = self.read_data.val();
        self.bytes.header_byte.next = self.header.byte_data.val();
        self.bytes.digest.next = self.header.digest.val();
        self.bytes.answers.next = self.packer.answers.val();
        self.bytes.first_index.next = self.packer.first_index.val();
        self.bytes.word_byte.next = self.packer.byte_data.val();

        self.sums.reset.next = self.reset.val();
        self.sums.moves.next = self.parts.moves.val();
        self.sums.at.next = self.parts.at.val();
        self.sums.is_last.next = self.parts.is_last.val();
        self.sums.byte_data.next = self.bytes.byte_data.val();
        self.sums.awaits.next = self.packer.awaits.val();
        self.sums.is_cut.next = self.parts.is_cut.val();
        self.byte_valid.next = self.sums.out_valid.val();
        self.byte_data.next = self.sums.out_data.val();
        self.byte_is_last.next = self.sums.out_is_last.val();
        self.byte_drops.next = self.sums.out_drops.val();
    }
}
