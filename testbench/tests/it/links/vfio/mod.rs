//! Runs the library's own driver in front of a card that is a vfio-user device: jobs through its
//! windows, DMA, interrupts and reset, resets and losses of the card in the middle of a job, and
//! the device itself, register by register.

mod device;
mod faults;
mod interrupts;
mod rig;

use incircle::{Options, Point};
use incircle_protocol::{StreamRegister, SMALL};
use incircle_sim::pcie::{Beats, PinCard};
use incircle_testbench::card::vfio::{VfioCard, VfioDriver};
use incircle_testbench::link::{is_one_mesh, random_points};

use rig::{card, opened, triangulate, within, LIMIT};

/// Runs jobs one after another in a session on this card; none of their interrupts may be lost.
fn jobs(card: &VfioCard, counts: &[usize]) {
    let driver = VfioDriver::open(card.path()).unwrap();
    let mut device = opened(driver.files(LIMIT).unwrap()).unwrap();
    let mut session = device.session_within(LIMIT).unwrap();
    assert_eq!(session.identity().capacity, SMALL.points);
    let options = Options::default().timeout(LIMIT);
    for (seed, &count) in (1..).zip(counts) {
        let points = random_points(count, seed);
        let solution = session.triangulate_with(&points, &options).unwrap_or_else(|error| panic!("{count}: {error}"));
        assert!(is_one_mesh(&solution.mesh, &incircle::triangulate(&points).unwrap()), "{count} points");
    }
    assert_eq!(driver.untold(), 0);
}

#[test]
fn jobs_with_beats_of_both_widths() {
    for bits in [64, 128] {
        within(move || jobs(&card(bits), &[1, 3, 1000, 10, 0, 1024]));
    }
}

#[test]
fn jobs_of_a_batch_go_one_behind_the_other() {
    within(|| {
        let card = card(128);
        let driver = VfioDriver::open(card.path()).unwrap();
        let mut device = opened(driver.files(LIMIT).unwrap()).unwrap();
        let mut session = device.session_within(LIMIT).unwrap();
        let jobs: Vec<Vec<Point>> =
            (1..).zip([1000, 3, 700, 1, 1024, 400, 0]).map(|(k, n)| random_points(n, k)).collect();
        let options = Options::default().timeout(LIMIT);
        let meshes = session.triangulate_batch(&jobs, &options).unwrap();
        assert_eq!(meshes.len(), jobs.len());
        for (solution, points) in meshes.iter().zip(&jobs) {
            assert!(is_one_mesh(&solution.mesh, &incircle::triangulate(points).unwrap()), "{} points", points.len());
        }
        assert_eq!(driver.untold(), 0);
    });
}

#[test]
fn jobs_at_the_pins() {
    for bits in [64, 128] {
        within(move || {
            let pins = move || -> Box<dyn Beats> { Box::new(PinCard::new(SMALL, bits).unwrap()) };
            let card = VfioCard::new(Box::new(pins)).unwrap();
            jobs(&card, &[3, 1000]);
            // A reset of the device is one of the bus: the counters begin anew, while a
            // reset by the register keeps them.
            let driver = VfioDriver::open(card.path()).unwrap();
            let beats = || driver.user(StreamRegister::CommandBeats.offset());
            for seed in 1..=2 {
                assert_eq!(beats(), 0);
                let points = random_points(300, seed);
                let mesh = triangulate(&mut opened(driver.files(LIMIT).unwrap()).unwrap(), &points).unwrap();
                assert!(is_one_mesh(&mesh, &incircle::triangulate(&points).unwrap()));
                assert!(beats() > 0);
                driver.reset().unwrap();
            }
        });
    }
}

#[test]
fn the_next_host_finds_the_card_as_new() {
    within(|| {
        let card = card(64);
        for seed in 1..=3 {
            let driver = VfioDriver::open(card.path()).unwrap();
            assert_eq!(driver.user(StreamRegister::CommandBeats.offset()), 0);
            let points = random_points(200, seed);
            let mut device = opened(driver.files(LIMIT).unwrap()).unwrap();
            let mesh = triangulate(&mut device, &points).unwrap();
            assert!(is_one_mesh(&mesh, &incircle::triangulate(&points).unwrap()));
            assert!(driver.user(StreamRegister::CommandBeats.offset()) > 0);
        }
    });
}
