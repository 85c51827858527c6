//! Resets the card, or lets it fall off the bus, in the middle of whole jobs: the mesh must be right or the error
//! typed, and no call may hang.

use std::sync::Arc;
use std::time::Duration;

use incircle::transports::parts::CardFiles;
use incircle::{Error, ErrorKind, Mesh, Point};
use incircle_testbench::card::vfio::{Descriptor, Transfers, VfioCard, VfioDriver, Way};
use incircle_testbench::link::{is_one_mesh, random_points};

use super::rig::{card, opened, triangulate, within, Meddled, Meddling, LIMIT};

/// The place at which a job is disturbed.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// True for a place in the answers, false for one in the commands.
    in_answers: bool,
    /// Number of bytes before the place.
    after: usize,
    /// True if a transfer is under way at that moment.
    is_during: bool,
}

/// Places before each command of a job and before each answer.
fn places() -> impl Iterator<Item = Place> {
    let ways = [(false, [0, 8, 16, 2000]), (true, [0, 8, 40, 2000])];
    ways.into_iter().flat_map(|(in_answers, after)| {
        let both = after.into_iter().flat_map(|after| [(after, false), (after, true)]);
        both.map(move |(after, is_during)| Place { in_answers, after, is_during })
    })
}

/// Runs a job that is disturbed once.
fn disturbed(driver: &VfioDriver, place: Place, points: &[Point], meddling: Meddling) -> Result<Mesh, Error> {
    let CardFiles { commands, answers, registers } = driver.files(LIMIT).unwrap();
    let files = if place.in_answers {
        let answers = Box::new(Meddled::new(answers, place.after, place.is_during, meddling));
        CardFiles { commands, answers, registers }
    } else {
        let commands = Box::new(Meddled::new(commands, place.after, place.is_during, meddling));
        CardFiles { commands, answers, registers }
    };
    triangulate(&mut opened(files)?, points)
}

#[test]
fn a_reset_of_the_device_in_mid_job_gives_the_right_mesh_or_says_so() {
    within(|| {
        let mut right = 0;
        for (seed, place) in (1..).zip(places()) {
            let card = card(64);
            let driver = Arc::new(VfioDriver::open(card.path()).unwrap());
            let resets = Arc::clone(&driver);
            let points = random_points(600, seed);
            match disturbed(&driver, place, &points, Box::new(move || resets.reset().unwrap())) {
                Ok(mesh) => {
                    assert!(is_one_mesh(&mesh, &incircle::triangulate(&points).unwrap()), "{place:?}");
                    right += 1;
                }
                Err(error) => {
                    let kinds = [ErrorKind::Link, ErrorKind::Device, ErrorKind::Timeout];
                    assert!(kinds.contains(&error.kind()), "{place:?}: {error}");
                }
            }
            // After that the card is as new.
            let points = random_points(300, seed);
            let mesh = triangulate(&mut opened(driver.files(LIMIT).unwrap()).unwrap(), &points).unwrap();
            assert!(is_one_mesh(&mesh, &incircle::triangulate(&points).unwrap()), "{place:?}, afterwards");
        }
        assert!(right > 0, "no job was retried with success");
    });
}

#[test]
fn a_card_that_vanishes_in_mid_job_is_a_typed_error() {
    within(|| {
        for place in places() {
            let card: Arc<VfioCard> = Arc::new(card(64));
            let driver = VfioDriver::open(card.path()).unwrap();
            let vanishes = Arc::clone(&card);
            let error = disturbed(&driver, place, &random_points(600, 2), Box::new(move || vanishes.vanish()))
                .map(drop)
                .expect_err("the card should be gone");
            assert!(
                error.kind() == ErrorKind::Link && error.to_string().contains("the card is gone"),
                "{place:?}: {error}"
            );
        }
    });
}

#[test]
fn a_run_on_a_card_that_is_gone_fails_as_such() {
    within(|| {
        let card = card(64);
        let driver = VfioDriver::open(card.path()).unwrap();
        let transfers = Transfers::new(driver.link(), Way::ToHost, LIMIT).unwrap();
        let destination = transfers.memory().address() + 4096;
        transfers.describe(&[Descriptor { length: 64, destination, ..Descriptor::default() }]).unwrap();
        transfers.begin(transfers.memory().address());
        card.vanish();
        // Error 19 is ENODEV, no such device.
        assert_eq!(transfers.wait().unwrap_err().raw_os_error(), Some(19));
    });
}

#[test]
fn a_card_that_is_gone_cannot_be_opened() {
    within(|| {
        let card = card(64);
        let driver = VfioDriver::open(card.path()).unwrap();
        let files = driver.files(LIMIT).unwrap();
        let path = card.path().to_owned();
        drop(card);
        let error = opened(files).err().expect("it is gone");
        assert!(error.kind() == ErrorKind::Link && error.to_string().contains("the card is gone"), "{error}");
        let error = VfioDriver::open(&path).err().expect("nobody is there").to_string();
        assert!(error.contains("the card does not answer"), "{error}");
    });
}

#[test]
fn a_card_that_takes_nothing_is_a_typed_error() {
    within(|| {
        let card = card(64);
        let driver = VfioDriver::open(card.path()).unwrap();
        let mut device = opened(driver.files(Duration::from_millis(300)).unwrap()).unwrap();
        // DMA is switched off by this write, and nothing switches it on again.
        driver.set_config(4, 2);
        let error = triangulate(&mut device, &random_points(100, 1)).map(drop).expect_err("it stands");
        assert!(matches!(error.kind(), ErrorKind::Link | ErrorKind::Timeout), "{error}");
    });
}
