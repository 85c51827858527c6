//! The serial link: the blocks that carry the core's two streams of words over a UART in frames, with credits,
//! check sums and sessions.
//!
//! `protocol/SERIAL.md`, "Frames", describes a frame byte by byte.
//!
//! ```text
//! in:  UartReceiver -> CobsDecoder -> FrameReader -> FrameJudge
//! out: FrameChoice -> FrameSender -> FrameHeader, FrameBytes, FramePart -> CobsEncoder -> UartTransmitter
//! ```

mod answer_packer;
mod bit_clock;
mod cobs_decoder;
mod cobs_encoder;
mod command_progress;
mod command_words;
mod crc32;
mod frame_bytes;
mod frame_choice;
mod frame_header;
mod frame_judge;
mod frame_part;
mod frame_reader;
mod frame_sender;
mod greeting;
mod line_timers;
mod link_receiver;
mod link_transmitter;
mod payload_digest;
mod rate_control;
mod receive_fifo;
mod replies;
mod serial_link;
mod session_state;
pub mod types;
mod uart_receiver;
mod uart_transmitter;
mod word_narrower;

pub use answer_packer::{AnswerPacker, PackState};
pub use bit_clock::BitClock;
pub use cobs_decoder::CobsDecoder;
pub use cobs_encoder::{CobsEncoder, EncodeState};
pub use command_progress::CommandProgress;
pub use command_words::CommandWords;
pub use crc32::Crc32;
pub use frame_bytes::FrameBytes;
pub use frame_choice::FrameChoice;
pub use frame_header::FrameHeader;
pub use frame_judge::{Asked, FrameJudge};
pub use frame_part::FramePart;
pub use frame_reader::{FrameReader, ReadState};
pub use frame_sender::{FrameSender, SendState};
pub use greeting::Greeting;
pub use line_timers::LineTimers;
pub use link_receiver::LinkReceiver;
pub use link_transmitter::LinkTransmitter;
pub use payload_digest::PayloadDigest;
pub use rate_control::RateControl;
pub use receive_fifo::ReceiveFifo;
pub use replies::Replies;
pub use serial_link::{SerialError, SerialLink};
pub use session_state::SessionState;
pub use uart_receiver::{ReceiveState, UartReceiver};
pub use uart_transmitter::UartTransmitter;
pub use word_narrower::WordNarrower;
