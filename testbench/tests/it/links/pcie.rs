//! Runs the real driver in front of a simulated card, in memory and through the files of a directory: jobs, each class
//! of faults, a card that falls off the bus, two clients, and cards that lie.

use std::time::{Duration, Instant};

use incircle::pcie::PcieTransport;
use incircle::transports::parts::calls_left_behind;
use incircle::{Device, Error, ErrorKind, Mesh, Options, Point};
use incircle_model::stream::{ModelCore, StreamModel};
use incircle_protocol::SMALL;
use incircle_sim::pcie::{Beats, CardLie, PinCard};
use incircle_testbench::card::{MemoryCard, MountedCard};
use incircle_testbench::link::{is_one_mesh, random_points};

/// Deadline of a job.
const LIMIT: Duration = Duration::from_secs(60);
/// The driver stops waiting for a transfer after this time, far less than XDMA's ten seconds.
const QUICK: &str = "timeout-ms=400,";

/// The way in which the driver reaches the card.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    Memory,
    Files,
}

const WAYS: [Way; 2] = [Way::Memory, Way::Files];

fn device(beat_bits: u32) -> Box<dyn Beats> {
    Box::new(StreamModel::new(ModelCore::of(SMALL).unwrap(), beat_bits))
}

/// Opens a card. In a directory, the card lives as long as the first value is kept.
fn opened(way: Way, beat_bits: u32, faults: &str) -> (Option<MountedCard>, Result<Device, Error>) {
    opened_with(way, device(beat_bits), &format!("{QUICK}{faults}"))
}

fn opened_with(way: Way, device: Box<dyn Beats>, faults: &str) -> (Option<MountedCard>, Result<Device, Error>) {
    let faults = faults.parse().unwrap();
    match way {
        Way::Memory => {
            let card = MemoryCard::new(device, &faults);
            let transport = PcieTransport::new("pcie:memory".to_owned(), card.files());
            (None, transport.map(|transport| Device::from_transport(Box::new(transport))))
        }
        Way::Files => {
            let card = MountedCard::new(device, &faults).unwrap();
            let device = Device::open(&card.address());
            (Some(card), device)
        }
    }
}

fn triangulate(device: &mut Device, points: &[Point]) -> Result<Mesh, Error> {
    let options = Options::default().timeout(LIMIT);
    device.session_within(LIMIT)?.triangulate_with(points, &options).map(|solution| solution.mesh)
}

/// Runs a job with these faults.
fn job(way: Way, beat_bits: u32, faults: &str, points: &[Point]) -> Result<Mesh, Error> {
    let (_card, device) = opened(way, beat_bits, faults);
    triangulate(&mut device?, points)
}

fn must_be_right(way: Way, beat_bits: u32, faults: &str, seed: u64) {
    let points = random_points(600, seed);
    let mesh = job(way, beat_bits, faults, &points).unwrap_or_else(|error| panic!("{way:?}, {faults}: {error}"));
    assert!(is_one_mesh(&mesh, &incircle::triangulate(&points).unwrap()), "{way:?}, {faults}: another mesh");
}

/// Checks that the job ends in time with an error of one of these kinds, and that its text has this sentence.
fn must_fail(way: Way, faults: &str, kinds: &[ErrorKind], sentence: &str) {
    let begun = Instant::now();
    let error = job(way, 64, faults, &random_points(600, 2)).map(drop).expect_err(faults);
    assert!(kinds.contains(&error.kind()), "{way:?}, {faults}: {:?}: {error}", error.kind());
    assert!(error.to_string().contains(sentence), "{way:?}, {faults}: {error}");
    assert!(begun.elapsed() < LIMIT, "{way:?}, {faults}: {error}");
}

#[test]
fn jobs_with_beats_of_both_widths() {
    for way in WAYS {
        for bits in [64, 128] {
            must_be_right(way, bits, "", 1);
        }
    }
}

