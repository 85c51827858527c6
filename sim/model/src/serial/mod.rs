//! The device's end of the serial link, byte by byte, as `protocol/SERIAL.md` describes it.
//!
//! Hardware twin: the blocks of `hdl/src/serial/`.
//!
//! [`SerialModel`] stands between a line of bytes and a [`WordDevice`]. The caller decides when bytes come and go and
//! when clocks pass, so the same model serves tests in virtual time and boards in real time. Bits are not modelled: a
//! caller that needs the duration of a byte asks for [`SerialModel::rate_step`]. The model shares nothing with the
//! hardware or with a host but the numbers of the protocol.
//!
//! ```
//! use incircle_model::serial::{FromDevice, FromHost, Instantly, SerialModel};
//! use incircle_protocol::{DeviceFrame, HostFrame, LinkConfig, SMALL};
//! let link = LinkConfig { clock_hz: 125_000_000, fifo_bytes: 4096, silence_ms: 2000 };
//! let core = Instantly::of(SMALL)?;
//! let mut board = SerialModel::new(link, core.identity(), core);
//! let hello = FromHost { session: 0, kind: HostFrame::Hello, number: 0, payload: vec![] };
//! hello.to_line().into_iter().for_each(|byte| board.take(byte));
//! let said: Vec<u8> = std::iter::from_fn(|| board.give()).collect();
//! let greeting = FromDevice::from_line(&said[..said.len() - 1]).unwrap();
//! assert_eq!(greeting.kind, DeviceFrame::Hello);
//! # Ok::<(), incircle_model::ModelError>(())
//! ```

pub mod cobs;
mod frame;
mod line;
mod session;
#[cfg(test)]
mod tests;

use incircle_protocol::{
    patience, rate_step, DeviceFrame, Greeting, HostFrame, Identity, LinkConfig, FIRST_RATE, LINK_MAGIC, LINK_VERSION,
    MAX_POINTS, MAX_STEP, STATUS_BAD_RATE, STATUS_BUSY, STATUS_DROPPED, STATUS_OPEN,
};

use crate::link::Taken;
use line::SendingLine;
use session::{Part, Session};

pub use crate::link::{core_identity, Crc32, Instantly, Passed, WordDevice};
pub use frame::{FrameReceiver, FromDevice, FromHost, Received};

/// The replies that must be sent, each once.
#[derive(Clone, Copy, Debug, Default)]
struct Due {
    hello: bool,
    opened: bool,
    closed: bool,
    no_session: bool,
    ack: bool,
    nak: bool,
}

/// The action that follows when the last byte of the current frame is given.
#[derive(Clone, Copy, Debug)]
enum Then {
    /// Nothing but the next frame.
    Nothing,
    /// The baud generator takes this step.
    Step(u32),
    /// The current answer ends.
    AnswerEnds,
}

/// A device behind its serial link.
#[derive(Debug)]
pub struct SerialModel<D> {
    link: LinkConfig,
    greeting: Greeting,
    core: D,
    receiver: FrameReceiver,
    session: Option<Session>,
    due: Due,
    was_bad_rate: bool,
    was_dropped: bool,
    /// Step of the baud generator that takes effect after the next `Ack`.
    new_step: Option<u32>,
    line: SendingLine,
    then: Then,
    /// The part of an answer that the current frame carries, with the number of words still to come.
    part: Option<Part>,
    step: u32,
    /// Number of clocks since the last valid frame.
    silent: u64,
}

impl<D: WordDevice> SerialModel<D> {
    /// A device that has just been reset. `identity` is the identity of the core.
    pub fn new(link: LinkConfig, identity: Identity, core: D) -> Self {
        let greeting = Greeting {
            magic: LINK_MAGIC,
            link_version: LINK_VERSION,
            clock_hz: link.clock_hz,
            fifo_bytes: link.fifo_bytes,
            max_rate: link.max_rate(),
            silence_ms: link.silence_ms,
            identity,
        };
        Self {
            link,
            greeting,
            core,
            receiver: FrameReceiver::new(),
            session: None,
            due: Due::default(),
            was_bad_rate: false,
            was_dropped: false,
            new_step: None,
            line: SendingLine::default(),
            then: Then::Nothing,
            part: None,
            step: first_step(link),
            silent: 0,
        }
    }

