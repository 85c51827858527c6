//! The host's side of a serial link in plain code: check sum, framing, frames, and the line bit by bit.

use std::collections::VecDeque;

/// The check sum of Ethernet and zip, computed one bit at a time.
pub fn crc32(bytes: &[u8]) -> u32 {
    !crc32_state(bytes)
}

/// State of the check sum before its final complement.
pub fn crc32_state(bytes: &[u8]) -> u32 {
    bytes.iter().fold(u32::MAX, |state, byte| {
        (0..8).fold(
            state ^ u32::from(*byte),
            |state, _| {
                if state & 1 == 1 {
                    state >> 1 ^ 0xedb8_8320
                } else {
                    state >> 1
                }
            },
        )
    })
}

/// Encodes bytes in COBS, with the zero behind them.
pub fn cobs(bytes: &[u8]) -> Vec<u8> {
    let mut encoded = Vec::new();
    let mut pieces = bytes.split(|byte| *byte == 0).peekable();
    while let Some(mut piece) = pieces.next() {
        while piece.len() > 254 || piece.len() == 254 && pieces.peek().is_some() {
            encoded.push(255);
            encoded.extend(&piece[..254]);
            piece = &piece[254..];
        }
        encoded.push(piece.len() as u8 + 1);
        encoded.extend(piece);
    }
    encoded.push(0);
    encoded
}

/// Decodes bytes from reverse COBS, without the zero behind them; `None` if they are no frame.
pub fn from_reverse_cobs(mut encoded: &[u8]) -> Option<Vec<u8>> {
    let mut reversed = Vec::new();
    let mut owes_zero = false;
    while let Some((&length, before)) = encoded.split_last() {
        let bytes = before.len().checked_sub(usize::from(length) - 1)?;
        if owes_zero && length != 255 {
            reversed.push(0);
        }
        reversed.extend(before[bytes..].iter().rev());
        encoded = &before[..bytes];
        owes_zero = true;
    }
    reversed.reverse();
    Some(reversed)
}

/// Encodes bytes in reverse COBS, with the zero behind them.
pub fn reverse_cobs(bytes: &[u8]) -> Vec<u8> {
    let mut encoded = Vec::new();
    let mut length = 1;
    for byte in bytes {
        encoded.push(if *byte == 0 { length } else { *byte });
        length = if *byte == 0 { 1 } else { length + 1 };
        if length == 255 {
            encoded.push(255);
            length = 1;
        }
    }
    encoded.extend([length, 0]);
    encoded
}

/// Bytes of a frame to the device before they are encoded.
pub fn host_frame(session: u8, kind: u8, number: u8, payload: &[u8]) -> Vec<u8> {
    let [low, high] = (payload.len() as u16).to_le_bytes();
    let mut bytes = [&[session, kind, number, low, high], payload].concat();
    bytes.extend(crc32(&bytes).to_le_bytes());
    bytes
}

/// A frame from the device, as the host heard it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Heard {
    pub session: u8,
    pub kind: u8,
    pub expected: u8,
    pub answers: u8,
    pub free: u16,
    pub status: u8,
    pub body: Vec<u8>,
}

impl Heard {
    /// Decodes a frame, without the zero behind it; `None` if the bytes are no sound frame.
    pub fn parse(encoded: &[u8]) -> Option<Self> {
        let bytes = from_reverse_cobs(encoded)?;
        let (covered, sum) = bytes.split_last_chunk::<4>()?;
        let [session, kind, expected, answers, low, high, status, body @ ..] = covered else { return None };
        (u32::from_le_bytes(*sum) == crc32(covered)).then(|| Self {
            session: *session,
            kind: *kind,
            expected: *expected,
            answers: *answers,
            free: u16::from_le_bytes([*low, *high]),
            status: *status,
            body: body.to_vec(),
        })
    }

    /// The body as words.
    pub fn words(&self) -> Vec<u32> {
        self.body.chunks(4).map(|bytes| u32::from_le_bytes(bytes.try_into().expect("whole words"))).collect()
    }
}

/// Puts bits onto a line; each takes a number of clocks that need not be whole.
pub struct Talker {
    pub clocks_per_bit: f64,
    bits: VecDeque<bool>,
    /// Clocks left of the bit on the line.
    left: f64,
    level: bool,
}

impl Talker {
    pub fn new(clocks_per_bit: f64) -> Self {
        Self { clocks_per_bit, bits: VecDeque::new(), left: 0.0, level: true }
    }

    pub fn say(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.bits.push_back(false);
            self.bits.extend((0..8).map(|bit| byte >> bit & 1 == 1));
            self.bits.push_back(true);
        }
    }

    /// Holds this level for the given number of bits.
    pub fn hold(&mut self, level: bool, bits: usize) {
        self.bits.extend(std::iter::repeat_n(level, bits));
    }

    pub fn is_silent(&self) -> bool {
        self.bits.is_empty() && self.left <= 0.0
    }

    /// Level of the line in the next clock.
    pub fn clock(&mut self) -> bool {
        if self.left <= 0.0 {
            match self.bits.pop_front() {
                Some(level) => {
                    self.level = level;
                    self.left += self.clocks_per_bit;
                }
                None => {
                    self.level = true;
                    self.left = 0.0;
                    return true;
                }
            }
        }
        self.left -= 1.0;
        self.level
    }
}

/// Takes bytes from a line, which it samples in the middle of bits.
pub struct Listener {
    pub clocks_per_bit: f64,
    /// Clocks since the start bit began.
    since: Option<f64>,
    bits: Vec<bool>,
    /// Bytes that have come.
    pub bytes: Vec<u8>,
    /// Number of bytes without a stop bit.
    pub faults: usize,
}

impl Listener {
    pub fn new(clocks_per_bit: f64) -> Self {
        Self { clocks_per_bit, since: None, bits: Vec::new(), bytes: Vec::new(), faults: 0 }
    }

    /// Takes the level of the line in this clock.
    pub fn clock(&mut self, level: bool) {
        let since = match self.since {
            None if level => return,
            None => 0.0,
            Some(since) => since + 1.0,
        };
        self.since = Some(since);
        if since < self.clocks_per_bit * (self.bits.len() as f64 + 0.5) {
            return;
        }
        self.bits.push(level);
        if self.bits.len() == 10 {
            let byte = self.bits[1..9].iter().rev().fold(0, |byte, bit| byte << 1 | u8::from(*bit));
            if self.bits[0] || !self.bits[9] {
                self.faults += 1;
            } else {
                self.bytes.push(byte);
            }
            self.bits.clear();
            self.since = None;
        }
    }

    /// Returns the frames that have come whole; broken ones are left out.
    pub fn frames(&mut self) -> Vec<Heard> {
        let mut frames = Vec::new();
        while let Some(end) = self.bytes.iter().position(|byte| *byte == 0) {
            let encoded: Vec<u8> = self.bytes.drain(..=end).collect();
            frames.extend(Heard::parse(&encoded[..end]));
        }
        frames
    }
}
