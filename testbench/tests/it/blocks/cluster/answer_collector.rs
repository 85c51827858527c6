//! Runs `AnswerCollector` in Rust and in Verilog among engines that the test plays: every answer must come whole and
//! once, the answers of an engine in their order, and none may wait for ever.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::cluster::AnswerCollector;
use incircle_protocol::{answer_header, Opcode, Status};
use incircle_testkit::SplitMix64;

named_ports!(
    AnswerCollector,
    [reset, offers, beat0, beat1, beat2, beat3, response.ready],
    [takes, response.valid, response.data, response.both, response.last, stuck],
    clock
);

/// A beat of an answer: data, both, last.
type Beat = (u64, bool, bool);

/// The beats of a random answer, and whether it says `Stuck`.
fn answer(random: &mut SplitMix64) -> (Vec<Beat>, bool) {
    let is_stuck = random.below(60) == 0;
    let status = if is_stuck { Status::Stuck } else { [Status::Ok, Status::Full][random.below(2) as usize] };
    let beats = random.below(4) as usize;
    // The words behind the header look like headers that say `Stuck`.
    let rest = u64::from(answer_header(7, Status::Stuck));
    let mut all = vec![(u64::from(answer_header(Opcode::Insert as u8, status)) | 9 << 32, true, beats == 0)];
    all.extend((1..=beats).map(|place| (rest | random.next_u64() << 32, random.below(2) == 0, place == beats)));
    (all, is_stuck)
}

#[test]
fn answer_collector_keeps_answers_whole() {
    let mut random = SplitMix64::new(46);
    let mut block = Stepper::new("answer_collector", AnswerCollector::default(), 1);
    let mut engines: [VecDeque<Beat>; 4] = Default::default();
    // Whether an engine offers its first beat, and since when.
    let mut offered: [Option<usize>; 4] = [None; 4];
    // The engine whose answer has begun and not ended.
    let mut open: Option<usize> = None;
    let mut stuck = 0_u32;
    let mut says_stuck: [VecDeque<bool>; 4] = Default::default();
    let (mut ended, mut longest) = ([0; 4], 0);
    // Number of clocks in a row in which words are on offer, and none of them comes out between two answers.
    let mut held_up = 0;
    for clock in 0..20_000 {
        let reset = clock == 0 || random.below(3000) == 0;
        let mut offers = 0;
        for engine in 0..4 {
            if engines[engine].is_empty() && random.below(20) == 0 {
                let (beats, is_stuck) = answer(&mut random);
                engines[engine].extend(beats);
                says_stuck[engine].push_back(is_stuck);
            }
            // A beat that is on offer stays.
            if offered[engine].is_none() && !engines[engine].is_empty() && random.below(3) > 0 {
                offered[engine] = Some(clock);
            }
            let beat = offered[engine].map(|_| engines[engine][0]);
            let (data, both, last) = beat.unwrap_or((random.next_u64(), true, true));
            offers |= u32::from(beat.is_some()) << engine;
            // The fields of the bundle `OfferedBeat`, the first in its lowest bits.
            let bits = u128::from(data) | u128::from(both) << 64 | u128::from(last) << 65;
            block.set(&format!("beat{engine}"), bits);
        }
        block.set("offers", offers);
        let ready = random.below(100) < [90, 30][clock / 5000 % 2];
        block.set("reset", reset);
        block.set("response_ready", ready);
        block.settle();
        let takes = if clock > 0 { block.get("takes") as u32 & offers } else { 0 };
        let takes: Vec<usize> = (0..4).filter(|engine| takes >> engine & 1 == 1).collect();
        if clock > 0 {
            block.expect("stuck", stuck);
            let holds_up = open.is_none() && offers > 0 && !block.is("response_valid");
            held_up = if holds_up { held_up + 1 } else { 0 };
            assert!(held_up <= 2, "words on offer do not come out, a reset before or not");
            assert!(takes.len() <= 1, "one engine at a time");
            assert_eq!(block.is("response_valid") && ready, !takes.is_empty());
            if let Some(engine) = open {
                assert!(takes.iter().all(|&taken| taken == engine), "an answer is whole");
            }
        }
        for &engine in &takes {
            let (data, both, last) = engines[engine].pop_front().expect("a beat");
            block.expect("response_data", data);
            block.expect("response_both", both);
            block.expect("response_last", last);
            longest = longest.max(clock - offered[engine].take().expect("an offer"));
            if open.is_none() && says_stuck[engine].pop_front() == Some(true) {
                stuck |= 1 << engine;
            }
            open = (!last).then_some(engine);
            ended[engine] += u32::from(last);
        }
        block.edge();
        if reset {
            (engines, offered, open, stuck) = (Default::default(), [None; 4], None, 0);
            (says_stuck, held_up) = (Default::default(), 0);
        }
    }
    assert!(ended.iter().all(|&answers| answers > 400), "{ended:?}");
    assert!(longest < 300, "an answer waited {longest} clocks");
}
