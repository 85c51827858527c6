//! A board behind a TAP device: the kernel's own ARP, ICMP and UDP at the pins of the PHY, in a network namespace that
//! belongs to the test.

use std::net::UdpSocket;
use std::process::Command;
use std::time::Duration;

use super::network::ask;
use super::service::{end, program, start};
use incircle::{Device, Point};
use incircle_protocol::{HostDatagram, SMALL};
use incircle_sim::network::NetworkBoard;

/// Tells the test that it runs inside the namespace.
const INSIDE: &str = "INCIRCLE_TEST_IN_NAMESPACE";
/// Commands that make the TAP device, which fail where the system allows none.
const SET_UP: &str = "ip tuntap add dev plug mode tap && ip address add 10.0.0.1/24 dev plug && ip link set plug up";

/// A shell command in a namespace of its own, where this user may make network interfaces.
fn in_namespace(command: &str) -> Command {
    let mut shell = Command::new("unshare");
    shell.args(["--user", "--map-root-user", "--net", "--", "sh", "-c", command]);
    shell
}

#[test]
fn the_kernel_itself_talks_to_the_pins() {
    if std::env::var_os(INSIDE).is_some() {
        return talks();
    }
    match in_namespace(SET_UP).output() {
        Ok(output) if output.status.success() => {}
        // The raw frames of the next test drive the same pins on every system.
        refused => return println!("no TAP device here, so the kernel does not talk to the pins: {refused:?}"),
    }
    let own = std::env::current_exe().unwrap();
    let test = "serve::tap::the_kernel_itself_talks_to_the_pins";
    let command = format!("{SET_UP} && exec '{}' --exact {test} --nocapture", own.display());
    let output = in_namespace(&command).env(INSIDE, "1").output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.contains("1 passed"), "{said}");
}

/// What a command says; it must succeed.
fn said_by(command: &str, arguments: &[&str]) -> String {
    let output = Command::new(command).args(arguments).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{command} {arguments:?}: {said}{}", String::from_utf8_lossy(&output.stderr));
    said
}

fn talks() {
    let (child, line) = start(program(&["serve-udp", "--tap", "plug"]));
    assert!(line.starts_with("ready: ") && line.trim_end().ends_with("open udp:10.0.0.7"), "{line}");
    // The kernel asks for the address of the board by ARP before it sends the greeting.
    let socket = UdpSocket::bind("10.0.0.1:0").unwrap();
    socket.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
    socket.set_broadcast(true).unwrap();
    socket.connect("10.0.0.7:26947").unwrap();
    assert_eq!(ask(&socket, HostDatagram::Hello, &[0; 14]).body.len(), 56);
    let neighbour = said_by("ip", &["neighbour", "show", "10.0.0.7"]);
    assert!(neighbour.contains("lladdr 02:00:00:69:43:07"), "{neighbour}");
    let echo = said_by("ping", &["-c", "3", "-i", "0.2", "-W", "20", "10.0.0.7"]);
    assert!(echo.contains(" 0% packet loss"), "{echo}");
    let found = incircle::udp::discover(&["10.0.0.255:26947".parse().unwrap()], Duration::from_secs(3)).unwrap();
    assert_eq!(found.iter().map(|device| device.greeting.mac).collect::<Vec<_>>(), [[2, 0, 0, 0x69, 0x43, 7]]);

    let points: Vec<Point> = (0..50).map(|at| Point { x: at * 37 % 64, y: at * 11 % 53 }).collect();
    let mut device = Device::open("udp:10.0.0.7").unwrap();
    let mesh = device.session().unwrap().triangulate(&points).unwrap().mesh;
    assert!(mesh == Device::cpu(None).session().unwrap().triangulate(&points).unwrap().mesh);
    drop(device);
    let (status, said) = end(child, "-TERM");
    assert!(status.success() && said.contains("frames to the device"), "{said}");
}

/// The frame with which a board answers another one.
fn answer(board: &mut NetworkBoard, frame: &[u8]) -> Option<Vec<u8>> {
    board.send_sound_frame(frame);
    board.run(100_000);
    board.receive_frame()
}

#[test]
fn raw_frames_get_what_the_kernel_would_get() {
    let mut board = NetworkBoard::new(SMALL).unwrap();
    let (host, device) = ([2, 0, 0, 0, 0, 1], board.link().mac);
    let (host_ip, device_ip) = ([10, 0, 0, 1], [10, 0, 0, 7]);
    let arp = |to: [u8; 6], operation: u8, sender: [&[u8]; 2], target: [&[u8]; 2]| {
        let head = [0x08, 0x06, 0, 1, 8, 0, 6, 4, 0, operation];
        let mut frame = [&to[..], sender[0], &head, sender[0], sender[1], target[0], target[1]].concat();
        frame.resize(60, 0);
        frame
    };
    let question = arp([0xff; 6], 1, [&host, &host_ip], [&[0; 6], &device_ip]);
    let reply = arp(host, 2, [&device, &device_ip], [&host, &host_ip]);
    assert_eq!(answer(&mut board, &question), Some(reply));
    let other = arp([0xff; 6], 1, [&host, &host_ip], [&[0; 6], &[10, 0, 0, 8]]);
    assert_eq!(answer(&mut board, &other), None);

    // An echo request of 32 bytes of 0; the two check sums are written out.
    let ip = [0x45, 0, 0, 60, 0, 0, 0x40, 0, 64, 1, 0x26, 0xba, 10, 0, 0, 1, 10, 0, 0, 7];
    let echo = [&device[..], &host, &[8, 0], &ip, &[8, 0, 0xf7, 0xff], &[0; 36]].concat();
    let reply = answer(&mut board, &echo).expect("a reply");
    let (ends, kind) = (&reply[26..34], &reply[34..38]);
    assert_eq!((&reply[..12], ends), (&[host, device].concat()[..], &[device_ip, host_ip].concat()[..]));
    assert_eq!((kind, &reply[38..74]), (&[0, 0, 0xff, 0xff][..], &[0; 36][..]));
}

#[test]
fn a_tap_device_that_cannot_be_opened_is_told_in_a_sentence() {
    for name in ["", "a-name-that-is-too-long"] {
        let output = program(&["serve-udp", "--tap", name]).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && said.contains("ip tuntap add"), "{said}");
    }
}
