//! Jobs over a network with faults, in virtual time: each ends with the right mesh or with an error that has a type.

use std::cell::RefCell;
use std::net::{Ipv4Addr, SocketAddrV4};
use std::rc::Rc;
use std::time::{Duration, Instant};

use crate::common::network::{VirtualNetwork, VirtualTransport};
use crate::common::{by_cpu, Random};
use incircle::transports::parts::{UdpParams, UdpProtocol};
use incircle::udp::UdpFault;
use incircle::{Device, Error, Options, Session, Transport};
use incircle_protocol::{Clear, Command, Layout, RecordRange};
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

/// Whether an error says that the link failed, or that it took too long.
fn is_of_the_link(error: &Error) -> bool {
    match error {
        Error::InJob { source, .. } => is_of_the_link(source),
        Error::Timeout { .. } => true,
        error => fault_of(error).is_some(),
    }
}

/// The result of many jobs.
#[derive(Debug, Default)]
struct Outcome {
    /// Jobs that met a fault in their batch, and jobs that ended with an error.
    met: usize,
    failed: usize,
    /// Milliseconds of the longest batch, in virtual time.
    longest: u128,
    /// Answers asked for again, and jobs sent again as a whole.
    repeated: u64,
    restarted: u64,
}

/// Does batches of jobs until `jobs` jobs have met a fault. Panics at the first wrong mesh.
fn soak(faults: &str, jobs: usize, seed: u64) -> Outcome {
    let (mut random, mut outcome) = (Random(seed), Outcome::default());
    while outcome.met < jobs {
        let (network, mut device) = connect(faults, random.next());
        match device.session() {
            Ok(mut session) => (0..4).try_for_each(|_| batch(&network, &mut session, &mut random, &mut outcome)),
            Err(error) => {
                assert!(is_of_the_link(&error), "{error}");
                (outcome.met, outcome.failed) = (outcome.met + 1, outcome.failed + 1);
                Err(())
            }
        }
        .unwrap_or_default();
        let statistics = network.borrow().statistics();
        outcome.repeated += statistics.repeated;
        outcome.restarted += statistics.restarted;
    }
    outcome
}