    /// The step of the baud generator, with which a bit takes `2^24 / step` clocks. Ask before [`SerialModel::give`]:
    /// the byte that `give` returns has this rate, even if it is the last at this rate.
    pub fn rate_step(&self) -> u32 {
        self.step
    }

    /// Number of the open session, or 0 if there is none.
    pub fn session(&self) -> u8 {
        self.session.as_ref().map_or(0, |session| session.number)
    }

    /// Whether the core is working on a command, or its answer has not been sent.
    pub fn is_busy(&self) -> bool {
        self.session.as_ref().is_some_and(|session| session.flow.is_busy() || session.flow.waiting_bytes() > 0)
    }

    /// Whether passing time changes nothing until a byte comes: no session, nothing to send, first rate.
    pub fn is_at_rest(&self) -> bool {
        let Due { hello, opened, closed, no_session, ack, nak } = self.due;
        let is_due = hello || opened || closed || no_session || ack || nak;
        self.session.is_none() && !is_due && self.line.is_empty() && self.step == first_step(self.link)
    }

    /// Lets this many clocks pass: the core works, and the silence grows longer.
    pub fn pass(&mut self, clocks: u64) {
        if let Some(session) = &mut self.session {
            session.flow.pass(&mut self.core, clocks);
        }
        self.silent = self.silent.saturating_add(clocks);
        if self.silent >= u64::from(self.link.clock_hz) * u64::from(self.link.silence_ms) / 1000 {
            self.silent = 0;
            self.forget_all();
        }
    }

    /// Reports a break: the line was low for a millisecond.
    pub fn break_line(&mut self) {
        self.receiver.spoil();
        self.forget_all();
    }

    /// Reports a symbol that was no byte because its stop bit was low. The frame that it belongs to becomes invalid.
    pub fn spoil(&mut self) {
        self.receiver.spoil();
    }

    /// Takes a byte from the line.
    pub fn take(&mut self, byte: u8) {
        match self.receiver.take(byte) {
            None | Some(Received::Nothing) => {}
            Some(Received::Frame(frame)) if frame.kind != HostFrame::Open || frame.session != 0 => {
                self.silent = 0;
                self.take_frame(frame);
            }
            Some(Received::Frame(_) | Received::Broken) => self.was_dropped = true,
        }
    }

    fn take_frame(&mut self, frame: FromHost) {
        match (frame.kind, &mut self.session) {
            (HostFrame::Hello, _) => self.due.hello = true,
            (HostFrame::Open, _) => {
                self.end_session();
                self.core.reset();
                let patience = patience(self.greeting.identity.capacity.min(MAX_POINTS));
                self.session = Some(Session::new(frame.session, u64::from(patience)));
                self.due.opened = true;
            }
            (_, None) => self.due.no_session = true,
            (_, Some(session)) if session.number != frame.session => {}
            (HostFrame::Poll, Some(session)) if session.flow.has_gap() => self.due.nak = true,
            (HostFrame::Poll, Some(_)) => self.due.ack = true,
            (HostFrame::Rate, Some(_)) => self.take_rate(&frame.payload),
            (HostFrame::Data, Some(session)) => {
                let is_room = session.flow.waiting_bytes() + frame.payload.len() <= self.link.fifo_bytes as usize;
                match session.take_data(&frame, is_room) {
                    Taken::Here => (self.due.ack, self.due.nak) = (true, false),
                    Taken::Before => self.due.ack = true,
                    Taken::NotYet => self.due.nak = true,
                    Taken::NotYetToldBefore => {}
                }
            }
            (HostFrame::Close, Some(_)) => {
                self.end_session();
                self.due.closed = true;
            }
        }
    }

    fn take_rate(&mut self, payload: &[u8]) {
        let step = payload.first_chunk().map_or(0, |bytes| u32::from_le_bytes(*bytes));
        self.was_bad_rate = !(1..=MAX_STEP).contains(&step);
        self.new_step = (!self.was_bad_rate).then_some(step);
        self.due.ack = true;
    }

    /// Ends the session. An answer that was sent in part stays incomplete.
    fn end_session(&mut self) {
        self.session = None;
        self.due = Due { hello: self.due.hello, ..Due::default() };
        (self.was_bad_rate, self.new_step) = (false, None);
        if self.part.take().is_some() {
            self.line.cut();
            self.then = Then::Nothing;
        }
    }

    /// Ends the session and returns to the first rate, after a silence or a break.
    fn forget_all(&mut self) {
        self.end_session();
        self.step = first_step(self.link);
        self.then = Then::Nothing;
    }

