//! The stream link: the blocks that connect the core's two streams of words to AXI4-Streams and AXI4-Lite registers in
//! the clock of a bus.

mod answer_beats;
mod answer_pairs;
mod answer_watch;
mod async_fifo;
mod axi;
mod beat_gate;
mod beat_words;
mod bus_side;
mod command_under_way;
mod core_side;
mod device_identity;
mod events;
mod register_block;
mod register_port;
mod reset_reply;
mod reset_request;
mod stream_link;
mod traffic;

pub use answer_beats::AnswerBeats;
pub use answer_pairs::AnswerPairs;
pub use answer_watch::AnswerWatch;
pub use async_fifo::AsyncFifo;
pub use axi::{Address, AxiLite, AxisSink, AxisSource, RegisterIndex};
pub use beat_gate::BeatGate;
pub use beat_words::BeatWords;
pub use bus_side::BusSide;
pub use command_under_way::CommandUnderWay;
pub use core_side::CoreSide;
pub use device_identity::DeviceIdentity;
pub use events::{AnswerEvents, CommandEvents};
pub use register_block::RegisterBlock;
pub use register_port::RegisterPort;
pub use reset_reply::ResetReply;
pub use reset_request::{ResetRequest, ResetState};
pub use stream_link::StreamLink;
pub use traffic::Traffic;
