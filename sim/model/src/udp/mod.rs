//! The device's end of the UDP link, datagram by datagram, as `protocol/UDP.md` describes it.
//!
//! [`UdpModel`] stands between a network and a [`WordDevice`]. The caller decides when datagrams come and go and when
//! clocks pass, so the same model serves tests in virtual time and devices in real time. Ethernet, ARP, IPv4 and UDP
//! are not modelled: the caller says from which address a datagram comes. The model shares nothing with the hardware or
//! with a host but the numbers of the protocol.
//!
//! ```
//! use std::net::{Ipv4Addr, SocketAddrV4};
//! use incircle_model::serial::Instantly;
//! use incircle_model::udp::{ToDevice, ToHost, UdpModel};
//! use incircle_protocol::{DeviceDatagram, HostDatagram, UdpLinkConfig, SMALL};
//! let link = UdpLinkConfig { clock_hz: 125_000_000, fifo_bytes: 16_384, silence_ms: 2000, mac: [2, 0, 0, 0, 0, 1] };
//! let core = Instantly::of(SMALL)?;
//! let mut board = UdpModel::new(link, core.identity(), core);
//! let host = SocketAddrV4::new(Ipv4Addr::LOCALHOST, 50_000);
//! let hello = ToDevice { session: 7, kind: HostDatagram::Hello, number: 0, words: vec![0; 14] };
//! board.take(host, false, &hello.to_bytes());
//! let (to, said) = board.give().unwrap();
//! assert_eq!((to, said.len()), (host, hello.to_bytes().len()));
//! assert_eq!(ToHost::from_bytes(&said).unwrap().kind(), DeviceDatagram::Hello);
//! # Ok::<(), incircle_model::ModelError>(())
//! ```

mod datagram;
mod session;
#[cfg(test)]
mod tests;

use std::net::SocketAddrV4;

use incircle_protocol::{
    patience, DeviceDatagram, DeviceHeader, HostDatagram, Identity, UdpGreeting, UdpLinkConfig, MAX_POINTS,
    STATUS_BUSY, STATUS_DROPPED, STATUS_OPEN, UDP_LINK_MAGIC, UDP_LINK_VERSION,
};

use crate::link::{Taken, WordDevice};
use session::Session;

pub use datagram::{ToDevice, ToHost};

/// An answer outside the session, to be sent to the sender of the question.
#[derive(Clone, Copy, Debug)]
struct Reply {
    kind: DeviceDatagram,
    to: SocketAddrV4,
    session: u64,
}

/// A device behind its UDP link.
#[derive(Debug)]
pub struct UdpModel<D> {
    link: UdpLinkConfig,
    greeting: UdpGreeting,
    core: D,
    session: Option<Session>,
    /// The one answer outside the session that waits to be sent.
    reply: Option<Reply>,
    /// Whether an `Ack` or a `Nak` is due.
    ack: bool,
    nak: bool,
    was_dropped: bool,
    /// Number of clocks since the last datagram of the session.
    silent: u64,
}

impl<D: WordDevice> UdpModel<D> {
    /// A device that has just been reset. `identity` is the identity of the core.
    pub fn new(link: UdpLinkConfig, identity: Identity, core: D) -> Self {
        let greeting = UdpGreeting {
            magic: UDP_LINK_MAGIC,
            link_version: UDP_LINK_VERSION,
            clock_hz: link.clock_hz,
            fifo_bytes: link.fifo_bytes,
            silence_ms: link.silence_ms,
            mac: link.mac,
            identity,
        };
        Self { link, greeting, core, session: None, reply: None, ack: false, nak: false, was_dropped: false, silent: 0 }
    }

    /// Number of the open session, if there is one.
    pub fn session(&self) -> Option<u64> {
        self.session.as_ref().map(|session| session.number)
    }

    /// Whether the core has something to do and can do it.
    pub fn is_at_work(&self) -> bool {
        self.session.as_ref().is_some_and(|session| !session.flow.is_stalled(&self.core))
    }

    /// Lets this many clocks pass: the core works, and the silence grows longer. Returns the number of clocks in which
    /// the core had something to do.
    pub fn pass(&mut self, clocks: u64) -> u64 {
        let worked = self.work(clocks);
        self.age(clocks);
        worked
    }

    /// Lets the core work for this many clocks, in no time. Returns the number of clocks in which it had something to
    /// do.
    pub fn work(&mut self, clocks: u64) -> u64 {
        self.session.as_mut().map_or(0, |session| session.flow.pass(&mut self.core, clocks))
    }

    /// Lets the silence grow by this many clocks, in which the core does nothing.
    pub fn age(&mut self, clocks: u64) {
        self.silent = self.silent.saturating_add(clocks);
        if self.silent >= u64::from(self.link.clock_hz) * u64::from(self.link.silence_ms) / 1000 {
            self.end_session();
        }
    }

