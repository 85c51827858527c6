//! Receiving: what the host does with each frame of the device.

use std::time::Duration;

use incircle_protocol::{DeviceFrame, Layout, FIRST_RATE, STATUS_OPEN};

use super::{Polled, SerialProtocol, Stage};
use crate::transports::serial::codec::{Decoded, Message};
use crate::transports::serial::fault::SerialFault;
use crate::transports::serial::reader::Reader;
use crate::transports::serial::sender::Sender;
use crate::transports::words::words_of;

/// Frames of one kind that prove that the session is gone. A single one may have been on its way since before.
const PROOF: u32 = 2;

impl SerialProtocol {
    /// Takes bytes that came from the line.
    pub fn receive(&mut self, bytes: &[u8], now: Duration) {
        self.statistics.bytes_received += bytes.len() as u64;
        if let Stage::Connecting(connect) = &mut self.stage {
            connect.count(bytes.len());
        }
        let mut decoder = std::mem::take(&mut self.decoder);
        let mut rest = bytes;
        while !rest.is_empty() {
            let (taken, decoded) = decoder.take(rest);
            rest = &rest[taken..];
            match decoded {
                Decoded::Nothing => {}
                Decoded::Broken => self.statistics.frames_broken += 1,
                Decoded::Frame(message) => {
                    if let Err(fault) = self.hear(&message, now) {
                        self.fault.get_or_insert(fault);
                    }
                }
            }
        }
        self.decoder = decoder;
    }

    fn hear(&mut self, message: &Message<'_>, now: Duration) -> Result<(), SerialFault> {
        match &mut self.stage {
            Stage::Connecting(_) => self.hear_connecting(message, now),
            Stage::Open => self.hear_open(message, now),
            Stage::Searching { .. } if message.kind == DeviceFrame::Hello => Err(self.session_gone(message.session)),
            Stage::Idle | Stage::Searching { .. } => Ok(()),
            Stage::Closing { .. } => {
                // Both frames say that the session is over.
                if matches!(message.kind, DeviceFrame::Closed | DeviceFrame::NoSession) {
                    self.closed(now);
                }
                Ok(())
            }
        }
    }

    pub(super) fn closed(&mut self, now: Duration) {
        self.stage = Stage::Idle;
        self.set_rate(FIRST_RATE, now);
    }

    /// The fault of a device that has forgotten the session. `open` is the number of the session that it has, or 0.
    fn session_gone(&self, open: u8) -> SerialFault {
        if open != 0 && open != self.session {
            return SerialFault::Taken { session: open };
        }
        SerialFault::Reset { silence_ms: u32::try_from(self.silence.as_millis()).unwrap_or(u32::MAX) }
    }

    fn hear_connecting(&mut self, message: &Message<'_>, now: Duration) -> Result<(), SerialFault> {
        let Stage::Connecting(connect) = &mut self.stage else { return Ok(()) };
        let is_opened = connect.hear(message, now, &mut self.line)?;
        self.greeting = connect.greeting().copied();
        self.silence = connect.silence();
        self.session = connect.session();
        let (is_done, is_greeted, has_session) = (connect.is_done(), connect.only_greets(), connect.has_session());
        if is_opened {
            self.begin_session();
        }
        // A frame that comes before the session is open belongs to an earlier session, and tells nothing of this one.
        if has_session && message.session == self.session && message.kind != DeviceFrame::Hello {
            self.take_header(message, now)?;
        }
        if is_done {
            self.stage = if is_greeted { Stage::Idle } else { Stage::Open };
            (self.last_heard, self.last_said) = (now, now);
            if let Some(command) = self.queued.take() {
                self.reader.begin(&command, &mut self.sender)?;
            }
        }
        Ok(())
    }

    /// Starts a session with a new sender and a new reader, since the device has forgotten everything.
    fn begin_session(&mut self) {
        self.resent_before += self.sender.resent();
        self.repeated_before += self.reader.repeated();
        let identity = self.greeting.map(|greeting| greeting.identity);
        // A session opens only after a checked greeting, so the default is never used.
        let layout = identity.map_or(Layout { point_words: 1, record_words: 3 }, |identity| {
            Layout::of(identity.coord_bits, identity.capacity)
        });
        self.sender = Sender::new();
        self.reader = Reader::new(layout);
        (self.polled, self.without_session, self.foreign) = (None, 0, 0);
    }

    fn hear_open(&mut self, message: &Message<'_>, now: Duration) -> Result<(), SerialFault> {
        if message.session != self.session {
            return self.hear_foreign(message);
        }
        self.last_heard = now;
        (self.without_session, self.foreign) = (0, 0);
        let is_current = self.take_header(message, now)?;
        if matches!(message.kind, DeviceFrame::Answer | DeviceFrame::AnswerEnd) {
            let Some(part) = message.answer() else { return Ok(()) };
            if self.reader.take(&part, &mut self.sender)? {
                self.trips.shorten();
            }
        }
        if is_current {
            self.reader.passed(message.answers, &mut self.sender)?;
            match message.kind {
                DeviceFrame::Nak => self.go_back_once(now),
                DeviceFrame::Ack => self.hear_polled(now),
                _ => {}
            }
        }
        Ok(())
    }

    fn hear_foreign(&mut self, message: &Message<'_>) -> Result<(), SerialFault> {
        let counter = match message.kind {
            DeviceFrame::NoSession => &mut self.without_session,
            _ if message.status & STATUS_OPEN != 0 && message.session != 0 => &mut self.foreign,
            _ => return Ok(()),
        };
        *counter += 1;
        if *counter >= PROOF {
            return Err(self.session_gone(message.session));
        }
        Ok(())
    }

    /// Takes the header that every frame of the session has. Returns false if the header is not up to date.
    fn take_header(&mut self, message: &Message<'_>, now: Duration) -> Result<bool, SerialFault> {
        let fifo = self.greeting.map_or(0, |greeting| greeting.fifo_bytes);
        let free = u32::from(message.free);
        // A FIFO may be larger than the field can tell; then no claim is refused.
        if free > fifo {
            return Err(SerialFault::Credit { free, fifo });
        }
        let digest = match message.kind {
            DeviceFrame::Ack | DeviceFrame::Nak => words_of(message.body).next(),
            _ => None,
        };
        let Some(news) = self.sender.acknowledge(message.expected, usize::from(message.free), digest)? else {
            return Ok(false);
        };
        if news.taken > 0 {
            self.trips.shorten();
        }
        if let Some(left_at) = news.left_at {
            self.trips.measured(now.saturating_sub(left_at));
        }
        Ok(true)
    }

    /// Takes a `Nak`, which says that a frame is missing, and sends again from that frame on. A `Nak` that was on its
    /// way before the frame was sent again is ignored.
    fn go_back_once(&mut self, now: Duration) {
        let is_old = self.sender.first_was_repeated()
            && self.sender.first_left_at().is_some_and(|left_at| now < left_at + self.trips.mean() * 3 / 4);
        if !is_old {
            self.sender.go_back();
        }
        self.polled = None;
    }

    /// Takes the `Ack` to a `Poll`: frames that were out before the `Poll` and have not been taken are lost.
    fn hear_polled(&mut self, now: Duration) {
        let Some(Polled { base, cut, .. }) = self.polled.filter(|polled| now >= polled.left_at) else { return };
        self.polled = None;
        if self.sender.base() == base && base < cut {
            self.sender.go_back();
        }
    }
}