#[test]
fn transfers_that_end_early_or_wait() {
    for way in WAYS {
        for (seed, faults) in
            (1..).zip(["short-read=0.5", "short-write=0.5", "short-read=1,short-write=1", "stall=0.3"])
        {
            must_be_right(way, 64, faults, seed);
            must_be_right(way, 128, faults, seed);
        }
    }
}

#[test]
fn an_engine_that_times_out_once_costs_no_job() {
    for way in WAYS {
        for (seed, strike) in (1..).zip(["eio", "errno-512", "timeout"]) {
            for after in [0, 100, 2000, 4000, 6500] {
                must_be_right(way, 64, &format!("{strike}={after}"), seed);
            }
        }
    }
}

#[test]
fn an_engine_that_times_out_again_is_a_typed_error() {
    for way in WAYS {
        let what = if way == Way::Memory { "errno 512" } else { "errno 5" };
        must_fail(way, "errno-512=2000,times=9999", &[ErrorKind::Link], what);
        must_fail(way, "eio=2000,times=9999", &[ErrorKind::Link], "DMA engine timed out");
    }
}

#[test]
fn a_card_that_vanishes_is_a_typed_error() {
    for way in WAYS {
        for after in [0, 100, 2000, 4000, 6500] {
            must_fail(way, &format!("vanish={after}"), &[ErrorKind::Link], "the card is gone");
        }
    }
}

#[test]
fn a_reset_in_mid_job_gives_the_right_mesh_or_says_so() {
    for way in WAYS {
        for after in [40, 100, 1000, 2000, 2500, 4000, 6500] {
            let faults = format!("reset={after}");
            let points = random_points(600, after);
            let options = Options::default().timeout(Duration::from_secs(5));
            let (_card, device) = opened(way, 64, &faults);
            let mut device = device.unwrap();
            let result =
                device.session_within(LIMIT).and_then(|mut session| session.triangulate_with(&points, &options));
            match result {
                Ok(solution) => {
                    assert!(is_one_mesh(&solution.mesh, &incircle::triangulate(&points).unwrap()), "{way:?}, {faults}")
                }
                Err(error) => {
                    let kinds = [ErrorKind::Link, ErrorKind::Device, ErrorKind::Timeout];
                    assert!(kinds.contains(&error.kind()), "{way:?}, {faults}: {error}");
                }
            }
            // The next user finds the card as new.
            drop(device);
        }
    }
}

#[test]
fn cards_that_lie_are_found_out() {
    for way in WAYS {
        for (lie, kind, sentence) in [
            ("magic", ErrorKind::DeviceNotFound, "begin with"),
            ("stream", ErrorKind::Device, "version 2.0 of the stream device"),
            ("protocol", ErrorKind::Device, "version 9.0 of the protocol"),
            ("capacity", ErrorKind::Device, "4294967295 points"),
            ("beat", ErrorKind::Device, "bits of a beat reads 96"),
            ("report", ErrorKind::Device, "1000000"),
            ("index", ErrorKind::Device, "wrongly"),
            ("length", ErrorKind::Device, "words"),
            ("endless", ErrorKind::Device, "0x5a5a5a5a"),
            ("status", ErrorKind::Device, "an answer of 2 words"),
        ] {
            must_fail(way, &format!("liar={lie}"), &[kind], sentence);
        }
        // Registers that disagree with the core only bound the answers differently: the core's own identity counts.
        must_be_right(way, 64, "liar=identity", 2);
    }
    assert_eq!(CardLie::ALL.len(), 11);
}

#[test]
fn a_session_does_job_after_job_through_files() {
    let (_card, device) = opened(Way::Files, 128, "");
    let mut device = device.unwrap();
    let mut session = device.session().unwrap();
    for (seed, count) in (1..).zip([3, 1000, 10, 0, 700]) {
        let points = random_points(count, seed);
        let solution = session.triangulate(&points).unwrap();
        assert!(is_one_mesh(&solution.mesh, &incircle::triangulate(&points).unwrap()));
    }
}

