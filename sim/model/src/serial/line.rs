//! The line to the host: one frame after the other, encoded byte by byte.

use std::collections::VecDeque;

use incircle_protocol::FRAME_END;

use super::cobs::ReverseEncoder;
use crate::link::Crc32;

/// The sending side of the line.
#[derive(Clone, Debug, Default)]
pub struct SendingLine {
    encoded: VecDeque<u8>,
    encoder: ReverseEncoder,
    crc: Crc32,
    is_in_frame: bool,
}

impl SendingLine {
    /// The next byte of the line, if one is ready.
    pub fn give(&mut self) -> Option<u8> {
        self.encoded.pop_front()
    }

    /// Whether every byte that was added has been given.
    pub fn is_empty(&self) -> bool {
        self.encoded.is_empty()
    }

    /// Adds bytes to the current frame. The first bytes begin a frame.
    pub fn add(&mut self, bytes: &[u8]) {
        self.is_in_frame = true;
        for &byte in bytes {
            self.crc.add(byte);
            self.encoder.add(byte, |encoded| self.encoded.push_back(encoded));
        }
    }

    /// Adds the check sum, and ends the current frame.
    pub fn end(&mut self) {
        let crc = self.crc.value();
        self.add(&crc.to_le_bytes());
        self.encoded.extend([self.encoder.end(), FRAME_END]);
        self.crc = Crc32::default();
        self.is_in_frame = false;
    }

    /// Ends the current frame without a check sum, which makes it invalid. A complete frame stays.
    pub fn cut(&mut self) {
        if self.is_in_frame {
            self.encoder.end();
            self.encoded.push_back(FRAME_END);
            self.crc = Crc32::default();
            self.is_in_frame = false;
        }
    }
}
