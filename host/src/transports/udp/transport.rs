//! The UDP protocol over a socket of the operating system, in real time.

use std::hash::{BuildHasher, RandomState};
use std::io::{self, ErrorKind as IoKind};
use std::net::{Ipv4Addr, SocketAddr, SocketAddrV4, ToSocketAddrs, UdpSocket};
use std::time::{Duration, Instant};

use incircle_protocol::{Command, UdpGreeting, MAX_DEVICE_DATAGRAM};

use super::address::UdpAddress;
use super::fault::UdpFault;
use super::loss::is_lost_on_the_way;
use super::protocol::{UdpParams, UdpProtocol, UdpStatistics};
use super::readable::wait_readable;
use super::unit::Answer;
use crate::error::{Error, TransportError};
use crate::transports::is_begun_as;
use crate::transports::transport::{AnswerHead, Capabilities, Transport};

/// Bytes that the socket is asked to keep. Systems give less if their limit is lower.
const BUFFER_BYTES: usize = 4 << 20;
/// The system counts a datagram as up to twice its size, and only half of the rest is used.
const BUFFER_SHARE: usize = 4;
/// Most datagrams that are taken before what is due is sent.
const BURST: usize = 64;
/// Longest time in one call of the system.
const LONGEST_WAIT: Duration = Duration::from_millis(100);
/// Time limit for closing the session.
const GOODBYE: Duration = Duration::from_millis(100);

/// The transport to a device on a network.
///
/// The first command opens a session with the device, and dropping the transport closes it.
pub struct UdpTransport {
    socket: UdpSocket,
    peer: SocketAddrV4,
    protocol: UdpProtocol,
    name: String,
    origin: Instant,
    /// Datagrams that are due, and those that the system has not taken.
    out: Vec<Vec<u8>>,
}

impl UdpTransport {
    /// Looks up the host and opens a socket. Nothing is sent yet.
    ///
    /// # Errors
    /// [`Error::Open`] with a [`UdpFault`] if the host is not known or the system refuses a socket.
    pub fn open(address: &UdpAddress) -> Result<Self, Error> {
        let opened = Self::opened(address);
        opened.map_err(|fault| Error::Open { device: address.to_string(), source: fault.into() })
    }

    fn opened(address: &UdpAddress) -> Result<Self, UdpFault> {
        let peer = look_up(address)?;
        let refused = |what| move |error: io::Error| UdpFault::Network { what, reason: error.to_string() };
        let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0)).map_err(refused("open a socket"))?;
        let options = socket2::SockRef::from(&socket);
        // A system that refuses a larger buffer keeps the usual one, whose size is asked for below.
        let _ = options.set_recv_buffer_size(BUFFER_BYTES);
        let kept = options.recv_buffer_size().map_err(refused("open a socket"))?;
        socket.connect(peer).map_err(refused("reach the device"))?;
        socket.set_nonblocking(true).map_err(refused("open a socket"))?;
        let params = UdpParams { window_bytes: kept / BUFFER_SHARE, ..UdpParams::of_random(random()) };
        Ok(Self {
            socket,
            peer,
            protocol: UdpProtocol::new(params),
            name: address.to_string(),
            origin: Instant::now(),
            out: Vec::new(),
        })
    }

    /// The greeting of the device, once it has come.
    pub fn greeting(&self) -> Option<&UdpGreeting> {
        self.protocol.greeting()
    }

    /// Counts of the traffic so far.
    pub fn statistics(&self) -> UdpStatistics {
        self.protocol.statistics()
    }

    /// Runs the link until `ready` gives a result, or until the deadline.
    fn drive<T>(
        &mut self,
        deadline: Instant,
        mut ready: impl FnMut(&mut UdpProtocol) -> Option<T>,
    ) -> Result<T, TransportError> {
        loop {
            self.protocol.check()?;
            if let Some(result) = ready(&mut self.protocol) {
                return Ok(result);
            }
            if Instant::now() >= deadline {
                return Err(TransportError::Timeout { done: 0, wanted: 1 });
            }
            self.send_due()?;
            if !self.take_waiting()? {
                self.wait(deadline)?;
            }
        }
    }

    /// Sends the datagrams that are due, as many as the system takes.
    fn send_due(&mut self) -> Result<(), UdpFault> {
        if self.out.is_empty() {
            self.protocol.transmit(self.origin.elapsed(), &mut self.out);
        }
        let mut sent = 0;
        for datagram in &self.out {
            match self.socket.send(datagram) {
                Ok(_) => sent += 1,
                Err(error) if error.kind() == IoKind::WouldBlock => break,
                // The refusal of an earlier datagram. This one was not sent, but will be asked for.
                Err(error) if error.kind() == IoKind::ConnectionRefused => {
                    self.protocol.refused(self.peer.port());
                    sent += 1;
                }
                Err(error) if is_lost_on_the_way(&error) => sent += 1,
                Err(error) => return Err(UdpFault::Network { what: "send", reason: error.to_string() }),
            }
        }
        self.out.drain(..sent);
        Ok(())
    }

    /// Takes the datagrams that wait in the socket, up to a number. Returns false if there was none.
    fn take_waiting(&mut self) -> Result<bool, UdpFault> {
        for taken in 0..BURST {
            if !self.take_one()? {
                return Ok(taken > 0);
            }
        }
        Ok(true)
    }

    /// Takes a datagram, if one has come.
    fn take_one(&mut self) -> Result<bool, UdpFault> {
        // One byte more than the longest datagram shows that a datagram is too long.
        let mut bytes = [0; MAX_DEVICE_DATAGRAM + 1];
        let came = self.socket.recv(&mut bytes);
        self.take_in(came, &bytes)
    }

    /// Takes what the system has received. Returns true if it was a datagram.
    fn take_in(&mut self, came: io::Result<usize>, bytes: &[u8]) -> Result<bool, UdpFault> {
        match came {
            Ok(length) => {
                self.protocol.receive(bytes.get(..length).unwrap_or(bytes), self.origin.elapsed());
                Ok(true)
            }
            Err(error) if is_too_long(&error) => {
                self.protocol.receive(bytes, self.origin.elapsed());
                Ok(true)
            }
            Err(error) => match error.kind() {
                IoKind::WouldBlock | IoKind::TimedOut | IoKind::Interrupted => Ok(false),
                IoKind::ConnectionRefused | IoKind::ConnectionReset => {
                    self.protocol.refused(self.peer.port());
                    Ok(false)
                }
                _ if is_lost_on_the_way(&error) => Ok(false),
                _ => Err(UdpFault::Network { what: "receive", reason: error.to_string() }),
            },
        }
    }

    /// Waits for a datagram, until something is due or until the deadline.
    fn wait(&mut self, deadline: Instant) -> Result<(), UdpFault> {
        let refused = |error: io::Error| UdpFault::Network { what: "receive", reason: error.to_string() };
        let due = self.protocol.next_wake().map(|wake| wake.saturating_sub(self.origin.elapsed()));
        let wait = due.unwrap_or(LONGEST_WAIT).min(deadline.saturating_duration_since(Instant::now()));
        if wait.is_zero() {
            return Ok(());
        }
        wait_readable(&self.socket, wait.min(LONGEST_WAIT)).map_err(refused)?;
        self.take_one().map(|_| ())
    }
}

