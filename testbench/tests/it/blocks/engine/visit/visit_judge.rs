//! Runs `VisitJudge` in Rust and in Verilog beside plain arithmetic: all three must agree in every clock.

use super::verdict_logic::points;
use super::visit_reader::record;
use crate::rig::drawing::{draw, When};
use crate::rig::stepper::bundles::{pack, TURNED};
use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::visit_model::{verdict_parts, word, Record, VERDICT_PARTS};
use incircle_hdl::engine::VisitJudge;
use incircle_testkit::SplitMix64;

named_ports!([] VisitJudge, [corners, p, turned], [verdict], clock);

const CYCLES: usize = 6_000;

const INFINITE: u64 = 0x7fff;

#[test]
fn visit_judge_answers_ten_clocks_after_the_corners() {
    const LATENCY: usize = 10;
    let mut numbers = SplitMix64::new(35);
    let cases: Vec<_> =
        (0..CYCLES).map(|_| (points(&mut numbers), record(&mut numbers), numbers.below(3) as usize)).collect();
    let stimuli = cases.iter().enumerate().map(|(cycle, (points, ..))| {
        // The record of the visit whose corners came before.
        let before = cycle.checked_sub(LATENCY).map(|before| &cases[before]);
        let (record, slot) = before.map_or((Record::default(), 0), |(_, record, slot)| (*record, *slot));
        let turned = record.turned(slot).pack_turned(slot, [false; 3], INFINITE);
        [&points.map(|point| u128::from(word(point)))[..], &[turned]].concat()
    });
    let mut seen = [0; 3];
    let mut cycle = 0usize;
    Stepper::new("visit_judge", VisitJudge::default(), 1).run(
        &["corners_r0", "corners_r1", "corners_r2", "p", "turned"],
        &VERDICT_PARTS,
        stimuli,
        |_| {
            let parts = cycle.checked_sub(LATENCY).map(|before| {
                let ([r0, r1, r2, p], record, slot) = cases[before];
                let verdict = record.verdict(slot, [r0, r1, r2], p, INFINITE);
                for (bit, count) in seen.iter_mut().enumerate() {
                    *count += usize::from(verdict >> bit & 1 == 1);
                }
                verdict_parts(verdict, slot, [r0, r1, r2], p).to_vec()
            });
            cycle += 1;
            parts.unwrap_or(vec![None; VERDICT_PARTS.len()])
        },
    );
    assert!(seen.iter().all(|count| *count > CYCLES / 50), "conflicts, located, on a corner: {seen:?}");
}

#[test]
fn visit_judge_shows_the_wave_of_its_header() {
    let mut turned = [0; 13];
    turned[3] = 9;
    let stimuli = [
        (0, "corners_r0", 2),
        (0, "corners_r1", 6),
        (0, "corners_r2", 4),
        (0, "p", 6),
        (10, "turned", pack(TURNED, turned)),
    ];
    let lanes = [
        ("r0", "corners_r0", 0, 32, When::At(&[0])),
        ("r1", "corners_r1", 0, 32, When::At(&[0])),
        ("r2", "corners_r2", 0, 32, When::At(&[0])),
        ("p", "p", 0, 32, When::At(&[0])),
        ("turned.n0", "turned", 45, 15, When::At(&[10])),
        ("walk_next", "verdict", 5, 15, When::At(&[10])),
        ("corner", "verdict", 2, 1, When::At(&[10])),
    ];
    draw("visit_judge", VisitJudge::default(), &stimuli, 12, &lanes).assert_drawn_in("visit_judge");
}
