//! Runs `RecordStream` in Rust and in Verilog beside the layout that the protocol states: all three must agree, while
//! idle clocks, back-pressure and resets come in between.

use std::collections::VecDeque;

use crate::rig::record_beats::{beats_of, leaves_no_rest, Beat, Columns, Form};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::commands::RecordStream;
use incircle_testkit::SplitMix64;

named_ports!(
    RecordStream,
    [reset, starts, count, vertices_alone, has_short_ids, has_rests, comes, record, takes],
    [has_room, valid, beat],
    clock
);

#[test]
fn stream_keeps_every_beat_whatever_is_taken() {
    for (seed, ready) in [(42, 100), (43, 50), (44, 3)] {
        let mut random = SplitMix64::new(seed);
        let mut block = Stepper::new("record_stream", RecordStream::default(), 1);
        for run in 0..60 {
            let form = Form::random(&mut random);
            let records: Vec<Columns> = (0..1 + random.below(80)).map(|_| Columns::random(&mut random)).collect();
            let latency = 1 + random.below(RecordStream::PATIENCE as u64) as usize;
            for reset in [run == 0, false] {
                block.set("reset", reset);
                block.set("starts", !reset);
                block.set("count", records.len() as u32);
                form.set(&mut block);
                block.set("comes", false);
                block.set("takes", false);
                block.settle();
                block.edge();
            }
            block.set("starts", false);
            let mut expected = beats_of(&records, form);
            let mut under_way: VecDeque<Option<Columns>> = vec![None; latency].into();
            let mut rest = records.iter().copied().enumerate();
            let (mut clock, mut may_ask) = (0, true);
            while !expected.is_empty() {
                // `has_room` follows registers only, so `takes` may still change.
                block.set("takes", false);
                let next = under_way.pop_front().flatten();
                block.set("comes", next.is_some());
                next.unwrap_or_else(|| Columns::random(&mut random)).set(&mut block);
                block.settle();
                let asked = if may_ask && block.is("has_room") { rest.next() } else { None };
                may_ask = asked.is_none_or(|(place, _)| leaves_no_rest(place, form));
                under_way.push_back(asked.map(|(_, record)| record));
                let takes = block.is("valid") && random.below(100) < ready;
                if block.is("valid") {
                    assert_eq!(Beat::of(block.get("beat")), expected[0]);
                }
                block.set("takes", takes);
                block.settle();
                block.edge();
                if takes {
                    expected.pop_front();
                }
                clock += 1;
                assert!(clock < 40_000, "no end");
            }
            block.settle();
            assert!(!block.is("valid"), "nothing is left");
        }
    }
}
