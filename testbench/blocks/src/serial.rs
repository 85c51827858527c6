//! The blocks of the serial link, and the whole link.

use incircle_protocol::SMALL;

use crate::exported::{block, named};
use crate::links::{HASTY_LINK, QUICK_LINK};
use incircle_hdl::export::serial_link;
use incircle_hdl::serial::{
    AnswerPacker, BitClock, CobsDecoder, CobsEncoder, CommandProgress, CommandWords, Crc32, FrameBytes, FrameChoice,
    FrameHeader, FrameJudge, FramePart, FrameReader, FrameSender, Greeting, LineTimers, PayloadDigest, RateControl,
    ReceiveFifo, Replies, SessionState, UartReceiver, UartTransmitter, WordNarrower,
};

/// Name of the root module and Verilog of each block.
pub(crate) fn blocks() -> Vec<(String, String)> {
    let link = |name: &str| named(name, serial_link(SMALL, QUICK_LINK, name));
    vec![
        block(BitClock::at_ends(), "serial_bit_ends"),
        block(BitClock::in_middles(), "serial_bit_middles"),
        block(UartReceiver::new(), "serial_uart_receiver"),
        block(UartTransmitter::new(), "serial_uart_transmitter"),
        block(Crc32::default(), "serial_crc32"),
        block(CobsDecoder::default(), "serial_cobs_decoder"),
        block(CobsEncoder::default(), "serial_cobs_encoder"),
        block(FrameReader::default(), "serial_frame_reader"),
        block(FrameJudge::default(), "serial_frame_judge"),
        block(SessionState::default(), "serial_session_state"),
        block(Replies::default(), "serial_replies"),
        block(ReceiveFifo::<8>::new(QUICK_LINK.fifo_bytes), "serial_receive_fifo"),
        block(PayloadDigest::default(), "serial_payload_digest"),
        block(CommandWords::default(), "serial_command_words"),
        block(CommandProgress::default(), "serial_command_progress"),
        block(WordNarrower::default(), "serial_word_narrower"),
        block(AnswerPacker::default(), "serial_answer_packer"),
        block(FrameChoice::default(), "serial_frame_choice"),
        block(FramePart::default(), "serial_frame_part"),
        block(FrameSender::default(), "serial_frame_sender"),
        block(FrameHeader::default(), "serial_frame_header"),
        block(FrameBytes::default(), "serial_frame_bytes"),
        block(Greeting::new(SMALL, QUICK_LINK), "serial_greeting"),
        block(RateControl::new(QUICK_LINK), "serial_rate_control"),
        block(LineTimers::new(HASTY_LINK), "serial_line_timers"),
        link("serial_link"),
    ]
}
