//! Runs `AnswerWords` in Rust and in Verilog beside the protocol as `incircle-protocol` states it: all three must agree
//! over random commands, and counts of a mesh that change in every clock.

use crate::rig::answer_words::{commands, percent, Asked};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::commands::AnswerWords;
use incircle_protocol::LATENCY_BUCKETS;
use incircle_testkit::SplitMix64;

named_ports!(
    AnswerWords,
    [
        opcode,
        capacity,
        contexts,
        engines,
        ring_capacity,
        tally,
        insertions,
        duplicates,
        records,
        index,
        counter,
        latency,
        chooses
    ],
    [word],
    clock
);

#[test]
fn answer_words_follow_the_protocol() {
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("answer_words", AnswerWords::default(), 1);
    let mut compared = [0; 3];
    for (opcode, _, clocks) in commands(&mut random) {
        // Counters and buckets come from outside, a clock after their index.
        let mut asked_before: Vec<(Asked, usize)> = vec![];
        let mut chosen = None;
        for clock in 0..clocks {
            let asked = Asked { opcode, ..Asked::random(&mut random) };
            let words = [8, LATENCY_BUCKETS as u64][random.below(2) as usize];
            let index = random.below(words) as usize;
            let report = asked.report;
            for (port, value) in [
                ("opcode", u32::from(asked.opcode)),
                ("capacity", asked.capacity),
                ("contexts", asked.contexts),
                ("engines", asked.engines),
                ("ring_capacity", asked.ring),
                ("arrived", report.arrived),
                ("refused", report.refused),
                ("insertions", report.inserted),
                ("duplicates", report.duplicates),
                ("records", report.records),
                ("index", index as u32),
                ("counter", asked.counter),
                ("latency", asked.latency),
            ] {
                block.set(port, value);
            }
            let chooses = percent(&mut random, 70);
            block.set("chooses", chooses);
            block.settle();
            if let Some(word) = chosen {
                block.expect("word", word);
                compared[usize::from(opcode == 3) + 2 * usize::from(opcode == 1)] += 1;
            }
            if chooses && clock >= 1 {
                let (before, index) = &asked_before[clock - 1];
                let payload = Asked { counter: asked.counter, latency: asked.latency, ..*before }.answer().payload;
                chosen = payload.and_then(|words| words.get(*index).copied());
            }
            block.edge();
            asked_before.push((asked, index));
        }
    }
    assert!(compared.iter().all(|times| *times > 50), "{compared:?}");
}
