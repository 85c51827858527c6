//! Runs `FinishedPoints` in Rust and in Verilog beside a list of finished points: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::FinishedPoints;
use incircle_testkit::SplitMix64;

named_ports!(
    FinishedPoints,
    [reset, clears, arrived, seeds, commit_ends, solo_ends, duplicate, has_no_start, all_rest],
    [is_quiet, finishes],
    clock
);

/// Inputs of `FinishedPoints` in a clock.
#[derive(Clone, Copy, Debug, Default)]
struct Finishing {
    reset: bool,
    clears: bool,
    arrived: u64,
    seeds: bool,
    commit_ends: bool,
    solo_ends: bool,
    duplicate: bool,
    has_no_start: bool,
    all_rest: bool,
}

/// A list of finished points, and its length as the block knows it.
#[derive(Default)]
struct Finished {
    points: Vec<&'static str>,
    /// Length of the list a clock ago.
    counted: u64,
    /// True if the length differed from the number of points that had come.
    is_behind: bool,
}

/// Runs one clock of the block and of the list, and returns whether nothing is left to do.
fn finished_points_clock(block: &mut Stepper<FinishedPoints>, finished: &mut Finished, now: &Finishing) -> bool {
    for (port, value) in [
        ("reset", now.reset),
        ("clears", now.clears),
        ("seeds", now.seeds),
        ("commit_ends", now.commit_ends),
        ("solo_ends", now.solo_ends),
        ("duplicate", now.duplicate),
        ("has_no_start", now.has_no_start),
        ("all_rest", now.all_rest),
    ] {
        block.set(port, value);
    }
    block.set("arrived", now.arrived);
    block.settle();
    block.expect("finishes", now.seeds || now.commit_ends || now.solo_ends || now.duplicate);
    let is_quiet = now.all_rest && (now.has_no_start || !finished.is_behind);
    if block.clocks() > 0 {
        block.expect("is_quiet", is_quiet);
    }
    block.edge();
    finished.is_behind = !now.reset && finished.counted != now.arrived;
    finished.counted = finished.points.len() as u64;
    if now.seeds {
        finished.points.extend(["seed"; 3]);
    }
    finished.points.extend((now.commit_ends || now.solo_ends).then_some("inserted"));
    finished.points.extend(now.duplicate.then_some("duplicate"));
    if now.reset || now.clears {
        finished.points.clear();
        finished.counted = 0;
    }
    is_quiet
}

#[test]
fn finished_points_counts_every_finished_point_once() {
    let mut random = SplitMix64::new(71);
    let mut block = Stepper::new("finished_points", FinishedPoints::default(), 1);
    let mut finished = Finished::default();
    let (mut most, mut both) = (0, 0);
    for clock in 0..20_000 {
        let mut one_in = |times: u64| random.below(times) == 0;
        // First triangles come before all other points; in a batch there are several.
        let seeds = finished.points.len() < 72 && finished.points.iter().all(|what| *what == "seed") && one_in(8);
        let inserts = !seeds && one_in(3);
        let is_solo = one_in(4);
        let near = if one_in(2) { 0 } else { 1 };
        let now = Finishing {
            reset: clock == 0 || one_in(2000),
            clears: one_in(2000),
            seeds,
            commit_ends: inserts && !is_solo,
            solo_ends: inserts && is_solo,
            duplicate: !(seeds || inserts && is_solo) && one_in(3),
            has_no_start: one_in(4),
            all_rest: !one_in(4),
            arrived: match random.below(3) {
                0 => random.below(5),
                1 => random.below(1 << 15),
                _ => finished.points.len() as u64 + near,
            },
        };
        finished_points_clock(&mut block, &mut finished, &now);
        most = most.max(finished.points.len());
        both += usize::from(now.commit_ends && now.duplicate);
    }
    assert!(most > 500 && both > 500, "{most} {both}");
}

#[test]
fn finished_points_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("finished_points", FinishedPoints::default(), 1);
    let mut finished = Finished::default();
    finished_points_clock(&mut block, &mut finished, &Finishing { reset: true, ..Finishing::default() });
    let mut wave = Wave::default();
    for clock in 0..16u64 {
        let now = Finishing {
            arrived: [0, 1, 2, 3, 3, 3, 3, 3, 3, 4].get(clock as usize).copied().unwrap_or(5),
            all_rest: !matches!(clock, 4..6 | 11..14),
            has_no_start: clock < 4,
            seeds: clock == 7,
            commit_ends: clock == 12,
            duplicate: clock == 12,
            ..Finishing::default()
        };
        let is_quiet = finished_points_clock(&mut block, &mut finished, &now);
        wave.take(&[
            ("arrived", Cell::Number(now.arrived.into())),
            ("all_rest", Cell::Bit(now.all_rest)),
            ("has_no_start", Cell::Bit(now.has_no_start)),
            ("seeds", Cell::Bit(now.seeds)),
            ("commit_ends", Cell::Bit(now.commit_ends)),
            ("duplicate", Cell::Bit(now.duplicate)),
            ("finishes", Cell::Bit(now.seeds || now.commit_ends || now.duplicate)),
            ("is_quiet", Cell::Bit(is_quiet)),
        ]);
    }
    wave.assert_drawn_in("finished_points");
}
