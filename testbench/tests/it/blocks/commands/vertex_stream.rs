//! Runs `VertexStream` in Rust and in Verilog beside the layout that the protocol states: all three must agree, while
//! idle clocks, back-pressure and resets come in between.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::vertex_beats::{beats_of, set_vertices, vertices, Beat};
use incircle_hdl::commands::VertexStream;
use incircle_testkit::SplitMix64;

named_ports!(VertexStream, [reset, starts, count, comes, v0, v1, v2, takes], [has_room, valid, beat], clock);

#[test]
fn stream_keeps_every_beat_whatever_is_taken() {
    for (seed, ready) in [(42, 100), (43, 50), (44, 3)] {
        let mut random = SplitMix64::new(seed);
        let mut block = Stepper::new("vertex_stream", VertexStream::default(), 1);
        for run in 0..60 {
            let records: Vec<[u32; 3]> = (0..1 + random.below(80)).map(|_| vertices(&mut random)).collect();
            let latency = 1 + random.below(VertexStream::PATIENCE as u64) as usize;
            for reset in [run == 0, false] {
                block.set("reset", reset);
                block.set("starts", !reset);
                block.set("count", records.len() as u32);
                block.set("comes", false);
                block.set("takes", false);
                block.settle();
                block.edge();
            }
            block.set("starts", false);
            let mut expected = beats_of(&records);
            let mut under_way: VecDeque<Option<[u32; 3]>> = vec![None; latency].into();
            let mut rest = records.iter().copied();
            let mut clock = 0;
            while !expected.is_empty() {
                // `has_room` follows registers only, so `takes` may still change.
                block.set("takes", false);
                let next = under_way.pop_front().flatten();
                block.set("comes", next.is_some());
                set_vertices(&mut block, next.unwrap_or([0x7ead; 3]));
                block.settle();
                under_way.push_back(if block.is("has_room") { rest.next() } else { None });
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
