//! Faults of the line: a job ends in the mesh of the CPU, or in an error of its own that no sound device is blamed for.

use std::convert::Infallible;

use incircle_embedded::Error;
use incircle_testkit::SplitMix64;

use crate::rig::{by_cpu, random_points, run, small, Fate};

/// Whether noise alone can end in this error.
fn is_of_noise(error: Error<Infallible>) -> bool {
    matches!(
        error,
        Error::Silent | Error::Noise { .. } | Error::Lost { .. } | Error::Reset { .. } | Error::Timeout { .. }
    )
}

/// One byte of a job after another is lost, changed or doubled.
#[test]
fn a_fault_of_any_byte_leaves_no_trace() {
    let points = random_points(40, 1 << 16, 1);
    let expected = by_cpu(&points);
    let board = small();
    assert_eq!(run(&board, &points).as_ref(), Ok(&expected));
    let lengths = board.borrow().bytes;
    for to_host in [false, true] {
        for place in 0..lengths[usize::from(to_host)] {
            for fate in [Fate::Lost, Fate::Twice, Fate::Flipped(0x10), Fate::Flipped(0xff)] {
                let board = small();
                board.borrow_mut().faults =
                    Box::new(
                        move |direction, byte| {
                            if (direction, byte) == (to_host, place) {
                                fate
                            } else {
                                Fate::Passes
                            }
                        },
                    );
                assert_eq!(run(&board, &points).as_ref(), Ok(&expected), "{to_host} {place} {fate:?}");
            }
        }
    }
}

#[test]
fn noise_ends_in_the_right_mesh_or_in_an_error_of_its_own() {
    const JOBS: u64 = 40;
    let points = random_points(100, 1 << 16, 2);
    let expected = by_cpu(&points);
    // One byte in this many is lost, doubled or changed.
    for (rarity, least) in [(100_000, JOBS), (10_000, JOBS), (1000, JOBS), (100, JOBS / 2), (10, 0)] {
        let mut right = 0;
        for seed in 0..JOBS {
            let board = small();
            let mut random = SplitMix64::new(1000 * rarity + seed);
            board.borrow_mut().faults = Box::new(move |_, _| match random.below(3 * rarity) {
                0 => Fate::Lost,
                1 => Fate::Twice,
                2 => Fate::Flipped(1 << random.below(8)),
                _ => Fate::Passes,
            });
            match run(&board, &points) {
                Ok(found) => {
                    assert_eq!(found, expected, "{rarity} {seed}");
                    right += 1;
                }
                Err(error) => assert!(is_of_noise(error), "{rarity} {seed}: {error}"),
            }
        }
        println!("one byte in {rarity}: {right} of {JOBS} right");
        assert!(right >= least, "{rarity}: {right} of {JOBS}");
    }
}

/// Gaps of up to 40 bytes in both directions, as a loose plug makes them.
#[test]
fn gaps_leave_no_trace() {
    let points = random_points(200, 1 << 16, 3);
    let expected = by_cpu(&points);
    for seed in 0..30 {
        let board = small();
        let mut random = SplitMix64::new(seed);
        let mut gap = [0u32; 2];
        board.borrow_mut().faults = Box::new(move |to_host, _| {
            let left = &mut gap[usize::from(to_host)];
            if *left == 0 && random.once_in(2000) {
                *left = random.below_u32(40);
            }
            *left = left.saturating_sub(1);
            if *left > 0 {
                Fate::Lost
            } else {
                Fate::Passes
            }
        });
        assert_eq!(run(&board, &points).as_ref(), Ok(&expected), "{seed}");
    }
}
