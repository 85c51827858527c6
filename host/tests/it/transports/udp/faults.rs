//! Jobs over a network with faults, in virtual time: each ends with the right mesh or with an error that has a type.

use std::cell::RefCell;
use std::rc::Rc;
use std::time::Duration;

use crate::common::network::{VirtualNetwork, VirtualTransport};
use crate::common::{by_cpu, Random};
use incircle::udp::UdpFault;
use incircle::{Device, Error, Options, Point};
use incircle_testkit::NetworkFaults;

const TRIP: Duration = Duration::from_micros(200);
/// Limit for an answer, in virtual time.
const LIMIT: Duration = Duration::from_secs(20);

type Shared = Rc<RefCell<VirtualNetwork>>;

fn connect(faults: &str, seed: u64) -> (Shared, Device) {
    let faults = NetworkFaults { seed, ..faults.parse().expect("faults") };
    let network = Rc::new(RefCell::new(VirtualNetwork::new(&faults, TRIP)));
    let device = device(&network);
    (network, device)
}

fn device(network: &Shared) -> Device {
    Device::from_transport(Box::new(VirtualTransport { network: Rc::clone(network), limit: LIMIT }))
}

/// The fault of the link in an error.
fn fault_of(error: &Error) -> Option<&UdpFault> {
    match error {
        Error::InJob { source, .. } => fault_of(source),
        Error::Link { source, .. } => source.fault(),
        _ => None,
    }
}

/// Does batches of jobs until `jobs` jobs have met a fault in their batch, and returns the number of jobs that ended
/// with an error. Panics at the first wrong mesh.
fn soak(faults: &str, jobs: usize, seed: u64) -> (usize, u64) {
    let mut random = Random(seed);
    let (mut met, mut failed, mut longest) = (0, 0, 0);
    while met < jobs {
        let (network, mut device) = connect(faults, random.next());
        let mut session = match device.session() {
            Ok(session) => session,
            Err(error) => {
                assert!(fault_of(&error).is_some() || matches!(error, Error::Timeout { .. }), "{error}");
                (met, failed) = (met + 1, failed + 1);
                continue;
            }
        };
        for _ in 0..4 {
            let sets: Vec<Vec<Point>> = (0..4)
                .map(|_| {
                    let count = [3, 40, 300, 1500][random.below(4) as usize];
                    random.points(3 + random.0 as usize % count, 1 << 12)
                })
                .collect();
            let (before, begun) = (network.borrow().met(), network.borrow().now());
            let solved = session.triangulate_batch(&sets, &Options::default());
            let has_met = network.borrow().met() > before;
            met += if has_met { sets.len() } else { 0 };
            longest = longest.max((network.borrow().now() - begun).as_millis() as u64);
            match solved {
                Ok(solved) => {
                    for (points, solution) in sets.iter().zip(solved) {
                        assert_eq!(solution.mesh, by_cpu(points).mesh, "seed {seed}, {faults}");
                    }
                }
                Err(error) => {
                    assert!(fault_of(&error).is_some() || matches!(error, Error::InJob { .. }), "{error}");
                    failed += sets.len();
                    break;
                }
            }
        }
    }
    (failed, longest)
}

/// The classes of faults, and the largest share of jobs, in percent, that may end with an error.
const CLASSES: [(&str, usize); 7] = [
    ("loss=0.02", 0),
    ("double=0.1", 0),
    ("swap=0.1", 0),
    ("delay=20", 0),
    ("flip=0.02", 0),
    ("loss=0.05,double=0.05,swap=0.05,delay=5,flip=0.05", 0),
    ("loss=0.3,flip=0.1,delay=100", 20),
];

fn soak_all(jobs: usize, seed: u64) {
    for (class, (faults, most)) in CLASSES.into_iter().enumerate() {
        let (failed, longest) = soak(faults, jobs, seed + class as u64);
        println!(
            "{faults}: {jobs} jobs met a fault, {failed} ended with an error, none wrong; longest batch {longest} ms"
        );
        assert!(failed * 100 <= most * jobs, "{faults}: {failed} of {jobs} jobs failed");
    }
}

#[test]
fn jobs_over_a_bad_network_end_with_the_right_mesh() {
    soak_all(32, 1);
}

/// The long run: `cargo test --release -p incircle --test it udp::faults::ten_thousand -- --ignored --nocapture`.
#[test]
#[ignore = "takes minutes"]
fn ten_thousand_jobs_over_a_bad_network() {
    soak_all(1500, 1000);
}

