//! Receiving: what the host does with each datagram of the device.

use std::time::Duration;

use incircle_protocol::{DeviceDatagram, Layout};

use super::{Stage, UdpProtocol};
use crate::transports::udp::codec::Message;
use crate::transports::udp::fault::UdpFault;
use crate::transports::udp::greeting::checked_greeting;
use crate::transports::udp::sender::Sender;

impl UdpProtocol {
    /// Takes a datagram that came from the address of the device.
    pub fn receive(&mut self, datagram: &[u8], now: Duration) {
        self.statistics.received += 1;
        let Some(message) = Message::decode(datagram) else {
            self.statistics.broken += 1;
            return;
        };
        if message.header.session != self.session {
            self.hear_old(&message, now);
            return;
        }
        if let Err(fault) = self.hear(&message, now) {
            self.fault.get_or_insert(fault);
        }
    }

    /// Hears that the device has ended the session before the one that is being opened. It answers one datagram at a
    /// time, so it may not have heard the `Open` that came behind the `Close`.
    fn hear_old(&mut self, message: &Message<'_>, now: Duration) {
        if let Stage::Opening { old, due, .. } = &mut self.stage {
            let has_ended = matches!(message.header.kind, DeviceDatagram::Closed | DeviceDatagram::NoSession);
            if has_ended && *old == Some(message.header.session) {
                (*old, *due) = (None, now);
            }
        }
    }

    fn hear(&mut self, message: &Message<'_>, now: Duration) -> Result<(), UdpFault> {
        let kind = message.header.kind;
        match &mut self.stage {
            Stage::Greeting { opens, .. } if kind == DeviceDatagram::Hello => {
                let opens = *opens;
                let greeting = checked_greeting(message)?;
                self.silence = Duration::from_millis(u64::from(greeting.silence_ms));
                self.greeting = Some(greeting);
                match opens {
                    true => self.open(now, None),
                    false => self.stage = Stage::Idle,
                }
            }
            Stage::Opening { .. } if kind == DeviceDatagram::Opened => {
                self.begin_session(now);
                self.take_header(message, now)?;
            }
            Stage::Opening { was_busy, .. } if kind == DeviceDatagram::Busy => *was_busy = true,
            Stage::Open => return self.hear_open(message, now),
            Stage::Closing { .. } if matches!(kind, DeviceDatagram::Closed | DeviceDatagram::NoSession) => {
                self.stage = Stage::Idle;
            }
            Stage::Idle | Stage::Greeting { .. } | Stage::Opening { .. } | Stage::Closing { .. } => {}
        }
        Ok(())
    }

    /// Starts a session with a new sender, since the device has forgotten everything.
    fn begin_session(&mut self, now: Duration) {
        self.resent_before += self.sender.resent();
        let identity = self.greeting.map(|greeting| greeting.identity);
        // A session opens only after a checked greeting, so the default is never used.
        let (layout, engines) = identity.map_or((Layout { point_words: 1, record_words: 3 }, 1), |identity| {
            (Layout::of(identity.coord_bits, identity.capacity), identity.engines)
        });
        self.sender = Sender::default();
        self.reader.begin_session(layout, engines);
        (self.polled, self.stage) = (None, Stage::Open);
        self.has_served = true;
        (self.last_heard, self.last_said) = (now, now);
        self.trips.shorten();
    }

    fn hear_open(&mut self, message: &Message<'_>, now: Duration) -> Result<(), UdpFault> {
        match message.header.kind {
            // The number of a session is random, so these can only be about this session, which is over.
            DeviceDatagram::NoSession | DeviceDatagram::Closed => {
                let silence_ms = u32::try_from(self.silence.as_millis()).unwrap_or(u32::MAX);
                return Err(UdpFault::Reset { silence_ms });
            }
            // A late `Busy` answers an `Open` that came before the one which opened this session.
            DeviceDatagram::Hello | DeviceDatagram::Busy => return Ok(()),
            _ => self.last_heard = now,
        }
        let is_current = self.take_header(message, now)?;
        let grace = self.grace();
        match message.header.kind {
            DeviceDatagram::Answer | DeviceDatagram::AnswerEnd => self.hear_answer(message)?,
            DeviceDatagram::Ack | DeviceDatagram::Nak => {
                if let Some(answers) = message.words().next() {
                    self.reader.passed(answers, &self.sender)?;
                }
            }
            _ => {}
        }
        self.reader.count(now, grace, true)?;
        if is_current {
            match message.header.kind {
                DeviceDatagram::Nak => self.go_back_once(now),
                DeviceDatagram::Ack => self.hear_polled(),
                _ => {}
            }
        }
        Ok(())
    }

    /// Takes the header that every datagram of the session has. Returns false if the header is not up to date.
    fn take_header(&mut self, message: &Message<'_>, now: Duration) -> Result<bool, UdpFault> {
        let header = &message.header;
        let fifo = self.greeting.map_or(0, |greeting| greeting.fifo_bytes);
        if u32::from(header.free) > fifo {
            return Err(UdpFault::Credit { free: u32::from(header.free), fifo });
        }
        let digest = match header.kind {
            DeviceDatagram::Ack | DeviceDatagram::Nak => message.words().nth(1),
            _ => None,
        };
        let Some(news) = self.sender.acknowledge(header.expected, usize::from(header.free), digest)? else {
            return Ok(false);
        };
        if news.taken > 0 || news.has_more_room {
            self.trips.shorten();
        }
        if let Some(left_at) = news.left_at {
            self.trips.measured(now.saturating_sub(left_at));
        }
        Ok(true)
    }

    /// Takes an answer. The host only asks for answers that fit a datagram.
    fn hear_answer(&mut self, message: &Message<'_>) -> Result<(), UdpFault> {
        let mut words: Vec<u32> = message.words().collect();
        let is_whole = message.header.kind == DeviceDatagram::AnswerEnd && message.body.len().is_multiple_of(4);
        if words.len() < 4 || !is_whole || words[1] != 0 {
            let announced = words.get(3).copied().unwrap_or(0);
            return Err(UdpFault::AnswerLength { announced, came: words.len().saturating_sub(4) });
        }
        let Some(announced) = words.pop() else { return Ok(()) };
        let said = message.body.get(8..message.body.len() - 4).unwrap_or_default();
        let found = crc32fast::hash(said);
        if found != announced {
            return Err(UdpFault::AnswerDigest { found, expected: announced });
        }
        if self.reader.take(words[0], &words[2..], &self.sender)? {
            self.trips.shorten();
        }
        Ok(())
    }

    /// Takes a `Nak`, which says that a datagram is missing, and sends again from that one on. A `Nak` that was on its
    /// way before the datagram was sent again is ignored.
    fn go_back_once(&mut self, now: Duration) {
        let is_old = |left_at: Duration| now < left_at + self.trips.mean() * 3 / 4;
        if !self.sender.first_repeated_at().is_some_and(is_old) {
            self.sender.go_back();
        }
        self.polled = None;
    }

    /// Takes the `Ack` to a `Poll`: datagrams that were out before the `Poll` and have not been taken are lost.
    fn hear_polled(&mut self) {
        let Some(polled) = self.polled.take() else { return };
        if self.sender.base() == polled.base && polled.base < polled.cut {
            self.sender.go_back();
        }
    }
}
