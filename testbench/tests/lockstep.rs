//! The core beside its model, every root port at every clock.

use incircle_model::Inputs;
use incircle_protocol::{Config, FULL, SMALL, TINY};
use incircle_testbench::lockstep::{Job, Lockstep, Mismatch, Stalls};

/// SplitMix64 (Steele, Lea, Flood 2014).
fn generator(seed: u64) -> impl FnMut() -> u64 {
    let mut state = seed;
    move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }
}

#[test]
fn quick() {
    let mut random = generator(1);
    let mut pair = Lockstep::new("core_tiny", TINY, 1);
    for k in 0..200 {
        let count = 1 + random() as usize % 10;
        let side = [3, 8, 65536][k % 3];
        let points: Vec<u32> = (0..count)
            .map(|_| (random() % side) as u32 | ((random() % side) as u32) << 16)
            .collect();
        let job = Job::of(&points, 100, TINY.points, TINY.ring);
        if let Err(e) = pair.run(&job, Stalls::ALL[k % 9], &mut random) {
            panic!("job {k}: {points:x?}\n{e}");
        }
    }
    println!("{}", pair.clocks());
}
