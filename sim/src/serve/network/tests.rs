//! A service that is called step by step.

use std::net::Ipv4Addr;

use incircle_model::udp::ToDevice;
use incircle_protocol::{HostDatagram, SMALL};

use super::*;

fn server(device: Box<dyn OnNetwork>) -> (Server, SocketAddr) {
    let socket = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).expect("a socket");
    socket.set_nonblocking(true).expect("a choice");
    let address = socket.local_addr().expect("an address");
    let (origin, figures) = (Instant::now(), NetworkFigures::default());
    (Server { socket, device, network: None, origin, figures }, address)
}

fn hello() -> Vec<u8> {
    ToDevice { session: 7, kind: HostDatagram::Hello, number: 0, words: vec![0; 14] }.to_bytes()
}

#[test]
fn a_datagram_from_port_0_is_dropped() {
    let (mut server, _) = server(Box::new(FastDevice::new(SMALL, 9).expect("a device")));
    for (port, answers) in [(0, 0), (50_000, 1)] {
        server.take_in(SocketAddr::from((Ipv4Addr::LOCALHOST, port)), &hello());
        server.turn().expect("the service goes on");
        assert_eq!(server.figures.to_host, answers, "port {port}");
    }
}

#[test]
fn a_datagram_that_the_system_does_not_send_is_lost() {
    let (mut server, _) = server(Box::new(FastDevice::new(SMALL, 9).expect("a device")));
    let nowhere = SocketAddrV4::new(Ipv4Addr::LOCALHOST, 0);
    assert!(server.socket.send_to(&hello(), nowhere).is_err(), "the system refuses this address");
    // The device is asked directly, as if the address had come through.
    server.device.take(nowhere, &hello());
    server.turn().expect("the service goes on");
    assert_eq!(server.figures.to_host, 1);
}

#[test]
fn a_network_that_is_away_or_full_is_no_reason_to_end() {
    for error in [ErrorKind::NetworkDown.into(), io::Error::from_raw_os_error(105)] {
        assert!(means_no_datagram(&error), "{error}");
    }
    assert!(!means_no_datagram(&ErrorKind::InvalidInput.into()));
}

#[test]
fn a_flood_waits_in_the_socket() {
    let (mut server, address) = server(Box::new(NetworkBoard::new(SMALL).expect("a board")));
    let host = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).expect("a socket");
    for _ in 0..100 {
        host.send_to(&[0; MAX_HOST_DATAGRAM], address).expect("sent");
    }
    for _ in 0..4 {
        server.turn().expect("the service goes on");
    }
    // 64 kB are 43 of the frames, and the board takes a little more than one in a turn.
    assert!((40..=50).contains(&server.figures.to_device), "{}", server.figures.to_device);
    for _ in 0..20 {
        server.turn().expect("the service goes on");
    }
    assert!(server.figures.to_device > 60, "{}", server.figures.to_device);
}