/// Does a batch of four jobs. Fails if the session cannot be used any more.
fn batch(network: &Shared, session: &mut Session<'_>, random: &mut Random, outcome: &mut Outcome) -> Result<(), ()> {
    let sets = [(); 4].map(|()| {
        let most = [3, 40, 300, 1500][random.below(4) as usize];
        random.points(3 + random.0 as usize % most, 1 << 12)
    });
    let (before, begun) = (network.borrow().met(), network.borrow().now());
    let solved = session.triangulate_batch(&sets, &Options::default());
    outcome.met += if network.borrow().met() > before { sets.len() } else { 0 };
    outcome.longest = outcome.longest.max((network.borrow().now() - begun).as_millis());
    let solved = solved.map_err(|error| {
        assert!(is_of_the_link(&error), "{error}");
        outcome.failed += sets.len();
    })?;
    for (points, solution) in sets.iter().zip(solved) {
        assert_eq!(solution.mesh, by_cpu(points).mesh);
    }
    Ok(())
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

/// Does `jobs` jobs of each class, and a quarter of that of the last and slowest class.
fn soak_all(jobs: usize, seed: u64) {
    for (class, (faults, most)) in CLASSES.into_iter().enumerate() {
        let jobs = if class + 1 == CLASSES.len() { jobs / 4 } else { jobs };
        let outcome = soak(faults, jobs, seed + class as u64);
        println!("{faults}: none wrong; {outcome:?}");
        assert!(outcome.failed * 100 <= most * jobs, "{faults}: {outcome:?}");
        // Both ways to bring back a lost answer were taken.
        let has_loss = faults.contains("loss");
        assert!(!has_loss || outcome.repeated > 0 && outcome.restarted > 0, "{faults}: {outcome:?}");
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
    soak_all(1600, 1000);
}

#[test]
fn a_second_host_hears_that_the_device_is_busy() {
    let (network, mut first) = connect("", 5);
    let points = Random(5).points(100, 1 << 12);
    first.session().expect("a session").triangulate(&points).expect("a mesh");
    let owned = network.borrow().board.session();
    let mut other = UdpProtocol::new(UdpParams::of_random(99));
    other.ask(&[Command::Hello], Duration::ZERO).expect("no fault yet");
    let mut network = network.borrow_mut();
    let from = SocketAddrV4::new(Ipv4Addr::new(10, 0, 0, 9), 1);
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

/// The next host waits for the silence of the first one, whatever the device was doing for that one: taking points,
/// inserting them, or giving answers.
#[test]
fn a_host_that_vanishes_in_mid_job_is_forgotten_and_the_next_one_served() {
    let (mut random, layout) = (Random(12), Layout { point_words: 1, record_words: 3 });
    let silence = Duration::from_secs(2);
    // A greeting and an `Opened` come before the first receipt; of answers there are some 26 datagrams.
    for datagrams in [3, 4, 5, 8, 20] {
        let (network, _) = connect("", 12);
        let mut first = VirtualTransport { network: Rc::clone(&network), limit: LIMIT };
        let points = random.points(3000, 1 << 16);
        let words: Vec<u32> = points.iter().map(|point| point.x | point.y << 16).collect();
        let range = RecordRange { first: 0, count: 5000 };
        let insert = Command::insert(&words[..], layout);
        let commands = [Command::Clear(Clear::one_mesh(0)), insert, Command::Triangles(range)];
        first.submit(&commands, Instant::now()).expect("no fault yet");
        network.borrow_mut().run_to_datagram(datagrams);
        let old = network.borrow().board.session();
        assert!(old.is_some() && network.borrow_mut().protocol.take_answer().is_none(), "in mid-job");
        network.borrow_mut().restart_host(78);
        let begun = network.borrow().now();
        let points = random.points(400, 1 << 12);
        let solution = device(&network).session().expect("a session").triangulate(&points).expect("a mesh");
        assert_eq!(solution.mesh, by_cpu(&points).mesh);
        let waited = network.borrow().now() - begun;
        assert!(waited > silence * 9 / 10 && waited < silence + Duration::from_millis(500), "{waited:?}");
        std::mem::forget(first);
    }
}

/// The host sends `Close` and `Open` together after a pause. A device answers one datagram at a time, so it drops the
/// `Open` if both come before it has sent the answer to the first.
#[test]
fn a_session_opens_anew_behind_a_close_that_takes_the_place_of_the_open() {
    let (network, _) = connect("", 8);
    let mut network = network.borrow_mut();
    let from = SocketAddrV4::new(Ipv4Addr::new(10, 0, 0, 9), 1);
    let mut host = UdpProtocol::new(UdpParams::of_random(98));
    // All that the host has to say arrives, and only then the device answers.
    let mut exchange = |host: &mut UdpProtocol, now: Duration| {
        let mut out = Vec::new();
        host.transmit(now, &mut out);
        out.iter().for_each(|datagram| network.board.take(from, false, datagram));
        network.board.work(1_000_000);
        while let Some((_, datagram)) = network.board.give() {
            host.receive(&datagram, now);
        }
        out.len()
    };
    let greets = |host: &mut UdpProtocol, now| host.ask(&[Command::Hello], now).expect("no fault");
    greets(&mut host, Duration::ZERO);
    for microsecond in 0..100_000 {
        exchange(&mut host, Duration::from_micros(microsecond));
        if host.take_answer().is_some() {
            break;
        }
    }
    assert!(host.is_open());
    let later = Duration::from_millis(1500);
    greets(&mut host, later);
    assert_eq!((exchange(&mut host, later), host.is_open()), (2, false), "`Close`, and an `Open` that is dropped");
    assert_eq!((exchange(&mut host, later), host.is_open()), (1, true), "`Open` follows at once");
    assert!(host.check().is_ok());
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
    assert!(matches!(fault_of(&error), Some(UdpFault::Lost { .. })), "{error}");
    let (network, mut device) = connect("", 9);
    network.borrow_mut().is_cut = true;
    let error = device.session().err().expect("no cable");
    assert!(matches!(fault_of(&error), Some(UdpFault::Silent { .. })), "{error}");
}

/// Random datagrams from a stranger: of any length, and those with a right check sum and a whole number of words.
#[test]
fn hostile_datagrams_do_not_stop_the_device() {
    let (network, mut device) = connect("", 10);
    let points = Random(10).points(300, 1 << 12);
    let mut random = Random(11);
    network.borrow_mut().stranger = Some(Box::new(move || {
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
        bytes
    }));
    let mut session = device.session().expect("a session");
    for _ in 0..20 {
        assert_eq!(session.triangulate(&points).expect("a mesh").mesh, by_cpu(&points).mesh);
    }
    assert!(network.borrow().to_strangers > 0);
}