/// Whether Windows says that a datagram was longer than the buffer (WSAEMSGSIZE). Other systems cut the datagram and
/// report no error.
pub(super) fn is_too_long(error: &io::Error) -> bool {
    error.raw_os_error() == Some(10_040)
}

/// The IPv4 address of a device.
fn look_up(address: &UdpAddress) -> Result<SocketAddrV4, UdpFault> {
    let unknown = |reason: String| UdpFault::Unknown { host: address.host.clone(), reason };
    let found = (address.host.as_str(), address.port).to_socket_addrs().map_err(|error| unknown(error.to_string()))?;
    let mut found = found.filter_map(|found| match found {
        SocketAddr::V4(found) => Some(found),
        SocketAddr::V6(_) => None,
    });
    found.next().ok_or_else(|| unknown("it has others".to_owned()))
}

/// A random number, made of the random keys that the standard library takes from the system.
pub(super) fn random() -> u64 {
    RandomState::new().hash_one((std::process::id(), Instant::now()))
}

impl Drop for UdpTransport {
    fn drop(&mut self) {
        self.protocol.close(self.origin.elapsed());
        self.out.clear();
        let deadline = Instant::now() + GOODBYE;
        // A goodbye that is lost does no harm: the device forgets the session after its silence.
        while !self.protocol.is_closed() && Instant::now() < deadline {
            let sent = self.send_due().and_then(|()| self.wait(deadline));
            if sent.is_err() {
                return;
            }
        }
    }
}

impl Transport for UdpTransport {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], deadline: Instant) -> Result<(), TransportError> {
        self.protocol.ask(commands, self.origin.elapsed())?;
        if Instant::now() >= deadline {
            return Err(TransportError::Timeout { done: 0, wanted: commands.len() });
        }
        self.send_due()?;
        self.take_waiting()?;
        Ok(self.send_due()?)
    }

    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        let answer = self.drive(deadline, UdpProtocol::take_answer)?;
        Ok(handed_on(answer, head, payload))
    }

    fn receive_next(
        &mut self,
        words_of: &mut dyn FnMut(AnswerHead) -> Option<usize>,
        payload: &mut Vec<u32>,
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        let (came, words) = self.drive(deadline, UdpProtocol::take_answer)?;
        *payload = if words_of(came) == Some(words.len()) { words } else { Vec::new() };
        Ok(came)
    }

    fn capabilities(&self) -> Capabilities {
        self.protocol.capabilities()
    }

    fn repeats(&self) -> u64 {
        let UdpStatistics { repeated, restarted, .. } = self.statistics();
        repeated + restarted
    }

    fn recover(&mut self, _deadline: Instant) -> Result<bool, TransportError> {
        Ok(self.protocol.recover(self.origin.elapsed()))
    }
}

/// Copies the payload of an answer if the answer begins as it should, and returns its actual beginning.
fn handed_on((came, words): Answer, head: AnswerHead, payload: &mut [u32]) -> AnswerHead {
    if is_begun_as(came, head) && words.len() == payload.len() {
        payload.copy_from_slice(&words);
    }
    came
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_datagram_that_is_too_long_for_windows_is_ignored() {
        let address = UdpAddress { host: "127.0.0.1".to_owned(), port: 9 };
        let mut transport = UdpTransport::open(&address).expect("a socket");
        let bytes = [0; MAX_DEVICE_DATAGRAM + 1];
        let came = transport.take_in(Err(io::Error::from_raw_os_error(10_040)), &bytes);
        assert_eq!((came, transport.statistics().broken), (Ok(true), 1));
        let came = transport.take_in(Err(io::Error::other("the socket is gone")), &bytes);
        assert!(matches!(came, Err(UdpFault::Network { .. })), "{came:?}");
    }
}
