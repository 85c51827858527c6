//! Runs the real driver in front of a simulated board, through a pseudo-terminal and in real time: a job, each class of
//! faults, an unplugged cable, a killed host, two clients, and devices that lie.

use std::time::{Duration, Instant};

use incircle::serial::{greet, Address};
use incircle::{Device, Error, ErrorKind, Mesh, Options, Point};
use incircle_protocol::{DUAL, SMALL};
use incircle_testbench::link::{is_one_mesh, random_points, Detail, Served};

/// Factor by which the board runs slower than real time, for the board and for the driver.
const PINS_SLOW: u32 = 100;
const BYTES_SLOW: u32 = 25;
const RATE: u32 = 12_000_000;
/// Deadline of a job, in real time.
const LIMIT: Duration = Duration::from_secs(120);

fn served(detail: Detail, faults: &str) -> Served {
    let slow = if detail == Detail::Pins { PINS_SLOW } else { BYTES_SLOW };
    Served::new(detail, SMALL, faults, slow).unwrap()
}

/// Opens the device, does the job and closes it.
fn triangulate(address: &str, points: &[Point]) -> Result<Mesh, Error> {
    let options = Options::default().timeout(LIMIT);
    Device::open(address)?.session_within(LIMIT)?.triangulate_with(points, &options).map(|solution| solution.mesh)
}

/// Checks that the job ends with the right mesh.
fn must_be_right(address: &str, points: usize, seed: u64, what: &str) {
    let points = random_points(points, seed);
    let begun = Instant::now();
    let mesh = triangulate(address, &points).unwrap_or_else(|error| panic!("{what}: {error}"));
    assert!(is_one_mesh(&mesh, &incircle::triangulate(&points).unwrap()), "{what}: another mesh");
    assert!(begun.elapsed() < LIMIT, "{what}: {:?}", begun.elapsed());
}

/// Faults of every class, so frequent that a job of this size meets some.
const CLASSES: [&str; 12] = [
    "ber=2e-4",
    "drop=2e-3",
    "double=2e-3",
    "swap=2e-3",
    "drop-frame=0.1",
    "double-frame=0.1",
    "swap-frame=0.1",
    "truncate=0.1",
    "babble=0.2",
    "stall=0.1,stall-ms=20",
    "silence-after=1000,silence-ms=30",
    "ber=1e-4,drop-frame=0.05,babble=0.05,direction=to-host,seed=7",
];

/// Runs `count` jobs with each class in turn.
fn survive(detail: Detail, classes: &[&str], points: usize) {
    for (seed, faults) in (1..).zip(classes) {
        let mut board = served(detail, faults);
        must_be_right(&board.address(RATE), points, seed, faults);
        let figures = board.stop().unwrap();
        println!("{faults}: {figures:?}");
        assert!(figures.faults > 0, "the line made no fault of {faults}: {figures:?}");
    }
}

#[test]
fn a_job_through_the_pins_and_the_next_one() {
    let mut board = served(Detail::Pins, "");
    must_be_right(&board.address(RATE), 100, 1, "first");
    must_be_right(&board.address(3_000_000), 60, 2, "second, at another rate");
    let figures = board.stop().unwrap();
    assert!(figures.slow_down.is_some() && figures.faults == 0, "{figures:?}");
    println!("{figures:?}");
}

/// A serial line carries one job at a time, so the engines of a chip work in turns.
#[test]
fn a_batch_on_a_chip_of_two_engines() {
    for faults in ["", "ber=1e-4,drop-frame=0.05"] {
        let mut board = Served::new(Detail::Bytes, DUAL, faults, BYTES_SLOW).unwrap();
        let mut device = Device::open(&board.address(RATE)).unwrap();
        let mut session = device.session_within(LIMIT).unwrap();
        assert_eq!((session.identity().engines, session.identity().capacity), (2, DUAL.points));
        let jobs: Vec<_> = (0..6).map(|job| random_points(30 * job as usize, job)).collect();
        let solutions = session.triangulate_batch(&jobs, &Options::default().timeout(LIMIT)).unwrap();
        for (solution, points) in solutions.iter().zip(&jobs) {
            assert!(is_one_mesh(&solution.mesh, &incircle::triangulate(points).unwrap()), "{} points", points.len());
        }
        drop(device);
        let figures = board.stop().unwrap();
        assert_eq!(figures.faults > 0, !faults.is_empty(), "{figures:?}");
    }
}

/// Runs the command, which must succeed.
fn command(arguments: &[&str]) {
    let arguments = ["incircle"].into_iter().chain(arguments.iter().copied()).map(std::ffi::OsString::from);
    assert_eq!(incircle_cli::run(arguments), std::process::ExitCode::SUCCESS);
}

