//! The library in front of a simulated board at the pins of its PHY: the exchange of the page, jobs over a network with
//! faults, and hostile frames. No fault may make a wrong mesh.

use std::cell::RefCell;
use std::net::{Ipv4Addr, SocketAddrV4};
use std::rc::Rc;
use std::time::{Duration, Instant};

use incircle::{Device, Error, Options, Point, Transport};
use incircle_model::udp::{ToDevice, ToHost};
use incircle_protocol::{Clear, Command, DeviceDatagram, HostDatagram, Layout, RecordRange, SMALL, STATUS_BUSY};
use incircle_sim::network::NetworkBoard;
use incircle_testbench::link::{EtherTransport, VirtualEther};
use incircle_testkit::{exchange_datagrams, NetworkFaults, SplitMix64};

/// Text of the page.
const PAGE: &str = include_str!("../../../../protocol/UDP.md");
const TRIP: Duration = Duration::from_micros(100);
/// Limit for an answer, in virtual time.
const LIMIT: Duration = Duration::from_secs(2);

fn board() -> NetworkBoard {
    NetworkBoard::new(SMALL).expect("the board is part of this build")
}

/// Bytes of the greeting with clock, FIFO, silence and Ethernet address, which the page shows for another board.
const LINK_BYTES: std::ops::Range<usize> = 8..28;

/// A datagram without the fields that depend on how far the core has come, and without the parameters of the board.
fn timeless(bytes: &[u8]) -> ToHost {
    let mut said = ToHost::from_bytes(bytes).expect("a sound datagram");
    said.header.free = 0;
    said.header.status &= !STATUS_BUSY;
    if said.kind() == DeviceDatagram::Hello {
        said.body[LINK_BYTES].fill(0);
    }
    said
}

/// Lets time pass until the board has been quiet for 20 microseconds.
fn rest(board: &mut NetworkBoard) -> Vec<(SocketAddrV4, Vec<u8>)> {
    let (mut said, mut quiet) = (Vec::new(), 0);
    while quiet < 20 {
        board.run(1000);
        quiet = if board.waiting() == 0 { quiet + 1 } else { 0 };
        while let Some(datagram) = board.receive() {
            said.push(datagram);
            quiet = 0;
        }
    }
    said
}

#[test]
fn the_board_says_what_the_page_shows() {
    let mut board = board();
    let host = |letter: char| SocketAddrV4::new(Ipv4Addr::new(192, 168, 1, letter as u8 - b'A' + 2), 50_000);
    let datagrams = exchange_datagrams(PAGE);
    let mut rest_of_page = &datagrams[..];
    while let Some((asked, behind)) = rest_of_page.split_first() {
        assert!(asked.goes_to_device);
        let answers = behind.iter().take_while(|datagram| !datagram.goes_to_device).count();
        board.send(host(asked.host), false, &asked.bytes);
        let said: Vec<_> = rest(&mut board).iter().map(|(to, bytes)| (*to, timeless(bytes))).collect();
        let expected = behind[..answers].iter().map(|answer| (host(answer.host), timeless(&answer.bytes)));
        assert_eq!(said, expected.collect::<Vec<_>>(), "to {:x?}", asked.bytes);
        rest_of_page = &behind[answers..];
    }
}

/// A network with these faults, and the device at its end.
fn connect(faults: &str, seed: u64) -> (Rc<RefCell<VirtualEther>>, Device) {
    let faults = NetworkFaults { seed, ..faults.parse().expect("faults") };
    let ether = Rc::new(RefCell::new(VirtualEther::new(board(), TRIP, &faults)));
    let device = device(&ether);
    (ether, device)
}

fn device(ether: &Rc<RefCell<VirtualEther>>) -> Device {
    Device::from_transport(Box::new(EtherTransport::new(Rc::clone(ether), LIMIT)))
}

/// Whether an error says that the link failed, or that it took too long.
fn is_of_the_link(error: &Error) -> bool {
    match error {
        Error::InJob { source, .. } => is_of_the_link(source),
        error => matches!(error, Error::Timeout { .. } | Error::Link { .. }),
    }
}

/// Does batches of three jobs over one network, and returns how many jobs met a fault and how many ended with an error.
/// Panics at a wrong mesh.
fn batches(faults: &str, seed: u64) -> (usize, usize) {
    let (ether, mut device) = connect(faults, seed);
    let (mut met, mut failed) = (0, 0);
    let mut random = SplitMix64::new(seed);
    let mut session = match device.session() {
        Ok(session) => session,
        Err(error) => {
            assert!(is_of_the_link(&error), "{faults}, {seed}: {error}");
            return (1, 1);
        }
    };
    for count in [3, 40, 150, 500] {
        let sets: [Vec<Point>; 3] = [(); 3].map(|()| random.points(count, 1 << 12));
        let before = ether.borrow().met();
        let solved = session.triangulate_batch(&sets, &Options::default());
        met += if ether.borrow().met() > before { sets.len() } else { 0 };
        match solved {
            Ok(solved) => {
                for (points, solution) in sets.iter().zip(solved) {
                    let mut cpu = Device::cpu(None);
                    let expected = cpu.session().unwrap().triangulate(points).unwrap();
                    assert!(solution.mesh == expected.mesh, "{faults}, {seed}: a wrong mesh");
                }
            }
            Err(error) => {
                assert!(is_of_the_link(&error), "{faults}, {seed}: {error}");
                failed += sets.len();
                break;
            }
        }
    }
    (met, failed)
}

