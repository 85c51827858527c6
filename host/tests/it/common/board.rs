//! A board at the other end of a serial line, in virtual time, around the software model. The board is written from the
//! page of the link alone, with a codec of its own, so that it shares no mistake with the library.

use std::collections::VecDeque;
use std::time::Duration;

use incircle_model::CommandModel;
use incircle_protocol::{CORE_RUNS, FEATURES_SHIFT, FEATURE_RUNS, FEATURE_SHORT_IDS};

pub const CLOCK: u32 = 125_000_000;
pub const CAPACITY: u32 = 8192;
const FIRST_RATE: u32 = 115_200;

/// CRC-32 of Ethernet, bit by bit.
pub fn crc32(bytes: &[u8]) -> u32 {
    crc32_more(0, bytes)
}

/// Continues a check sum with more bytes.
pub fn crc32_more(crc: u32, bytes: &[u8]) -> u32 {
    let mut crc = !crc;
    for &byte in bytes {
        crc ^= u32::from(byte);
        for _ in 0..8 {
            crc = crc >> 1 ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 };
        }
    }
    !crc
}

/// Decodes a frame to the device; `None` if its last piece is cut short.
pub fn cobs_decode(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut plain = Vec::new();
    let mut left = 0;
    let mut was_full = true;
    for &byte in bytes {
        if left == 0 {
            if !was_full {
                plain.push(0);
            }
            left = byte.checked_sub(1)?;
            was_full = byte == 255;
        } else {
            plain.push(byte);
            left -= 1;
        }
    }
    (left == 0).then_some(plain)
}

/// Encodes a frame to the host as it is on the line.
pub fn frame(plain: &[u8]) -> Vec<u8> {
    let crc = crc32(plain).to_le_bytes();
    let mut coded = Vec::new();
    let mut since = 0;
    for &byte in plain.iter().chain(&crc) {
        if byte == 0 {
            coded.push(since + 1);
            since = 0;
        } else {
            coded.push(byte);
            since += 1;
            if since == 254 {
                coded.push(255);
                since = 0;
            }
        }
    }
    coded.extend([since + 1, 0]);
    coded
}

/// The words of the greeting of a sound device.
pub fn greeting(fifo: u32) -> [u32; 13] {
    let ring = 2 << 16 | 32;
    [0x696e_436c, 1 << 16, CLOCK, fifo, CLOCK / 8, 2000, 0x696e_4369, 2 << 16, 3 << 8, 16, CAPACITY, 1 << 8 | 1, ring]
}

/// The core of a board with these runs.
fn core(runs: u32) -> CommandModel {
    let core = CommandModel::new(16, CAPACITY, 32).expect("a model");
    match runs {
        FEATURE_RUNS => core.with_runs(),
        CORE_RUNS => core.with_core_runs(),
        _ => core,
    }
}

/// A board with its end of the serial link.
pub struct Board {
    pub greeting: [u32; 13],
    pub rate: u32,
    pub session: u8,
    /// Highest rate at which the line works, in bits per second.
    pub usable: u32,
    /// Bytes that the core takes in a millisecond.
    pub appetite: usize,
    /// Number of frames taken.
    pub taken: usize,
    /// Number of frames refused for want of room. A sound host causes none.
    pub overflows: usize,
    /// Bits that are flipped in the check sums of payload and answers.
    pub lies: [u32; 2],
    /// The runs of the core: none, those of [`CORE_RUNS`], or with [`FEATURE_RUNS`] all.
    runs: u32,
    core: CommandModel,
    fifo: VecDeque<u8>,
    input: Vec<u8>,
    expected: u8,
    answers: u8,
    digest: u32,
    has_nacked: bool,
    was_dropped: bool,
    bad_rate: bool,
    /// Frames that are due, in the order `Hello`, `Opened`, `Closed`, `NoSession`, `Ack`, `Nak`.
    due: [bool; 6],
    new_rate: Option<u32>,
    /// Words of an answer that the core has not given to its end.
    coming: Vec<u32>,
    /// Answers that are not sent to their end.
    answer: VecDeque<Vec<u32>>,
    /// Words of the first answer that are sent.
    out: usize,
    heard: Duration,
    ate: Duration,
}