    /// The next byte for the host, if there is one now. The caller asks when the line is free.
    pub fn give(&mut self) -> Option<u8> {
        if self.line.is_empty() {
            self.go_on();
        }
        let byte = self.line.give();
        if byte.is_some() && self.line.is_empty() && self.part.is_none() {
            self.end_frame();
        }
        byte
    }

    /// Adds more of the current frame to the line, or begins the next frame.
    fn go_on(&mut self) {
        let Some(part) = &mut self.part else {
            return self.begin_frame();
        };
        let Some(session) = &mut self.session else {
            return;
        };
        if let Some(word) = session.flow.answers.take() {
            part.words -= 1;
            self.line.add(&word.to_le_bytes());
        }
        if part.words == 0 {
            if part.is_last {
                self.line.add(&session.flow.answers.crc().to_le_bytes());
                self.then = Then::AnswerEnds;
            }
            self.part = None;
            self.line.end();
        }
    }

    fn begin_frame(&mut self) {
        let due = &mut self.due;
        if std::mem::take(&mut due.hello) {
            let words = self.greeting.to_words();
            let body: Vec<u8> = words.into_iter().flat_map(u32::to_le_bytes).collect();
            self.send(DeviceFrame::Hello, &body);
        } else if std::mem::take(&mut due.opened) {
            self.send(DeviceFrame::Opened, &[]);
        } else if std::mem::take(&mut due.closed) {
            self.then = Then::Step(first_step(self.link));
            self.send(DeviceFrame::Closed, &[]);
        } else if std::mem::take(&mut due.no_session) {
            self.send(DeviceFrame::NoSession, &[]);
        } else if due.ack || due.nak {
            let kind = if due.nak { DeviceFrame::Nak } else { DeviceFrame::Ack };
            (due.ack, due.nak) = (false, false);
            self.then = self.new_step.take().map_or(Then::Nothing, Then::Step);
            let taken = self.session.as_ref().map_or(0, |session| session.flow.taken());
            self.send(kind, &taken.to_le_bytes());
        } else if let Some(part) = self.session.as_mut().and_then(Session::begin_part) {
            let kind = if part.is_last { DeviceFrame::AnswerEnd } else { DeviceFrame::Answer };
            let header = self.header(kind);
            self.line.add(&header);
            self.line.add(&part.header);
            self.part = Some(part);
        }
    }

    /// Adds a whole frame to the line.
    fn send(&mut self, kind: DeviceFrame, body: &[u8]) {
        let header = self.header(kind);
        self.line.add(&header);
        self.line.add(body);
        self.line.end();
    }

    /// The header of a frame. The report of a dropped frame is sent once, so building a header clears it.
    fn header(&mut self, kind: DeviceFrame) -> [u8; incircle_protocol::DEVICE_HEADER_BYTES] {
        let session = self.session.as_ref();
        let waiting = session.map_or(0, |session| session.flow.waiting_bytes() as u32);
        let flags = [
            (session.is_some(), STATUS_OPEN),
            (self.was_bad_rate, STATUS_BAD_RATE),
            (std::mem::take(&mut self.was_dropped), STATUS_DROPPED),
            (session.is_some_and(|session| session.flow.is_busy()), STATUS_BUSY),
        ];
        let frame = FromDevice {
            session: session.map_or(0, |session| session.number),
            kind,
            expected: session.map_or(0, |session| session.expected),
            answers: session.map_or(0, |session| session.flow.answers.sent() as u8),
            free: (self.link.fifo_bytes.saturating_sub(waiting)).min(u32::from(u16::MAX)) as u16,
            status: flags.iter().filter(|(is_set, _)| *is_set).map(|(_, bit)| bit).sum(),
            body: Vec::new(),
        };
        frame.header()
    }

    /// Acts on the end of a frame, whose last byte has been given.
    fn end_frame(&mut self) {
        match (std::mem::replace(&mut self.then, Then::Nothing), &mut self.session) {
            (Then::Step(step), _) => self.step = step,
            (Then::AnswerEnds, Some(session)) => {
                session.flow.end_answer();
            }
            _ => {}
        }
    }
}

/// The step of the baud generator after reset. A clock too slow for the first rate gets the largest step.
fn first_step(link: LinkConfig) -> u32 {
    rate_step(FIRST_RATE, link.clock_hz).unwrap_or(MAX_STEP)
}
