//! The program `incircle-sim serve-udp`: a line when it is ready, a session over a socket, an end by a signal.

use std::net::UdpSocket;
use std::time::Duration;

use super::service::{end, program, start};
use incircle_model::udp::{ToDevice, ToHost};
use incircle_protocol::{command_word, DeviceDatagram, HostDatagram, Opcode, MAX_DEVICE_DATAGRAM};

/// A socket that is connected to the address in the line of the service.
fn socket(line: &str) -> UdpSocket {
    let address = line.trim_end().split("udp:").nth(1).expect("an address");
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    socket.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
    socket.connect(address).unwrap();
    socket
}

fn listen(socket: &UdpSocket) -> ToHost {
    let mut bytes = [0; MAX_DEVICE_DATAGRAM];
    let length = socket.recv(&mut bytes).unwrap();
    ToHost::from_bytes(&bytes[..length]).expect("a datagram")
}

pub fn ask(socket: &UdpSocket, kind: HostDatagram, words: &[u32]) -> ToHost {
    socket.send(&ToDevice { session: 7, kind, number: 0, words: words.to_vec() }.to_bytes()).unwrap();
    listen(socket)
}

#[test]
fn any_program_may_speak_to_it() {
    speaks(&["serve-udp", "--fast", "--listen", "127.0.0.1:0"]);
}

#[test]
fn any_program_may_speak_to_its_pins() {
    speaks(&["serve-udp"]);
}

fn speaks(arguments: &[&str]) {
    let (child, line) = start(program(arguments));
    assert!(line.starts_with("ready: ") && line.contains("small"), "{line}");
    let (first, second) = (socket(&line), socket(&line));
    assert_eq!(ask(&first, HostDatagram::Hello, &[0; 14]).body.len(), 56);
    assert_eq!(ask(&first, HostDatagram::Open, &[]).kind(), DeviceDatagram::Opened);
    assert_eq!(ask(&second, HostDatagram::Open, &[]).kind(), DeviceDatagram::Busy);
    assert_eq!(ask(&first, HostDatagram::Data, &[command_word(Opcode::Hello)]).kind(), DeviceDatagram::Ack);
    let answer = listen(&first);
    assert_eq!((answer.kind(), answer.body.len()), (DeviceDatagram::AnswerEnd, 8 + 4 * 9 + 4));
    assert_eq!(ask(&first, HostDatagram::Close, &[]).kind(), DeviceDatagram::Closed);
    let (status, said) = end(child, "-TERM");
    assert!(status.success() && said.contains("datagrams"), "{said}");
}

#[test]
fn what_it_cannot_do_is_said_in_a_sentence() {
    for (arguments, part) in [
        (&["serve-udp", "--fault", "loss=2"][..], "a chance from 0 to 1"),
        (&["serve-udp", "--fast", "--listen", "8.8.8.8:9"], "not of this machine"),
    ] {
        let output = program(arguments).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && said.contains(part), "{said}");
    }
}
