//! The UDP transport over sockets of the system, before the model of a device in a thread.

use std::net::{Ipv4Addr, SocketAddr, SocketAddrV4, UdpSocket};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use crate::common::{by_cpu, Random};
use incircle::udp::{discover, UdpFault};
use incircle::{Device, Error, Options};
use incircle_model::serial::Instantly;
use incircle_model::udp::UdpModel;
use incircle_protocol::{UdpLinkConfig, FULL};

const LINK: UdpLinkConfig =
    UdpLinkConfig { clock_hz: 120_000_000, fifo_bytes: 16_384, silence_ms: 2000, mac: [2, 0, 0, 0, 0, 1] };

/// Devices at a port of this machine until they are dropped. Their sessions never end by silence. All take each
/// datagram, as boards with one address do that hear a greeting to all.
struct Served {
    address: SocketAddrV4,
    stops: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Served {
    /// One device.
    fn new() -> Self {
        Self::with_macs(&[LINK.mac])
    }

    /// A device of each of these Ethernet addresses.
    fn with_macs(macs: &[[u8; 6]]) -> Self {
        let links: Vec<_> = macs.iter().map(|&mac| UdpLinkConfig { mac, ..LINK }).collect();
        let socket = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).expect("a socket");
        socket.set_read_timeout(Some(Duration::from_millis(20))).expect("a timeout");
        let SocketAddr::V4(address) = socket.local_addr().expect("an address") else { panic!("an IPv4 address") };
        let stops = Arc::new(AtomicBool::new(false));
        let stop = Arc::clone(&stops);
        let thread = std::thread::spawn(move || {
            let model = |link| {
                let core = Instantly::of(FULL).expect("a named configuration");
                UdpModel::new(link, core.identity(), core)
            };
            let mut devices: Vec<_> = links.into_iter().map(model).collect();
            let mut bytes = [0; 2000];
            while !stop.load(Ordering::Relaxed) {
                let came = socket.recv_from(&mut bytes);
                for device in &mut devices {
                    if let Ok((length, SocketAddr::V4(from))) = came {
                        device.take(from, false, &bytes[..length]);
                    }
                    work(device, &socket);
                }
            }
        });
        Self { address, stops, thread: Some(thread) }
    }

    fn open(&self) -> Device {
        Device::open(&format!("udp:{}", self.address)).expect("a socket")
    }
}

/// Lets a device work until it waits, and sends what it says.
fn work(device: &mut UdpModel<Instantly>, socket: &UdpSocket) {
    loop {
        device.work(4096);
        while let Some((to, datagram)) = device.give() {
            socket.send_to(&datagram, to).expect("sent");
        }
        if !device.is_at_work() {
            break;
        }
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.stops.store(true, Ordering::Relaxed);
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

#[test]
fn jobs_and_batches_pass_sockets() {
    let served = Served::new();
    let mut device = served.open();
    let mut session = device.session().expect("a session");
    let mut random = Random(1);
    let points = random.points(8000, 1 << 16);
    let solution = session.triangulate(&points).expect("a mesh");
    assert_eq!(solution.mesh, by_cpu(&points).mesh);
    assert_eq!(solution.report.backend, format!("udp:{}", served.address));
    // More than the device holds goes in parts.
    let points = random.points(30_000, 1 << 16);
    assert_eq!(session.triangulate(&points).expect("a mesh").mesh, by_cpu(&points).mesh);
    let sets: Vec<_> = (0..50).map(|set| random.points(3 + 20 * set, 1 << 10)).collect();
    for (points, solution) in sets.iter().zip(session.triangulate_batch(&sets, &Options::default()).expect("meshes")) {
        assert_eq!(solution.mesh, by_cpu(points).mesh);
    }
    // The session ends with the device, so the next program finds it free.
    drop(device);
    assert!(served.open().session().is_ok());
}

#[test]
fn a_greeting_to_an_address_finds_the_device_and_says_whether_it_is_busy() {
    let served = Served::new();
    let found = discover(&[served.address], Duration::from_millis(300)).expect("a socket");
    let [device] = &found[..] else { panic!("{found:?}") };
    assert_eq!((device.address.to_string(), device.is_busy), (format!("udp:{}", served.address), false));
    assert_eq!(device.greeting.mac, LINK.mac);
    let mut device = served.open();
    device.session().expect("a session");
    let found = discover(&[served.address], Duration::from_millis(300)).expect("a socket");
    assert!(found.iter().all(|device| device.is_busy) && found.len() == 1, "{found:?}");
}

#[test]
fn a_port_where_nobody_listens_is_named() {
    let free = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).and_then(|socket| socket.local_addr()).expect("a port");
    let mut device = Device::open(&format!("udp:{free}")).expect("a socket");
    let Err(Error::Link { source, .. }) = device.session() else { panic!("nobody listens") };
    assert!(matches!(source.fault(), Some(UdpFault::Refused { .. } | UdpFault::Silent { .. })), "{source}");
    let error = Device::open("udp:no-such-host.invalid").err().expect("no such host");
    assert!(error.to_string().contains("no-such-host.invalid"), "{error}");
}

#[test]
fn two_devices_with_one_address_are_told_apart() {
    let macs = [[2, 0, 0, 0, 0, 9], [2, 0, 0, 0, 0, 3]];
    let served = Served::with_macs(&macs);
    let found = discover(&[served.address], Duration::from_millis(300)).expect("a socket");
    let told: Vec<_> = found.iter().map(|device| (device.address.to_string(), device.greeting.mac)).collect();
    let address = format!("udp:{}", served.address);
    assert_eq!(told, [(address.clone(), macs[1]), (address, macs[0])]);
}