#[test]
fn jobs_at_the_pins_survive_every_fault_of_the_network() {
    let classes = [
        ("", 1, 0),
        ("loss=0.05", 6, 0),
        ("double=0.1", 4, 0),
        ("swap=0.1", 4, 0),
        ("flip=0.05", 6, 0),
        ("loss=0.05,double=0.05,swap=0.05,flip=0.05", 6, 0),
    ];
    let mut all = 0;
    for (faults, runs, most) in classes {
        let outcomes = (0..runs).map(|seed| batches(faults, seed));
        let (met, failed) = outcomes.fold((0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1));
        println!("{faults}: {met} jobs met a fault, {failed} ended with an error, none was wrong");
        assert!(failed <= most, "{faults}: {failed} jobs failed");
        all += met;
    }
    assert!(all >= 60, "{all} jobs met a fault");
}

/// The long run: `cargo test --release -p incircle-testbench --test it links::ether -- --ignored --nocapture`.
#[test]
#[ignore = "takes an hour"]
fn thousands_of_jobs_at_the_pins() {
    for faults in ["loss=0.05", "double=0.1", "swap=0.1", "flip=0.05", "loss=0.05,double=0.05,swap=0.05,flip=0.05"] {
        let outcomes = (1000..1200).map(|seed| batches(faults, seed));
        let (met, failed) = outcomes.fold((0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1));
        println!("{faults}: {met} jobs met a fault, {failed} ended with an error, none was wrong");
        assert!(met > 200 && failed * 50 <= met, "{faults}: {met} jobs met a fault, {failed} failed");
    }
}

#[test]
#[ignore = "every clock of the silence takes a minute"]
fn a_host_that_vanishes_in_mid_job_is_forgotten_and_the_next_one_served() {
    let ether = Rc::new(RefCell::new(VirtualEther::new(board(), TRIP, &NetworkFaults::default())));
    let mut first = EtherTransport::new(Rc::clone(&ether), LIMIT);
    let layout = Layout { point_words: 1, record_words: 3 };
    let mut random = SplitMix64::new(6);
    let words: Vec<u32> = (0..900).map(|_| random.next_u64() as u32).collect();
    let range = RecordRange { first: 0, count: 1700 };
    let insert = Command::insert(&words[..], layout);
    let commands = [Command::Clear(Clear::one_mesh(0)), insert, Command::Triangles(range)];
    first.submit(&commands, Instant::now()).expect("no fault yet");
    // A greeting, an `Opened`, some receipts, and some of the eight datagrams of triangles.
    assert!(ether.borrow_mut().run_to_datagram(8, LIMIT), "the job goes on");
    ether.borrow_mut().restart_host(77);
    let begun = ether.borrow().now();
    let points: Vec<Point> = random.points(100, 1 << 12);
    let solution = device(&ether).session().expect("a session").triangulate(&points).expect("a mesh");
    assert!(solution.mesh == Device::cpu(None).session().unwrap().triangulate(&points).unwrap().mesh);
    let waited = ether.borrow().now() - begun;
    assert!(waited > Duration::from_millis(150) && waited < Duration::from_millis(600), "{waited:?}");
    std::mem::forget(first);
}

/// A frame of a stranger or of the host itself: noise, or a datagram with changes.
fn hostile(random: &mut SplitMix64) -> Vec<u8> {
    let most = [40, 100, 1473][random.below(3) as usize];
    let length = random.below(most) as usize;
    let mut bytes: Vec<u8> = (0..length).map(|_| random.below(256) as u8).collect();
    if let Some(kind) = bytes.first_mut() {
        // No `Open`: it would begin a session, which the host that comes later would have to wait for.
        *kind = [0, 1, 3, 4, 5, 6, 7][random.below(7) as usize];
    }
    match random.below(4) {
        0 => bytes,
        1 => {
            let kind = [HostDatagram::Hello, HostDatagram::Poll, HostDatagram::Data, HostDatagram::Close];
            let kind = kind[random.below(4) as usize];
            let words = vec![0xffff_ffff; [0, 1, 14, 360][random.below(4) as usize]];
            ToDevice { session: random.next_u64(), kind, number: random.below(3) as u32, words }.to_bytes()
        }
        _ => {
            bytes.truncate(bytes.len() / 4 * 4);
            let sum = incircle_model::serial::Crc32::of(&bytes).to_le_bytes();
            [bytes, sum.to_vec()].concat().into_iter().take(1472).collect()
        }
    }
}

/// Sends hostile datagrams to a board, then does a job with it.
fn survives(datagrams: usize, seed: u64) {
    let mut random = SplitMix64::new(seed);
    let mut board = board();
    for number in 0..datagrams {
        let from = SocketAddrV4::new(Ipv4Addr::new(10, 0, 0, 2 + random.below(3) as u8), 40_000);
        let bytes = hostile(&mut random);
        board.send(from, random.below(4) == 0, &bytes);
        if number % 8 == 7 {
            rest(&mut board);
        }
    }
    rest(&mut board);
    let ether = Rc::new(RefCell::new(VirtualEther::new(board, TRIP, &NetworkFaults::default())));
    let points: Vec<Point> = SplitMix64::new(seed).points(60, 1 << 12);
    let solution = device(&ether).session().expect("a session").triangulate(&points).expect("a mesh");
    let expected = Device::cpu(None).session().unwrap().triangulate(&points).unwrap();
    assert!(solution.mesh == expected.mesh);
}

#[test]
fn hostile_datagrams_do_not_stop_the_board() {
    survives(500, 3);
}

/// The long run: `cargo test --release -p incircle-testbench --test it links::ether -- --ignored --nocapture`.
#[test]
#[ignore = "takes an hour"]
fn a_million_hostile_datagrams_do_not_stop_the_board() {
    for part in 0..100 {
        survives(10_000, 100 + part);
    }
}
