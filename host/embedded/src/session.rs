//! A session with the device: commands go out in `Data` frames, one at a time, and answers come back.
//!
//! Of the rules of `protocol/SERIAL.md` this host uses the smallest part that is complete. One `Data` frame is under
//! way at a time, so going back means to send that frame again, from the caller's points. One command is under way at a
//! time, whose answer fits a frame.

use embedded_io::{Read, ReadReady, Write};
use incircle_protocol::{
    answer_head, Command, DeviceFrame, Greeting, HostFrame, Layout, ANSWER_HEADER_BYTES, ANSWER_HEAD_WORDS, CRC_BYTES,
    MAX_PAYLOAD,
};

use crate::clock::{has_come, Clock};
use crate::crc::Crc32;
use crate::error::{Error, Fault};
use crate::frame::{word_at, Header};
use crate::line::Line;
use crate::load::Request;

/// Fewest bytes of payload to which noise makes frames shrink.
const MIN_SIZE: usize = 64;
/// Bytes of payload of the first frames: a noisy line loses few of them, and on a clean line they soon grow.
const FIRST_SIZE: usize = 256;
/// Frames or ranges in a row without a loss after which the next ones grow.
pub(crate) const GROW_AFTER: u32 = 4;
/// Milliseconds that an acknowledgement may take beyond the time of its frame on the line.
const ACK_SLACK: u32 = 40;
/// Bytes that pass the line in a millisecond, rounded down.
const BYTES_A_MS: u32 = 11;
/// Milliseconds between two questions for room in the FIFO.
const ROOM_EVERY: u32 = 20;
/// Most milliseconds between two `Poll` frames while an answer is awaited.
const POLL_EVERY: u32 = 500;
/// Milliseconds beyond the silence of the device after which it counts as lost.
const LOST_SLACK: u32 = 1000;
/// Frames in a row that say that the session is over: fewer may be left from before it began.
const STRANGE: u32 = 3;
/// Most words of payload of an answer whose words come in one frame.
pub(crate) const MAX_ANSWER_WORDS: usize = MAX_PAYLOAD / 4 - ANSWER_HEAD_WORDS;

/// The time that a job may take.
#[derive(Clone, Copy)]
pub(crate) struct Limit {
    pub since: u32,
    pub milliseconds: u32,
}

impl Limit {
    /// # Errors
    /// [`Error::Timeout`] when the time is over.
    pub fn check<E>(self, now: u32) -> Result<(), Error<E>> {
        if now.wrapping_sub(self.since) < self.milliseconds {
            return Ok(());
        }
        Err(Error::Timeout { milliseconds: self.milliseconds })
    }
}

/// The host's end of an open session.
pub(crate) struct Session<'l, P, C> {
    pub(crate) line: &'l mut Line<P, C>,
    pub(crate) number: u8,
    silence_ms: u32,
    fifo: u32,
    layout: Layout,
    limit: Limit,
    /// Number of the `Data` frame that the device expects next.
    base: u8,
    /// Free bytes of the device's FIFO.
    free: usize,
    /// Check sum over all payload that the device has taken.
    digest: Crc32,
    /// Number of the next answer.
    answer: u8,
    /// Bytes of payload of the next frames.
    size: usize,
    /// Frames taken since the last loss or growth.
    clean: u32,
    /// Time of the last frame of this session.
    heard: u32,
    /// Frames in a row that say that the session is over.
    strange: u32,
    /// Number of the session in the last of them.
    other: u8,
}

impl<'l, P: Read + ReadReady + Write, C: Clock> Session<'l, P, C> {
    /// A session that the device has just opened.
    pub fn new(line: &'l mut Line<P, C>, number: u8, greeting: &Greeting, limit: Limit, free: u16) -> Self {
        let heard = line.now();
        Self {
            line,
            number,
            silence_ms: greeting.silence_ms,
            fifo: greeting.fifo_bytes,
            layout: Layout::of(greeting.identity.coord_bits, greeting.identity.capacity),
            limit,
            base: 0,
            free: usize::from(free),
            digest: Crc32::new(),
            answer: 0,
            size: FIRST_SIZE,
            clean: 0,
            heard,
            strange: 0,
            other: 0,
        }
    }