    /// Takes a datagram that came from this address. `is_broadcast` tells that it was sent to all devices.
    pub fn take(&mut self, from: SocketAddrV4, is_broadcast: bool, bytes: &[u8]) {
        let Some(datagram) = ToDevice::from_bytes(bytes) else {
            self.was_dropped = true;
            return;
        };
        if is_broadcast && datagram.kind != HostDatagram::Hello {
            return;
        }
        match datagram.kind {
            HostDatagram::Hello => self.reply(DeviceDatagram::Hello, from, datagram.session),
            HostDatagram::Open => self.open(from, datagram.session),
            HostDatagram::Poll | HostDatagram::Data | HostDatagram::Close => self.take_in_session(from, &datagram),
        }
    }

    /// Takes an `Open`. The `Open` of the session that is open changes nothing, since it may have been doubled.
    fn open(&mut self, from: SocketAddrV4, number: u64) {
        if number == 0 {
            self.was_dropped = true;
            return;
        }
        if self.reply.is_some() {
            return;
        }
        match &self.session {
            Some(session) if (session.host, session.number) != (from, number) => {
                return self.reply(DeviceDatagram::Busy, from, number);
            }
            Some(_) => {}
            None => {
                self.core.reset();
                let patience = patience(self.greeting.identity.capacity.min(MAX_POINTS));
                self.session = Some(Session::new(number, from, u64::from(patience)));
            }
        }
        self.silent = 0;
        self.reply(DeviceDatagram::Opened, from, number);
    }

    fn take_in_session(&mut self, from: SocketAddrV4, datagram: &ToDevice) {
        let Some(session) = &mut self.session else {
            return self.reply(DeviceDatagram::NoSession, from, datagram.session);
        };
        if (session.host, session.number) != (from, datagram.session) {
            return;
        }
        match datagram.kind {
            HostDatagram::Close if self.reply.is_some() => return,
            HostDatagram::Close => {
                self.end_session();
                return self.reply(DeviceDatagram::Closed, from, datagram.session);
            }
            HostDatagram::Data => match session.take_data(datagram.number, &datagram.words, self.link.fifo_bytes) {
                Taken::Here => (self.ack, self.nak) = (true, false),
                Taken::Before => self.ack = true,
                Taken::NotYet => self.nak = true,
                Taken::NotYetToldBefore => {}
            },
            _ if session.flow.has_gap() => self.nak = true,
            _ => self.ack = true,
        }
        self.silent = 0;
    }

    /// Makes an answer outside the session due, unless another one is.
    fn reply(&mut self, kind: DeviceDatagram, to: SocketAddrV4, session: u64) {
        self.reply.get_or_insert(Reply { kind, to, session });
    }

    fn end_session(&mut self) {
        self.session = None;
        (self.ack, self.nak, self.silent) = (false, false, 0);
    }

    /// The next datagram for a host, if one is due, and the address that it goes to.
    pub fn give(&mut self) -> Option<(SocketAddrV4, Vec<u8>)> {
        if let Some(Reply { kind, to, session }) = self.reply.take() {
            let words = if kind == DeviceDatagram::Hello { &self.greeting.to_words()[..] } else { &[] };
            let body = words.iter().flat_map(|word| word.to_le_bytes()).collect();
            return Some((to, self.datagram(kind, session, body)));
        }
        let session = self.session.as_mut()?;
        let (host, number) = (session.host, session.number);
        if self.ack || self.nak {
            let kind = if self.nak { DeviceDatagram::Nak } else { DeviceDatagram::Ack };
            (self.ack, self.nak) = (false, false);
            let body =
                [session.flow.answers.sent(), session.flow.taken()].into_iter().flat_map(u32::to_le_bytes).collect();
            return Some((host, self.datagram(kind, number, body)));
        }
        let part = session.next_part()?;
        let kind = if part.digest.is_some() { DeviceDatagram::AnswerEnd } else { DeviceDatagram::Answer };
        let words = [part.number, part.index].into_iter().chain(part.words).chain(part.digest);
        let body = words.flat_map(u32::to_le_bytes).collect();
        Some((host, self.datagram(kind, number, body)))
    }

    /// A datagram to a host. The report of a dropped datagram is sent once, so building a header clears it.
    fn datagram(&mut self, kind: DeviceDatagram, number: u64, body: Vec<u8>) -> Vec<u8> {
        let session = self.session.as_ref();
        let waiting = session.map_or(0, |session| session.flow.waiting_bytes() as u32);
        let flags = [
            (session.is_some(), STATUS_OPEN),
            (std::mem::take(&mut self.was_dropped), STATUS_DROPPED),
            (session.is_some_and(|session| session.flow.is_busy()), STATUS_BUSY),
        ];
        let header = DeviceHeader {
            kind,
            status: flags.iter().filter(|(is_set, _)| *is_set).map(|(_, bit)| bit).sum(),
            free: self.link.fifo_bytes.saturating_sub(waiting).min(u32::from(u16::MAX)) as u16,
            expected: session.map_or(0, |session| session.expected),
            session: number,
        };
        ToHost { header, body }.to_bytes()
    }
}
