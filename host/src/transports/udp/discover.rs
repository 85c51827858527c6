//! Looking for devices on a network, by a greeting to all.

use std::io::{self, ErrorKind as IoKind};
use std::net::{Ipv4Addr, SocketAddr, SocketAddrV4, UdpSocket};
use std::time::{Duration, Instant};

use incircle_protocol::{
    DeviceDatagram, HostDatagram, UdpGreeting, MAX_DEVICE_DATAGRAM, STATUS_OPEN, UDP_GREETING_WORDS, UDP_PORT,
};

use super::address::UdpAddress;
use super::codec::{encode, Message};
use super::fault::UdpFault;
use super::greeting::checked_greeting;
use super::loss::is_lost_on_the_way;
use super::transport::{is_too_long, random};

/// Number of greetings that are sent, since each may be lost.
const GREETINGS: u32 = 3;

/// A device that answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Discovered {
    /// Address to open it with.
    pub address: UdpAddress,
    /// The greeting of the device, checked.
    pub greeting: UdpGreeting,
    /// Whether a session with it is open.
    pub is_busy: bool,
}

/// Greets all devices of the network at the usual port, and returns those that answer within `time`, in the order of
/// their addresses. Two devices with one address both appear: their Ethernet addresses differ.
///
/// The greeting goes to 255.255.255.255, which most systems send through the interface of the default route only. `to`
/// names other addresses to greet: the broadcast addresses of other networks, or single devices. Answers that are not
/// those of a sound device are left out.
///
/// # Errors
/// [`UdpFault::Network`] if the system refuses a socket, or to send to every one of the addresses.
pub fn discover(to: &[SocketAddrV4], time: Duration) -> Result<Vec<Discovered>, UdpFault> {
    let refused = |error: io::Error| UdpFault::Network { what: "greet all devices", reason: error.to_string() };
    let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0)).map_err(refused)?;
    socket.set_broadcast(true).map_err(refused)?;
    let everyone = [SocketAddrV4::new(Ipv4Addr::BROADCAST, UDP_PORT)];
    let to = if to.is_empty() { &everyone } else { to };
    let number = random();
    let mut found: Vec<Discovered> = Vec::new();
    for round in 0..GREETINGS {
        let hello = encode(HostDatagram::Hello, 0, number, &[0; 4 * UDP_GREETING_WORDS]);
        let mut refusal = None;
        let sent = to.iter().filter(|to| socket.send_to(&hello, to).map_err(|error| refusal = Some(error)).is_ok());
        // A refusal in a later round loses a greeting, and not the devices that have answered.
        if let (0, 0, Some(error)) = (round, sent.count(), refusal) {
            return Err(refused(error));
        }
        let until = Instant::now() + time / GREETINGS;
        while let Some((from, bytes)) = next(&socket, until).map_err(refused)? {
            let device = answer(from, number, &bytes).filter(|device| {
                !found.iter().any(|known| known.address == device.address && known.greeting.mac == device.greeting.mac)
            });
            found.extend(device);
        }
    }
    found.sort_by_key(place);
    Ok(found)
}

/// The next datagram, and where it comes from.
fn next(socket: &UdpSocket, until: Instant) -> io::Result<Option<(SocketAddr, Vec<u8>)>> {
    let mut bytes = [0; MAX_DEVICE_DATAGRAM + 1];
    loop {
        let wait = until.saturating_duration_since(Instant::now());
        if wait.is_zero() {
            return Ok(None);
        }
        socket.set_read_timeout(Some(wait))?;
        match socket.recv_from(&mut bytes) {
            Ok((length, from)) => return Ok(Some((from, bytes[..length].to_vec()))),
            Err(error) => match error.kind() {
                IoKind::WouldBlock | IoKind::TimedOut => return Ok(None),
                _ if is_of_one(&error) => {}
                _ => return Err(error),
            },
        }
    }
}

/// Whether an error leaves the others their chance to answer: a machine refuses the greeting, a datagram is too long or
/// lost, or a signal came.
fn is_of_one(error: &io::Error) -> bool {
    matches!(error.kind(), IoKind::Interrupted | IoKind::ConnectionRefused | IoKind::ConnectionReset)
        || is_too_long(error)
        || is_lost_on_the_way(error)
}

/// The place of a device among those found: by address, then by port, then by Ethernet address.
fn place(device: &Discovered) -> (Option<Ipv4Addr>, u16, [u8; 6]) {
    (device.address.host.parse().ok(), device.address.port, device.greeting.mac)
}

/// The device that sent this datagram, if it is the answer of a sound device to the greeting of this number.
fn answer(from: SocketAddr, number: u64, bytes: &[u8]) -> Option<Discovered> {
    let message = Message::decode(bytes)?;
    if message.header.kind != DeviceDatagram::Hello || message.header.session != number {
        return None;
    }
    let greeting = checked_greeting(&message).ok()?;
    let address = UdpAddress { host: from.ip().to_string(), port: from.port() };
    Some(Discovered { address, greeting, is_busy: message.header.status & STATUS_OPEN != 0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_stand_in_the_order_of_their_addresses() {
        let greeting = UdpGreeting::from_words([0; UDP_GREETING_WORDS]);
        let found = |host: &str, port| {
            let address = UdpAddress { host: host.to_owned(), port };
            Discovered { address, greeting, is_busy: false }
        };
        let mut devices = [found("10.0.0.10", 9), found("10.0.0.9", 1000), found("9.0.0.1", 9), found("10.0.0.9", 999)];
        devices.sort_by_key(place);
        let order = devices.map(|device| (device.address.host, device.address.port));
        let expected = [("9.0.0.1", 9), ("10.0.0.9", 999), ("10.0.0.9", 1000), ("10.0.0.10", 9)];
        assert_eq!(order, expected.map(|(host, port)| (host.to_owned(), port)));
    }

    #[test]
    fn an_error_of_one_machine_does_not_end_the_search() {
        for error in [IoKind::ConnectionReset.into(), IoKind::NetworkDown.into(), io::Error::from_raw_os_error(10_040)]
        {
            assert!(is_of_one(&error), "{error}");
        }
        assert!(!is_of_one(&IoKind::PermissionDenied.into()));
    }
}
