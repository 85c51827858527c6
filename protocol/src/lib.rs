//! The knowledge that the core and its host share: commands, answers, status codes, word layouts and limits.
//!
//! Host and core talk through two streams of 32-bit words. A command is one word, followed by its arguments. The answer
//! to every command is a header word, a word that counts the payload words, and the payload. `protocol/README.md`
//! describes the same in prose, with an example exchange.
//!
//! This crate has no dependencies, and no logic beyond packing and unpacking words and frames: a [`Command`] knows its
//! words and the length of its answer, but not what a device does with it. The crate needs neither the standard library
//! nor an allocator, so that it also serves microcontrollers.
#![no_std]

mod cobs;
mod command;
mod config;
mod counters;
mod datagram;
mod frame;
mod layout;
mod living;
mod opcode;
mod short_ids;
mod status;
mod stream;

pub use cobs::decode_reverse_cobs;
pub use command::{
    answer_engine, answer_head, answer_header, answer_opcode, answer_status, answer_tag, batch_word, clear_word,
    command_contexts, command_meshes, command_opcode, command_starts_batch, command_tag, command_word, signed_header,
    Clear, Command, CommandReader, Meshes, RecordRange, ANSWER_HEAD_WORDS, CLEAR_BATCH, CLEAR_MESHES_SHIFT,
    CLEAR_TAG_SHIFT, COMMAND_HEAD_WORDS, MAX_SIDE_BY_SIDE, PADDING,
};
pub use config::{
    patience, Config, ConfigError, DUAL, ENGINES, ENGINE_QUEUE_WORDS, FIRST_ROUND, FULL, LARGE, MAX_CONTEXTS,
    MAX_DELETE_RING, MAX_MODEL_POINTS, MAX_POINTS, MAX_RING, MIN_CONTEXTS, MIN_POINTS, MIN_RING, NAMED, QUAD, SMALL,
    TINY,
};
pub use counters::{latency_bucket, latency_of_bucket, Counter, COUNTER_WORDS, LATENCY_BITS, LATENCY_BUCKETS};
pub use datagram::{
    DeviceDatagram, DeviceHeader, HostDatagram, HostHeader, UdpGreeting, UdpLinkConfig, DATAGRAM_ANSWER_BYTES,
    DATAGRAM_HEADER_BYTES, MAX_DATAGRAM_WORDS, MAX_DEVICE_DATAGRAM, MAX_HOST_DATAGRAM, UDP_ANSWER_WORDS,
    UDP_GREETING_WORDS, UDP_KEPT_WORDS, UDP_LINK_MAGIC, UDP_LINK_VERSION, UDP_PORT,
};
pub use frame::{
    rate_step, DeviceFrame, Greeting, HostFrame, LinkConfig, LinkConfigError, ANSWER_HEADER_BYTES, BREAK_MS, CRC_BYTES,
    DEVICE_HEADER_BYTES, FIRST_RATE, FRAME_END, GREETING_WORDS, HOST_HEADER_BYTES, LINK_MAGIC, LINK_VERSION,
    MAX_DEVICE_FRAME, MAX_FIFO_BYTES, MAX_LINK_CLOCK_HZ, MAX_PAYLOAD, MAX_SILENCE_MS, MAX_STEP, MIN_FIFO_BYTES,
    MIN_LINK_CLOCK_HZ, PHASE_BITS, SILENCE_MS, STATUS_BAD_RATE, STATUS_BUSY, STATUS_DROPPED, STATUS_OPEN, WINDOW,
};
pub use layout::{
    Identity, InsertReport, Layout, ENGINES_SHIFT, FEATURES_SHIFT, IDENTITY_WORDS, INSERT_REPORT_WORDS, NARROW_ID_BITS,
};
pub use living::{
    part_head, part_item, part_outcome, Located, RunKind, CORE_RUNS, FEATURE_RUNS, ITEM_NUMBERS, OUTCOME_SHIFT,
};
pub use opcode::Opcode;
pub use short_ids::{ShortIds, FEATURE_SHORT_IDS, TRIANGLES_SHORT, TRIANGLES_TWELVE};
pub use status::{Outcome, Status};
pub use stream::{
    StreamRegister, BEAT_BITS, CONTROL_RESET, ERROR_ANSWER_STATUS, ERROR_PARTIAL_BEAT, REGISTER_SPACE,
    STREAM_FIFO_BEATS, STREAM_STATUS_BUSY, STREAM_STATUS_ERROR, STREAM_STATUS_RESETTING, STREAM_STATUS_RUNS,
    STREAM_VERSION,
};

/// First word of the identity: the letters `inCi`.
pub const MAGIC: u32 = 0x696e_4369;
/// Version of the protocol, `major << 16 | minor`.
pub const PROTOCOL_VERSION: u32 = 2 << 16;
/// The oldest version that a host still serves. Its devices have one engine, no tags and no [`Meshes::SideBySide`].
pub const OLDEST_PROTOCOL_VERSION: u32 = 1 << 16 | 2;
/// Bits of one coordinate in the core.
pub const CORE_COORD_BITS: u32 = 16;
/// Largest coordinate width that any device takes; only the software model goes beyond [`CORE_COORD_BITS`].
pub const MAX_COORD_BITS: u32 = 31;
/// Smallest coordinate width that any device takes.
pub const MIN_COORD_BITS: u32 = 1;

/// Number of triangle records that a device with a capacity of `points` has room for. A mesh of `n` points, three or
/// more, has exactly `2n - 2` records, ghost triangles included.
///
/// Reason: with the infinite vertex the mesh is a triangulated sphere of `n + 1` vertices, and by Euler's formula such
/// a sphere has `2(n + 1) - 4` faces.
pub const fn triangle_capacity(points: u32) -> u32 {
    2 * points
}

/// Bits of a vertex id for a capacity of `points`. The value of all ones is the infinite vertex.
pub const fn vertex_id_bits(points: u32) -> u32 {
    u32::BITS - points.leading_zeros()
}

/// Bits of a triangle id for a capacity of `points`.
pub const fn triangle_id_bits(points: u32) -> u32 {
    u32::BITS - (triangle_capacity(points) - 1).leading_zeros()
}

/// The infinite vertex for a capacity of `points`: all ones in the width of a vertex id.
pub const fn infinite_vertex(points: u32) -> u32 {
    (((1u64) << vertex_id_bits(points)) - 1) as u32
}

/// Version of the core, and of the model that predicts it: `major << 16 | minor << 8 | patch`.
pub const CORE_VERSION: u32 = 3 << 8;
