//! Jobs at rates above the first one, and rates that do not work.

use incircle_embedded::{Device, Error};
use incircle_protocol::FIRST_RATE;
use incircle_testkit::SplitMix64;

use crate::rig::{ask, by_cpu, fast, random_points, End, Fate, PATIENCE};

#[test]
fn a_higher_rate_makes_a_job_quicker() {
    let points = random_points(1000, 1 << 16, 8);
    for (rate, most) in [(FIRST_RATE, 1700), (1_000_000, 200), (3_000_000, 80), (12_000_000, 30)] {
        let board = fast();
        let mut device = Device::new(End(board.clone()), End(board.clone())).with_rate(rate, End::set_rate);
        device.greet().unwrap();
        for _ in 0..2 {
            let since = board.borrow().nanoseconds;
            assert_eq!(ask(&mut device, &points, PATIENCE), Ok(by_cpu(&points)), "{rate}");
            let milliseconds = (board.borrow().nanoseconds - since) / 1_000_000;
            println!("1000 points at {rate} bits per second: {milliseconds} ms");
            assert!(milliseconds < most, "{rate}: {milliseconds} ms");
            assert_eq!(board.borrow().rate, FIRST_RATE);
        }
    }
}

#[test]
fn a_rate_that_does_not_work_is_left_after_two_jobs() {
    let points = random_points(100, 1 << 16, 8);
    let board = fast();
    board.borrow_mut().usable = 1_000_000;
    let mut device = Device::new(End(board.clone()), End(board.clone())).with_rate(3_000_000, End::set_rate);
    for is_slow in [true, true, false, false] {
        let since = board.borrow().nanoseconds;
        assert_eq!(ask(&mut device, &points, PATIENCE), Ok(by_cpu(&points)));
        let milliseconds = (board.borrow().nanoseconds - since) / 1_000_000;
        assert_eq!((2000..4000).contains(&milliseconds), is_slow, "{milliseconds}");
    }
}

#[test]
fn a_rate_beyond_the_device_is_not_asked_for() {
    let points = random_points(100, 1 << 16, 8);
    let board = fast();
    let mut device = Device::new(End(board.clone()), End(board.clone())).with_rate(20_000_000, End::set_rate);
    assert_eq!(ask(&mut device, &points, PATIENCE), Ok(by_cpu(&points)));
}

/// A line that is noisy only above the first rate, or at every rate.
#[test]
fn noise_at_a_higher_rate_ends_in_the_right_mesh_or_in_an_error_of_its_own() {
    let points = random_points(100, 1 << 16, 2);
    let expected = by_cpu(&points);
    for (rarity, least) in [(1000, 40), (100, 30)] {
        let mut right = 0;
        for seed in 0..40 {
            let board = fast();
            let mut random = SplitMix64::new(1000 * rarity + seed);
            board.borrow_mut().faults = Box::new(move |_, _| match random.below(2 * rarity) {
                0 => Fate::Lost,
                1 => Fate::Flipped(1 << random.below(8)),
                _ => Fate::Passes,
            });
            let mut device = Device::new(End(board.clone()), End(board.clone())).with_rate(3_000_000, End::set_rate);
            match ask(&mut device, &points, PATIENCE) {
                Ok(found) => {
                    assert_eq!(found, expected, "{rarity} {seed}");
                    right += 1;
                }
                Err(Error::Device(fault)) => panic!("{rarity} {seed}: {fault}"),
                Err(_) => {}
            }
            assert_eq!(board.borrow().rate, FIRST_RATE, "{rarity} {seed}");
        }
        println!("one byte in {rarity}: {right} of 40 right");
        assert!(right >= least, "{rarity}: {right}");
    }
}

/// A job that ended at a higher rate leaves the device there. The next job waits until the device has forgotten it.
#[test]
fn a_job_after_a_timeout_begins_afresh() {
    let points = random_points(500, 1 << 16, 8);
    let board = fast();
    let mut device = Device::new(End(board.clone()), End(board.clone())).with_rate(3_000_000, End::set_rate);
    device.greet().unwrap();
    for milliseconds in [6, 10, 20] {
        assert_eq!(ask(&mut device, &points, milliseconds), Err(Error::Timeout { milliseconds }));
        assert_eq!(ask(&mut device, &points, PATIENCE), Ok(by_cpu(&points)));
    }
}
