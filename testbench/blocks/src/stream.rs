//! The blocks of the stream link, and the whole link.

use incircle_protocol::SMALL;

use crate::exported::{block, named};
use incircle_hdl::export::stream_link;
use incircle_hdl::leaf::{DualClockMemory, Synchroniser};
use incircle_hdl::stream::{
    AnswerBeats, AnswerPairs, AnswerWatch, AsyncFifo, BeatGate, BeatWords, CommandUnderWay, RegisterBlock,
    RegisterPort, ResetReply, ResetRequest,
};
use rust_hdl_core::prelude::*;

/// Name of the root module and Verilog of each block.
pub(crate) fn blocks() -> Vec<(String, String)> {
    let link = |name: &str, beat_bits| named(name, stream_link(SMALL, beat_bits, name));
    vec![
        block(Synchroniser::<Bit>::default(), "synchroniser_1"),
        block(Synchroniser::<Bits<10>>::default(), "synchroniser_10"),
        block(DualClockMemory::<8, 12>::new(8, 12), "dual_clock_memory_8x12"),
        block(DualClockMemory::<10, 36>::new(6, 33), "dual_clock_memory_6x33"),
        block(AsyncFifo::<3, 2>::new(), "stream_fifo_4x2"),
        block(AsyncFifo::<4, 8>::new(), "stream_fifo_8x8"),
        block(BeatGate::<8>::default(), "stream_beat_gate"),
        block(BeatWords::<64>::new(), "stream_beat_words_64"),
        block(BeatWords::<128>::new(), "stream_beat_words_128"),
        block(AnswerPairs::default(), "stream_answer_pairs"),
        block(AnswerBeats::<64>::new(), "stream_answer_beats_64"),
        block(AnswerBeats::<128>::new(), "stream_answer_beats_128"),
        block(AnswerWatch::<64>::default(), "stream_answer_watch"),
        block(CommandUnderWay::default(), "command_under_way"),
        block(ResetRequest::default(), "stream_reset_request"),
        block(ResetReply::new(), "stream_reset_reply"),
        block(RegisterPort::default(), "stream_register_port"),
        block(RegisterBlock::new(SMALL, 64), "stream_register_block"),
        link("stream_link_64", 64),
        link("stream_link_128", 128),
    ]
}