#[test]
fn two_clients_at_once_are_told_and_the_card_is_free_afterwards() {
    let (card, first) = opened(Way::Files, 64, "");
    let (card, mut first) = (card.unwrap(), first.unwrap());
    let error = Device::open(&card.address()).err().expect("the card is locked");
    assert_eq!(error.kind(), ErrorKind::DeviceNotFound, "{error}");
    assert!(error.to_string().contains("is locked: end the other program"), "{error}");
    let points = random_points(50, 4);
    assert!(is_one_mesh(&triangulate(&mut first, &points).unwrap(), &incircle::triangulate(&points).unwrap()));
    drop(first);
    let begun = Instant::now();
    let mut second = loop {
        match Device::open(&card.address()) {
            Ok(device) => break device,
            Err(error) if begun.elapsed() > LIMIT => panic!("{error}"),
            // The threads of the first device close its files in their own time.
            Err(_) => std::thread::sleep(Duration::from_millis(10)),
        }
    };
    assert!(is_one_mesh(&triangulate(&mut second, &points).unwrap(), &incircle::triangulate(&points).unwrap()));
}

#[test]
fn a_call_that_hangs_is_left_behind_in_time_and_keeps_its_card() {
    let (card, device) = opened(Way::Files, 64, "hang=3000");
    let (card, mut device) = (card.unwrap(), device.unwrap());
    let before = calls_left_behind();
    let begun = Instant::now();
    let options = Options::default().timeout(Duration::from_secs(1));
    let result = device.session().unwrap().triangulate_with(&random_points(600, 2), &options);
    let error = result.expect_err("the call should hang");
    assert!(matches!(error.kind(), ErrorKind::Timeout | ErrorKind::Link), "{error}");
    drop(device);
    assert!(begun.elapsed() < Duration::from_secs(10), "{:?}", begun.elapsed());
    assert!(calls_left_behind() > before);
    let error = Device::open(&card.address()).err().expect("the lock should be kept");
    assert!(error.to_string().contains("a call of this one that has not returned"), "{error}");
    drop(card);
}

/// Runs jobs on the Verilated card with all its AXI ports driven, one after another in a session.
fn jobs_at_the_pins(way: Way, beat_bits: u32, faults: &str) {
    let pins: Box<dyn Beats> = Box::new(PinCard::new(SMALL, beat_bits).unwrap());
    let (_card, device) = opened_with(way, pins, &format!("timeout-ms=5000,{faults}"));
    let mut device = device.unwrap();
    let mut session = device.session_within(LIMIT).unwrap();
    assert_eq!(session.identity().contexts, SMALL.contexts);
    let options = Options::default().timeout(LIMIT);
    for (seed, count) in (1..).zip([3, 1000, 200]) {
        let points = random_points(count, seed);
        let solution = session.triangulate_with(&points, &options).unwrap_or_else(|error| panic!("{faults}: {error}"));
        assert!(is_one_mesh(&solution.mesh, &incircle::triangulate(&points).unwrap()), "{faults}");
    }
}

#[test]
fn jobs_at_the_pins_with_beats_of_both_widths() {
    for bits in [64, 128] {
        jobs_at_the_pins(Way::Files, bits, "");
        jobs_at_the_pins(Way::Memory, bits, "short-read=0.3,short-write=0.3");
    }
}

#[test]
fn faults_at_the_pins_that_cost_no_job() {
    for strike in ["eio=100", "eio=2000", "errno-512=6000", "timeout=4000,timeout-ms=800"] {
        jobs_at_the_pins(Way::Files, 64, strike);
    }
}

#[test]
fn a_card_at_its_pins_vanishes() {
    let pins: Box<dyn Beats> = Box::new(PinCard::new(SMALL, 64).unwrap());
    let (_card, device) = opened_with(Way::Files, pins, "timeout-ms=1000,vanish=3000");
    let error = triangulate(&mut device.unwrap(), &random_points(900, 1)).expect_err("it is gone");
    assert!(error.kind() == ErrorKind::Link && error.to_string().contains("the card is gone"), "{error}");
}
