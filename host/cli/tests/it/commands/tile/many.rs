//! Many sets in tiles of several sizes, triangulated by several back ends: the bytes of the run in memory.

use super::{array, tiles};
use crate::common::Scratch;
use incircle_cli::generate::{Distribution, SplitMix64};

/// The back ends that do the tiles. A tile of up to 16 bits fits them all.
const BACKENDS: [&str; 4] = ["cpu", "model", "clock", "clock?config=quad"];

/// Kinds of sets that no distribution has.
const DEGENERATE: u64 = 6;

/// Writes the set of this number to `p.npy` and returns its number of points.
fn write_set(scratch: &Scratch, number: u64, random: &mut SplitMix64) -> u64 {
    let count = [1 + random.below(12), 1 + random.below(120), 200 + random.below(800)][number as usize % 3];
    let kind = number % (Distribution::ALL.len() as u64 + DEGENERATE);
    if let Some(set) = Distribution::ALL.get(kind as usize) {
        let (name, bits, seed) = (set.name(), 10 + random.below(7), random.below(1 << 30));
        scratch.run(&format!("generate {name} -n {count} --bits {bits} --seed {seed} -o p.npy")).ok();
        return count;
    }
    let (x, y, side) = (random.below(60_000) as i64, random.below(1 << 40) as i64, 2 + random.below(30) as i64);
    let mut below = |most: i64| random.below(most as u64) as i64;
    let points: Vec<[i64; 2]> = (0..count as i64)
        .map(|k| match kind - Distribution::ALL.len() as u64 {
            0 => [x, y],
            1 => [x, y + below(side * 40)],
            2 => [x + below(side * 40), y],
            3 => [x + k % (side * 30), y - 2 * (k % (side * 30))],
            4 => [x + below(side), y + below(side)],
            // Two crowded corners far apart, which most cuts divide unevenly.
            _ => [x + below(4) + 65_000 * (k % 2), y + below(4)],
        })
        .collect();
    scratch.write("p.npy", array(&points));
    count
}

/// Asserts that tiles of at most `most` points, done by each back end in turn, give the bytes of `right.npy`.
fn compare(scratch: &Scratch, most: u64, what: &str) -> usize {
    scratch.run(&format!("tile split p.npy --points {most} -o t -q")).ok();
    let count = tiles(scratch, "t");
    for first in 0..BACKENDS.len() {
        for tile in 0..count {
            // From one round to the next each tile has another back end, and its neighbours have others again.
            let backend = BACKENDS[(first + tile) % BACKENDS.len()];
            scratch.run(&format!("tile local t/{tile} -q --backend {backend}")).ok();
        }
        scratch.run("tile join t -o m.npy -q --memory 64K").ok();
        assert!(scratch.bytes("m.npy") == scratch.bytes("right.npy"), "{what}, tiles of {most}, round {first}");
        for tile in 0..count {
            std::fs::remove_file(scratch.path(&format!("t/{tile}.local"))).expect("the tile is there");
        }
    }
    std::fs::remove_dir_all(scratch.path("t")).expect("the folder is there");
    count
}

/// Compares sets, each in one piece by every back end, and in tiles of three sizes.
fn run(sets: u64) {
    let (scratch, mut random, mut cut) = (Scratch::new(), SplitMix64::new(21), 0);
    for number in 0..sets {
        let count = write_set(&scratch, number, &mut random);
        let what = format!("set {number} of {count} points");
        scratch.run("triangulate p.npy -o right.npy -q").ok();
        for backend in BACKENDS {
            scratch.run(&format!("triangulate p.npy -o m.npy -q --memory 32M --backend {backend}")).ok();
            assert!(scratch.bytes("m.npy") == scratch.bytes("right.npy"), "{what} by {backend}");
        }
        let sizes = [count, 1 + count / 3, 1 + count / 8];
        cut += sizes.map(|most| compare(&scratch, most, &what)).iter().filter(|&&tiles| tiles > 1).count();
    }
    assert!(cut as u64 > sets, "only {cut} times was a set cut");
    assert_eq!(scratch.files(), ["m.npy", "p.npy", "right.npy"]);
}

#[test]
fn some_sets_have_the_bytes_of_the_run_in_memory() {
    run(12);
}

#[test]
#[ignore = "takes as long as the variable INCIRCLE_SETS says"]
fn many_sets_have_the_bytes_of_the_run_in_memory() {
    let sets = std::env::var("INCIRCLE_SETS").ok().and_then(|text| text.parse().ok());
    run(sets.unwrap_or(200));
}