    /// Sends a command, and returns the payload of its answer. A command whose answer is lost is asked again.
    pub fn ask(&mut self, request: Request<'_>) -> Result<&[u8], Error<P::Error>> {
        let mut has_answer = self.ask_once(request)?;
        while !has_answer {
            has_answer = self.ask_once(request.again())?;
        }
        Ok(self.payload())
    }

    /// Sends a command, and awaits its answer, all of which but the payload is then known to be right. Returns false if
    /// the answer is lost.
    pub fn ask_once(&mut self, request: Request<'_>) -> Result<bool, Error<P::Error>> {
        self.send_all(request)?;
        self.await_answer(request.command)
    }

    /// The payload of the last answer.
    pub fn payload(&self) -> &[u8] {
        let words = ANSWER_HEADER_BYTES + 4 * ANSWER_HEAD_WORDS;
        let body = self.line.body();
        let end = body.len().saturating_sub(CRC_BYTES);
        body.get(words..end).unwrap_or_default()
    }

    /// Ends the session. A device that does not hear of it forgets the session by itself.
    pub fn close(mut self) -> Result<(), Error<P::Error>> {
        self.line.say(self.number, HostFrame::Close)?;
        let until = self.after(ACK_SLACK);
        while let Some(header) = self.line.hear(until)? {
            if header.kind == DeviceFrame::Closed || has_come(until, self.line.now()) {
                break;
            }
        }
        Ok(())
    }

    /// The moment that is `milliseconds` from now.
    pub(crate) fn after(&mut self, milliseconds: u32) -> u32 {
        self.line.now().wrapping_add(milliseconds)
    }

    fn poll_every(&self) -> u32 {
        POLL_EVERY.min(self.silence_ms / 4)
    }

    pub(crate) fn say_poll(&mut self) -> Result<(), Error<P::Error>> {
        self.line.say(self.number, HostFrame::Poll)
    }

    fn send_all(&mut self, request: Request<'_>) -> Result<(), Error<P::Error>> {
        let (mut sent, length) = (0, 4 * request.words());
        while sent < length {
            let end = sent + self.await_room(length - sent)?;
            while !self.send(request, sent, end)? {
                self.clean = 0;
                self.size = (self.size / 2).max(MIN_SIZE);
            }
            self.clean += 1;
            if self.clean >= GROW_AFTER {
                self.clean = 0;
                self.size = (2 * self.size).min(MAX_PAYLOAD);
            }
            sent = end;
        }
        Ok(())
    }

    /// Waits until the FIFO has room for a frame, and returns the bytes of payload of that frame.
    fn await_room(&mut self, rest: usize) -> Result<usize, Error<P::Error>> {
        let wanted = rest.min(self.size);
        loop {
            if wanted <= self.free {
                return Ok(wanted);
            }
            if self.free >= MIN_SIZE {
                return Ok(self.free & !3);
            }
            self.say_poll()?;
            let until = self.after(ROOM_EVERY);
            self.hear(until)?;
        }
    }

    /// Sends a frame with these bytes of a command. Returns false if the device has not taken it.
    fn send(&mut self, request: Request<'_>, start: usize, end: usize) -> Result<bool, Error<P::Error>> {
        let bytes = (start..end).map(|place| request.byte(place));
        self.line.send(self.number, HostFrame::Data, self.base, bytes.clone())?;
        let mut digest = self.digest;
        bytes.for_each(|byte| digest.add(byte));
        let mut has_polled = false;
        let mut until = self.after(ACK_SLACK + (end - start) as u32 / BYTES_A_MS);
        loop {
            let Some(header) = self.hear(until)? else {
                self.say_poll()?;
                has_polled = true;
                until = self.after(self.poll_every().min(2 * ACK_SLACK));
                continue;
            };
            if let Some(is_taken) = self.judge(header, digest, has_polled)? {
                return Ok(is_taken);
            }
        }
    }

    /// Whether a frame from the device says that it has taken the `Data` frame under way; `None` if it says neither.
    /// With the `Data` frame, the payload of the session has the check sum `digest`.
    fn judge(&mut self, header: Header, digest: Crc32, has_polled: bool) -> Result<Option<bool>, Fault> {
        let is_ack = header.kind == DeviceFrame::Ack;
        let is_nak = header.kind == DeviceFrame::Nak;
        match header.expected.wrapping_sub(self.base) {
            0 if is_ack || is_nak => {
                self.check_digest(self.digest)?;
                // An `Ack` to a `Poll` that went behind the frame says that the frame is lost.
                Ok((is_nak || has_polled).then_some(false))
            }
            1 => {
                if is_ack || is_nak {
                    self.check_digest(digest)?;
                } else {
                    self.line.hear_again();
                }
                (self.digest, self.base) = (digest, header.expected);
                Ok(Some(true))
            }
            _ => Ok(None),
        }
    }