#[test]
fn the_command_writes_the_same_files_through_the_pins() {
    let board = served(Detail::Pins, "");
    let folder = std::env::temp_dir().join(format!("incircle-link-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = |name: &str| folder.join(name).display().to_string();
    let (points, model, serial) = (file("points.csv"), file("model.obj"), file("serial.obj"));
    command(&["generate", "kuzmin", "-n", "90", "-o", &points]);
    command(&["triangulate", &points, "-o", &model, "--backend", "model"]);
    command(&["triangulate", &points, "-o", &serial, "--backend", &board.address(RATE)]);
    assert_eq!(std::fs::read(&model).unwrap(), std::fs::read(&serial).unwrap());
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn faults_of_bits_and_bytes_at_the_pins() {
    survive(Detail::Pins, &CLASSES[..4], 80);
}

#[test]
fn faults_of_frames_at_the_pins() {
    survive(Detail::Pins, &CLASSES[4..8], 80);
}

#[test]
fn faults_of_time_at_the_pins() {
    survive(Detail::Pins, &CLASSES[8..], 80);
}

#[test]
fn larger_jobs_survive_faults_without_bits() {
    survive(Detail::Bytes, &CLASSES, 400);
}

#[test]
fn bit_errors_at_the_pins() {
    // At the lowest rates so few bits meet no error, and the jobs do not count as faulty.
    for (ber, jobs, least) in [("ber=1e-6", 3, 0), ("ber=1e-5", 3, 0), ("ber=1e-4", 3, 1), ("ber=3e-4", 1, 1)] {
        let mut board = served(Detail::Pins, ber);
        for seed in 0..jobs {
            must_be_right(&board.address(RATE), 60, seed, ber);
        }
        let figures = board.stop().unwrap();
        assert!(figures.faults >= least, "{ber}: {figures:?}");
    }
}

/// Time on the board must go on while it is at rest: no session is open, and its greeting is held up on the line.
#[test]
fn time_goes_on_while_a_reply_is_on_the_line() {
    const SLOW: u32 = 10;
    let mut board = Served::new(Detail::Bytes, SMALL, "stall=1,stall-ms=400,direction=to-host", SLOW).unwrap();
    let address = Address { slow: SLOW, ..Address::of_port(board.path().display().to_string()) };
    greet(&address, Duration::from_secs(12)).unwrap_or_else(|error| panic!("{error}"));
    let figures = board.stop().unwrap();
    assert!(figures.faults > 0, "{figures:?}");
}

#[test]
fn a_pulled_cable_is_a_typed_error_and_the_next_job_runs() {
    let board = served(Detail::Pins, "unplug-after=1500,unplug-ms=300");
    let error = triangulate(&board.address(RATE), &random_points(300, 1)).expect_err("the cable was pulled");
    assert_eq!(error.kind(), ErrorKind::Link, "{error}");
    assert!(error.to_string().contains("was the cable pulled?"), "{error}");
    let begun = Instant::now();
    while !board.path().exists() && begun.elapsed() < LIMIT {
        std::thread::sleep(Duration::from_millis(20));
    }
    must_be_right(&board.address(RATE), 50, 2, "after the cable was plugged in");
}

#[test]
fn silence_for_ever_is_a_typed_error() {
    let board = served(Detail::Bytes, "silence-after=3000,direction=to-host");
    let begun = Instant::now();
    let error = triangulate(&board.address(RATE), &random_points(500, 1)).expect_err("nothing came");
    assert!(matches!(error.kind(), ErrorKind::Link | ErrorKind::Timeout), "{error}");
    assert!(begun.elapsed() < LIMIT, "{error}");
}

#[test]
fn two_clients_at_once_are_told() {
    let board = served(Detail::Pins, "");
    let address = board.address(RATE);
    let mut first = Device::open(&address).unwrap();
    let mut session = first.session_within(LIMIT).unwrap();
    let error = Device::open(&address).err().expect("the port is taken");
    assert_eq!(error.kind(), ErrorKind::DeviceNotFound, "{error}");
    assert!(error.to_string().contains("another program uses it"), "{error}");
    let points = random_points(50, 4);
    let solution = session.triangulate(&points).unwrap();
    assert!(is_one_mesh(&solution.mesh, &incircle::triangulate(&points).unwrap()));
    drop(first);
    must_be_right(&address, 50, 5, "after the first client");
}

#[test]
fn devices_that_lie_are_found_out() {
    let what = [
        ("liar=version", ErrorKind::Device, "version 2.0 of the link"),
        ("liar=protocol", ErrorKind::Device, "version 9.0 of the protocol"),
        ("liar=capacity", ErrorKind::Device, "4294967295 points"),
        ("liar=index", ErrorKind::Device, "wrongly"),
        ("liar=endless", ErrorKind::Device, "has more than"),
        ("liar=credit", ErrorKind::Device, "65535 free bytes"),
        ("liar=report", ErrorKind::Device, "1000000"),
    ];
    for (lie, kind, sentence) in what {
        let board = served(Detail::Bytes, lie);
        let error = triangulate(&board.address(RATE), &random_points(50, 4)).expect_err(lie);
        assert_eq!(error.kind(), kind, "{lie}: {error}");
        assert!(error.to_string().contains(sentence), "{lie}: {error}");
    }
}

#[test]
fn a_device_of_another_version_is_refused_at_the_pins() {
    let board = served(Detail::Pins, "liar=version");
    let error = triangulate(&board.address(RATE), &random_points(50, 4)).expect_err("another version");
    assert!(error.to_string().contains("version 2.0 of the link"), "{error}");
    assert!(error.to_string().contains("update"), "{error}");
}
