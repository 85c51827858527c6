//! Runs the netlist that synthesis makes for an ECP5, cell by cell, beside the model at every clock: jobs, stalls,
//! resets in the middle of a job. Both initial states are covered, the one after configuration and random ones.
//!
//! These tests cover synthesis, the primitives behind `INCIRCLE_ECP5` and their modes, as far as the models in
//! `testbench/cells` state the behaviour of the cells. Timing is left to place and route.

use crate::rig::lockstep::{ordered, word, Rig};
use incircle_protocol::{Counter, SMALL};
use incircle_testbench::lockstep::{Job, Stalls};
use incircle_testkit::{Distribution, SplitMix64};

const NETLIST: &str = "netlist_small";

#[test]
fn jobs_on_the_netlist() {
    let mut rig = Rig::new(NETLIST, SMALL, 1);
    let mut random = SplitMix64::new(1);
    for (k, &distribution) in Distribution::all().iter().enumerate() {
        rig.start_anew(k as u32);
        let mut points = ordered(distribution, 300, [16, 10, 6][k % 3], k as u64, 4);
        // Points that come in no order make large cavities, and their contexts meet often.
        if k % 2 == 1 {
            random.shuffle(&mut points[3..]);
        }
        rig.run(&points, 120, k as u32 % 5, Stalls::ALL[k % 9]);
    }
    // Fills the core to its capacity, and sends one point more.
    rig.run(&ordered(Distribution::Uniform, 1025, 16, 1, 4), 1025, 0, Stalls::NONE);
    // Jobs side by side, with a mesh for each context.
    for (jobs, stalls) in [(4, Stalls::NONE), (3, Stalls::ALL[4])] {
        let spans = [word(0, 0), word(300, 0), word(0, 300)].repeat(jobs as usize);
        let points = [spans, ordered(Distribution::Uniform, 400, 8, 2, 1)].concat();
        rig.run_commands(&Job::batch_of(&points, 150, jobs, SMALL).commands, stalls);
    }
    for counter in [Counter::Insertions, Counter::Duplicates, Counter::Refused, Counter::Aborts] {
        assert!(rig.counted(counter) > 0, "{counter:?}");
    }
    rig.expect_clocks(200_000);
}

#[test]
fn jobs_out_of_the_configured_state() {
    let mut rig = Rig::configured(NETLIST, SMALL);
    rig.run(&ordered(Distribution::Kuzmin, 200, 12, 3, 4), 200, 0, Stalls::NONE);
    rig.run(&ordered(Distribution::Lattice, 100, 16, 4, 2), 30, 2, Stalls::ALL[4]);
    rig.expect_clocks(10_000);
}

#[test]
fn resets_in_mid_job_on_the_netlist() {
    let mut rig = Rig::new(NETLIST, SMALL, 2);
    let mut random = SplitMix64::new(2);
    for round in 0..12 {
        let points: Vec<u32> = (0..60).map(|_| word(random.below(1 << 16), random.below(1 << 16))).collect();
        rig.run_and_reset(&points, 1 + random.below(9000), Stalls::ALL[round % 9]);
        rig.run(&points[..20], 20, 0, Stalls::NONE);
    }
    rig.expect_clocks(20_000);
}