const HELLO: usize = 0;
const OPENED: usize = 1;
const CLOSED: usize = 2;
const NO_SESSION: usize = 3;
const ACK: usize = 4;
const NAK: usize = 5;

impl Board {
    pub fn new(fifo: u32) -> Self {
        Self {
            greeting: greeting(fifo),
            rate: FIRST_RATE,
            session: 0,
            usable: u32::MAX,
            appetite: 1 << 20,
            taken: 0,
            overflows: 0,
            lies: [0, 0],
            runs: 0,
            core: core(0),
            fifo: VecDeque::new(),
            input: Vec::new(),
            expected: 0,
            answers: 0,
            digest: 0,
            has_nacked: false,
            was_dropped: false,
            bad_rate: false,
            due: [false; 6],
            new_rate: None,
            coming: Vec::new(),
            answer: VecDeque::new(),
            out: 0,
            heard: Duration::ZERO,
            ate: Duration::ZERO,
        }
    }

    /// The same board with these runs, [`CORE_RUNS`] or [`FEATURE_RUNS`].
    pub fn with_runs(mut self, runs: u32) -> Self {
        self.greeting[12] = (FEATURE_SHORT_IDS | runs) << FEATURES_SHIFT | 32;
        Self { runs, core: core(runs), ..self }
    }

    /// Resets the board.
    pub fn reset(&mut self) {
        self.forget();
        self.session = 0;
        self.rate = FIRST_RATE;
        self.due = [false; 6];
        self.new_rate = None;
    }

    fn forget(&mut self) {
        self.core = core(self.runs);
        self.fifo.clear();
        self.coming.clear();
        self.answer.clear();
        (self.expected, self.answers, self.digest, self.out) = (0, 0, 0, 0);
        (self.has_nacked, self.bad_rate) = (false, false);
    }

    pub fn take(&mut self, bytes: &[u8], now: Duration) {
        for &byte in bytes {
            if byte != 0 {
                self.input.push(byte);
                continue;
            }
            let coded = std::mem::take(&mut self.input);
            if coded.is_empty() {
                continue;
            }
            let frame = cobs_decode(&coded).filter(|frame| frame.len() >= 9 && frame.len() <= 5 + 1024 + 4);
            let sound = frame.filter(|frame| {
                let (head, crc) = frame.split_at(frame.len() - 4);
                let length = usize::from(head[3]) | usize::from(head[4]) << 8;
                crc32(head).to_le_bytes() == crc && head.len() == 5 + length
            });
            match sound {
                None => self.was_dropped = true,
                Some(frame) => self.hear(&frame[..frame.len() - 4], now),
            }
        }
    }

    fn hear(&mut self, frame: &[u8], now: Duration) {
        self.heard = now;
        let (session, kind, number, payload) = (frame[0], frame[1], frame[2], &frame[5..]);
        match kind {
            1 => return self.due[HELLO] = true,
            2 => {
                self.forget();
                self.session = session;
                self.due = [false; 6];
                return self.due[OPENED] = true;
            }
            _ if self.session == 0 => return self.due[NO_SESSION] = true,
            _ if self.session != session => return,
            _ => {}
        }
        match kind {
            3 => {
                let step = u32::from_le_bytes(payload.try_into().expect("four bytes"));
                self.bad_rate = step == 0 || step > 1 << 21;
                if !self.bad_rate {
                    let rate = (u64::from(step) * u64::from(CLOCK) + (1 << 23)) >> 24;
                    self.new_rate = Some(rate as u32);
                }
                self.due[ACK] = true;
            }
            4 => self.due[if self.has_nacked { NAK } else { ACK }] = true,
            5 => self.take_data(number, payload),
            6 => {
                self.due[CLOSED] = true;
                self.new_rate = Some(FIRST_RATE);
            }
            other => panic!("the host sent a frame of type {other}"),
        }
    }