    /// Compares the check sum that the last frame reports with this one.
    fn check_digest(&self, digest: Crc32) -> Result<(), Fault> {
        let expected = digest.value();
        match word_at(self.line.body(), 0) {
            Some(found) if found != expected => Err(Fault::PayloadDigest { found, expected }),
            _ => Ok(()),
        }
    }

    /// Waits for the answer to a command, and checks all of it but the payload. Returns false if the answer is lost.
    fn await_answer(&mut self, command: Command<()>) -> Result<bool, Error<P::Error>> {
        let mut until = self.after(self.poll_every().min(2 * ACK_SLACK));
        loop {
            let Some(header) = self.hear(until)? else {
                self.say_poll()?;
                until = self.after(self.poll_every());
                continue;
            };
            let is_answer = matches!(header.kind, DeviceFrame::Answer | DeviceFrame::AnswerEnd);
            if is_answer && self.line.body().first() == Some(&self.answer) {
                self.answer = self.answer.wrapping_add(1);
                self.check_answer(header.kind, command)?;
                return Ok(true);
            }
            if header.answers == self.answer.wrapping_add(1) {
                self.answer = header.answers;
                return Ok(false);
            }
        }
    }

    fn check_answer(&self, kind: DeviceFrame, command: Command<()>) -> Result<(), Fault> {
        let opcode = command.opcode();
        let expected = command.payload_words(self.layout) as u32;
        let words = self.line.body().get(ANSWER_HEADER_BYTES..).unwrap_or_default();
        let wrong_length = |found| Fault::AnswerLength { opcode: opcode as u8, found, expected };
        let Some((words, announced)) = words.split_last_chunk::<CRC_BYTES>() else {
            return Err(wrong_length(0));
        };
        let (found, announced) = (Crc32::of(words), u32::from_le_bytes(*announced));
        if kind == DeviceFrame::AnswerEnd && found != announced {
            return Err(Fault::AnswerDigest { found, expected: announced });
        }
        let [header, length] = answer_head(opcode, expected);
        let (said, count) = (word_at(words, 0).unwrap_or(0), word_at(words, 1).unwrap_or(0));
        // The low half names the engine and the job.
        if said >> 16 != header >> 16 {
            return Err(Fault::Status { opcode: opcode as u8, header: said });
        }
        let came = (words.len() / 4).saturating_sub(ANSWER_HEAD_WORDS);
        if kind != DeviceFrame::AnswerEnd || count != length || came != expected as usize || words.len() % 4 != 0 {
            return Err(wrong_length(if count == length { came as u32 } else { count }));
        }
        Ok(())
    }

    /// Waits for the next frame of this session; `None` if there is none by this moment.
    pub(crate) fn hear(&mut self, until: u32) -> Result<Option<Header>, Error<P::Error>> {
        loop {
            let heard = self.line.hear(until)?;
            let now = self.line.now();
            self.limit.check(now)?;
            let Some(header) = heard else {
                let milliseconds = now.wrapping_sub(self.heard);
                if has_come(self.heard.wrapping_add(self.silence_ms + LOST_SLACK), now) {
                    return Err(if self.strange > 0 { self.over() } else { Error::Lost { milliseconds } });
                }
                return Ok(None);
            };
            if header.session != self.number {
                self.take_strange(header)?;
                continue;
            }
            let free = u32::from(header.free);
            if free > self.fifo {
                return Err(Fault::Credit { free, fifo: self.fifo }.into());
            }
            (self.heard, self.strange, self.free) = (now, 0, usize::from(header.free));
            return Ok(Some(header));
        }
    }

    fn take_strange(&mut self, header: Header) -> Result<(), Error<P::Error>> {
        self.strange += 1;
        self.other = header.session;
        if self.strange < STRANGE {
            return Ok(());
        }
        Err(self.over())
    }

    /// The reason why the session is over.
    fn over(&self) -> Error<P::Error> {
        match self.other {
            0 => Error::Reset { silence_ms: self.silence_ms },
            session => Error::Taken { session },
        }
    }
}
