//! Jobs on a sound line: every mesh has the bytes of the CPU triangulator.

use incircle_embedded::{Device, Point};
use incircle_model::serial::{core_identity, Instantly};
use incircle_model::ClockModel;
use incircle_protocol::{SMALL, TINY};
use incircle_testkit::{generate, Distribution};

use crate::rig::{ask, by_cpu, random_points, run, small, Board, End, PATIENCE};

#[test]
fn sets_of_every_kind_have_the_meshes_of_the_cpu() {
    let board = small();
    let mut device = Device::new(End(board.clone()), End(board.clone()));
    assert_eq!(device.greet().unwrap().capacity, 1024);
    for &distribution in Distribution::all() {
        for (count, bits) in [(9, 3), (200, 16), (1024, 16)] {
            let Ok(set) = generate(distribution, count, bits, 5) else { continue };
            let points: Vec<Point> = set.into_iter().map(|pair| pair.map(|value| value as u16)).collect();
            let name = distribution.name();
            assert_eq!(ask(&mut device, &points, PATIENCE), Ok(by_cpu(&points)), "{name} {count}");
        }
    }
    assert_eq!(board.borrow().overflows, 0);
}

#[test]
fn small_sets_with_many_duplicates_and_lines() {
    let board = small();
    let mut device = Device::new(End(board.clone()), End(board.clone()));
    for count in 0..60 {
        for (side, seed) in [(2, 1), (4, 2), (1 << 16, 3)] {
            let points = random_points(count, side, seed);
            assert_eq!(ask(&mut device, &points, PATIENCE), Ok(by_cpu(&points)), "{count} {side}");
        }
        let line: Vec<Point> = (0..count as u16).map(|k| [k * 37 % 23, 5 * (k * 37 % 23)]).collect();
        assert_eq!(ask(&mut device, &line, PATIENCE), Ok(by_cpu(&line)), "{count}");
    }
}

#[test]
fn more_points_than_distinct_ones_that_the_device_holds() {
    let points = random_points(4000, 20, 9);
    assert_eq!(run(&small(), &points), Ok(by_cpu(&points)));
}

/// The contexts of the core work on several points at once, and its records come in another order.
#[test]
fn a_core_with_contexts_by_clock() {
    for config in [TINY, SMALL] {
        let board = Board::new(core_identity(config), ClockModel::new(config).unwrap());
        let count = (config.points as usize).min(300);
        let points = random_points(count, 1 << 16, 4);
        assert_eq!(run(&board, &points), Ok(by_cpu(&points)), "{}", config.name);
    }
}

#[test]
fn a_device_with_wide_points_and_records() {
    let core = Instantly::new(20, 100_000, 64).unwrap();
    let points = random_points(700, 1 << 16, 6);
    assert_eq!(run(&Board::new(core.identity(), core), &points), Ok(by_cpu(&points)));
}

/// The driver says that a point costs about 16 bytes of the line and a thousand points a second and a half.
#[test]
fn a_thousand_points_pass_in_a_second_and_a_half() {
    let board = small();
    let mut device = Device::new(End(board.clone()), End(board.clone()));
    let points = random_points(1000, 1 << 16, 8);
    let since = board.borrow().nanoseconds;
    ask(&mut device, &points, PATIENCE).unwrap();
    let milliseconds = (board.borrow().nanoseconds - since) / 1_000_000;
    println!("1000 points: {milliseconds} ms, {:?} bytes there and back", board.borrow().bytes);
    assert!((1300..1700).contains(&milliseconds), "{milliseconds}");
}
