//! Runs `RecordReads` in Rust and in Verilog beside the layout that the protocol states: all three must agree, while
//! idle clocks, back-pressure and resets come in between.

use std::collections::VecDeque;

use crate::rig::record_beats::{beats_of, Beat, Columns, Form};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::commands::{RecordReads, RecordStream};
use incircle_testkit::SplitMix64;

named_ports!(
    RecordReads,
    [reset, starts, first, count, is_packed, has_short_ids, has_rests, runs, read_done, record, takes],
    [read, read_id, valid, beat],
    clock
);

#[test]
fn reads_give_the_words_of_records_or_their_vertices() {
    for (seed, ready) in [(45, 100), (46, 40), (47, 5)] {
        let mut random = SplitMix64::new(seed);
        let mut block = Stepper::new("record_reads", RecordReads::default(), 1);
        for run in 0..80 {
            let form = Form::random(&mut random);
            let asked = form.asked(random.below(2) == 0);
            let count = 1 + random.below(60) as u32;
            let first = random.below(u64::from((1u32 << 15) - count)) as u32;
            let records: Vec<Columns> = (first..first + count).map(Columns::of).collect();
            let mut expected = beats_of(&records, form);
            for reset in [run == 0 || random.below(9) == 0, false] {
                block.set("reset", reset);
                block.set("starts", !reset);
                for (port, bit) in ["is_packed", "has_short_ids", "has_rests"].into_iter().zip(asked) {
                    block.set(port, bit);
                }
                block.set("first", first);
                block.set("count", count);
                block.set("runs", false);
                block.set("read_done", false);
                block.set("takes", false);
                block.settle();
                block.edge();
            }
            block.set("starts", false);
            block.set("runs", true);
            let mut reads: VecDeque<Option<u32>> =
                vec![None; 1 + random.below(RecordStream::PATIENCE as u64) as usize].into();
            let (mut next, mut clock) = (first, 0);
            let cut = if run % 10 == 9 { random.below(30) } else { 40_000 };
            while !expected.is_empty() && clock < cut {
                block.set("takes", false);
                let done = reads.pop_front().flatten();
                block.set("read_done", done.is_some());
                Columns::of(done.unwrap_or_else(|| random.below(1 << 15) as u32)).set(&mut block);
                block.settle();
                let reads_now = block.is("read");
                if reads_now {
                    block.expect("read_id", next);
                    next += 1;
                }
                reads.push_back(reads_now.then(|| next - 1));
                let valid = block.is("valid");
                if valid {
                    assert_eq!(Beat::of(block.get("beat")), expected[0], "run {run}");
                }
                let takes = valid && random.below(100) < ready;
                block.set("takes", takes);
                block.settle();
                block.edge();
                if takes {
                    expected.pop_front();
                }
                clock += 1;
                assert!(clock < 40_000, "no end");
            }
            if cut < 40_000 {
                // Drops reads that were under way, in the block and on the way from the memory.
                block.set("runs", false);
                block.set("read_done", false);
                block.set("takes", false);
                block.set("reset", true);
                block.settle();
                block.edge();
                block.set("reset", false);
            } else {
                assert_eq!(next, first + count, "every record is read once");
            }
        }
    }
}