    fn take_data(&mut self, number: u8, payload: &[u8]) {
        assert!(payload.len() >= 4 && payload.len().is_multiple_of(4), "{}", payload.len());
        let ahead = number.wrapping_sub(self.expected);
        if ahead >= 128 {
            self.due[ACK] = true;
        } else if ahead > 0 || self.free() < payload.len() {
            self.overflows += usize::from(ahead == 0);
            if !self.has_nacked {
                self.due[NAK] = true;
            }
            self.has_nacked = true;
        } else {
            self.taken += 1;
            self.fifo.extend(payload);
            self.digest = crc32_more(self.digest, payload);
            self.expected = self.expected.wrapping_add(1);
            self.has_nacked = false;
            self.due[NAK] = false;
            self.due[ACK] = true;
        }
    }

    fn free(&self) -> usize {
        self.greeting[3] as usize - self.fifo.len()
    }

    /// Lets time pass up to `now`.
    pub fn tick(&mut self, now: Duration) {
        if now.saturating_sub(self.heard) > Duration::from_millis(u64::from(self.greeting[5])) {
            if self.session != 0 || self.rate != FIRST_RATE {
                self.reset();
            }
            self.heard = now;
        }
        let room = (self.appetite as u128 * (now - self.ate).as_micros() / 1000) as usize;
        let bytes = room.min(self.fifo.len()) & !3;
        if bytes > 0 || self.fifo.is_empty() {
            self.ate = now;
        }
        let eaten: Vec<u8> = self.fifo.drain(..bytes).collect();
        let words: Vec<u32> = eaten.chunks(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        self.core.send(&words);
        // The core gives parts of an answer to a run while it still takes items.
        let mut word = [0];
        while self.core.receive(&mut word) == 1 {
            self.coming.push(word[0]);
            if self.coming.len() >= 2 && self.coming.len() == 2 + self.coming[1] as usize {
                self.answer.push_back(std::mem::take(&mut self.coming));
            }
        }
    }

    pub fn is_eating(&self) -> bool {
        !self.fifo.is_empty()
    }

    /// The next frame as it is on the line.
    pub fn say(&mut self) -> Option<Vec<u8>> {
        const KINDS: [u8; 6] = [0x81, 0x82, 0x88, 0x87, 0x83, 0x84];
        let due = (0..6).find(|&kind| self.due[kind]);
        let free = self.free().min(65_535) as u16;
        let status = u8::from(self.session != 0)
            | u8::from(self.bad_rate) << 1
            | u8::from(self.was_dropped) << 2
            | u8::from(self.is_eating()) << 3;
        let head = |kind: u8, session: u8| {
            let [low, high] = free.to_le_bytes();
            vec![session, kind, self.expected, self.answers, low, high, status]
        };
        let mut plain;
        if let Some(kind) = due {
            plain = head(KINDS[kind], if kind == NO_SESSION { 0 } else { self.session });
            match kind {
                HELLO => plain.extend(self.greeting.iter().flat_map(|word| word.to_le_bytes())),
                ACK | NAK => plain.extend((self.digest ^ self.lies[0]).to_le_bytes()),
                _ => {}
            }
            self.due[kind] = false;
            if kind == CLOSED {
                self.session = 0;
                self.forget();
            }
        } else {
            let answer = self.answer.front()?;
            let words = &answer[self.out..answer.len().min(self.out + 256)];
            let is_end = self.out + words.len() == answer.len();
            plain = head(0x85 + u8::from(is_end), self.session);
            plain.push(self.answers);
            plain.extend((self.out as u16).to_le_bytes());
            plain.extend(words.iter().flat_map(|word| word.to_le_bytes()));
            self.out += words.len();
            if is_end {
                let all: Vec<u8> = answer.iter().flat_map(|word| word.to_le_bytes()).collect();
                plain.extend((crc32(&all) ^ self.lies[1]).to_le_bytes());
                self.answer.pop_front();
                self.out = 0;
                self.answers = self.answers.wrapping_add(1);
            }
        }
        self.was_dropped = false;
        Some(frame(&plain))
    }

    /// Hears that the frame is off the line, so that a change of rate that it acknowledged happens now.
    pub fn said(&mut self) {
        if !self.due.contains(&true) {
            if let Some(rate) = self.new_rate.take() {
                self.rate = rate;
                self.input.clear();
            }
        }
    }
}
