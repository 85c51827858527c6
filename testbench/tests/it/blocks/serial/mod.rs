//! Tests of the blocks in `hdl/src/serial`.

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
mod payload_digest;
mod rate_control;
mod receive_fifo;
mod replies;
mod serial_link;
mod serial_link_faults;
mod session_state;
mod uart_receiver;
mod uart_transmitter;
mod word_narrower;