#[test]
fn a_second_host_hears_that_the_device_is_busy() {
    let (network, mut first) = connect("", 5);
    let points = Random(5).points(100, 1 << 12);
    first.session().expect("a session").triangulate(&points).expect("a mesh");
    // The second host keeps the first from speaking, so that only its own session counts.
    let other = incircle::transports::parts::UdpProtocol::new(incircle::transports::parts::UdpParams::of_random(99));
    let owned = network.borrow().board.session();
    let mut other = other;
    other.ask(&[incircle_protocol::Command::Hello], Duration::ZERO).expect("no fault yet");
    let mut network = network.borrow_mut();
    let from = std::net::SocketAddrV4::new(std::net::Ipv4Addr::new(10, 0, 0, 9), 1);
    for millisecond in 0..4000 {
        let now = Duration::from_millis(millisecond);
        let mut out = Vec::new();
        other.transmit(now, &mut out);
        out.iter().for_each(|datagram| network.board.take(from, false, datagram));
        while let Some((_, datagram)) = network.board.give() {
            other.receive(&datagram, now);
        }
    }
    assert!(matches!(other.check(), Err(UdpFault::Busy { .. })), "{:?}", other.check());
    assert_eq!(network.board.session(), owned);
}

#[test]
fn a_host_that_vanished_is_forgotten_and_the_next_one_served() {
    let (network, mut first) = connect("", 6);
    let points = Random(6).points(500, 1 << 12);
    first.session().expect("a session").triangulate(&points).expect("a mesh");
    network.borrow_mut().restart_host(77);
    let begun = network.borrow().now();
    let solution = device(&network).session().expect("a session").triangulate(&points).expect("a mesh");
    assert_eq!(solution.mesh, by_cpu(&points).mesh);
    assert!(network.borrow().now() - begun < Duration::from_millis(2500));
    std::mem::forget(first);
}

#[test]
fn a_pause_costs_no_job() {
    let (network, mut device) = connect("", 7);
    let points = Random(7).points(500, 1 << 12);
    let mut session = device.session().expect("a session");
    for pause in [100, 900, 1100, 2500, 60_000] {
        network.borrow_mut().rest(Duration::from_millis(pause));
        assert_eq!(session.triangulate(&points).expect("a mesh").mesh, by_cpu(&points).mesh, "{pause} ms");
    }
}

#[test]
fn a_cable_that_is_pulled_ends_the_job_with_a_sentence() {
    let (network, mut device) = connect("", 8);
    let points = Random(8).points(500, 1 << 12);
    let mut session = device.session().expect("a session");
    network.borrow_mut().is_cut = true;
    let error = session.triangulate(&points).expect_err("no cable");
    assert!(matches!(fault_of(&error), Some(UdpFault::Silent { .. } | UdpFault::Lost { .. })), "{error}");
    let (network, mut device) = connect("", 9);
    network.borrow_mut().is_cut = true;
    let error = device.session().err().expect("no cable");
    assert!(matches!(fault_of(&error), Some(UdpFault::Silent { .. })), "{error}");
}

/// Random datagrams, and datagrams of the host with changes, from a stranger and from the address of the host.
#[test]
fn hostile_datagrams_do_not_stop_the_device() {
    let (network, mut device) = connect("", 10);
    let points = Random(10).points(300, 1 << 12);
    let mut random = Random(11);
    network.borrow_mut().stranger = Some(Box::new(move |_| {
        let length = random.below(1480) as usize;
        let mut bytes: Vec<u8> = (0..length).map(|_| random.next() as u8).collect();
        if let Some(kind) = bytes.first_mut() {
            *kind = random.below(8) as u8;
        }
        if random.below(2) == 0 && bytes.len() > 20 {
            let words = random.below(20) as usize * 4;
            bytes.truncate(16 + words.min(bytes.len() - 16) / 4 * 4);
            let crc = incircle_model::serial::Crc32::of(&bytes);
            bytes.extend(crc.to_le_bytes());
        }
        Some(bytes)
    }));
    let mut session = device.session().expect("a session");
    for _ in 0..20 {
        assert_eq!(session.triangulate(&points).expect("a mesh").mesh, by_cpu(&points).mesh);
    }
    assert!(network.borrow().to_strangers > 0);
}
