//! Runs `RecordBuffer` in Rust and in Verilog beside lists of what must happen: all three must agree in every clock.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::commands::RecordBuffer;
use incircle_protocol::{Layout, CORE_COORD_BITS, MAX_POINTS};
use incircle_testkit::SplitMix64;

named_ports!(
    RecordBuffer,
    [reset, read_done, record, takes, takes_whole],
    [holds, word, is_at_last, vertex0, vertex1, vertex2],
    clock
);

const CLOCKS: usize = 8000;

#[test]
fn record_buffer_hands_out_three_words_or_all_vertices() {
    let mut random = SplitMix64::new(35);
    let mut block = Stepper::new("record_buffer", RecordBuffer::default(), 1);
    let layout = Layout::of(CORE_COORD_BITS, MAX_POINTS);
    let mut words: VecDeque<u32> = VecDeque::new();
    let (mut records, mut streamed) = (0, 0);
    for clock in 0..CLOCKS {
        let reset = clock == 0 || random.below(100) == 0;
        let is_whole = words.len() == 3;
        let takes_whole = is_whole && random.below(3) == 0;
        let takes = !words.is_empty() && !takes_whole && random.below(3) != 0;
        // The next record may come at the edge at which the last one is taken whole.
        let comes = (words.is_empty() || takes_whole) && random.below(3) == 0;
        let columns = [(); 6].map(|()| random.below(1 << 15) as u32);
        let was_set = random.below(2) == 0;
        block.set("takes_whole", takes_whole);
        for (port, value) in [("reset", reset), ("read_done", comes), ("takes", takes), ("was_set", was_set)] {
            block.set(port, value);
        }
        for (port, value) in ["v0", "v1", "v2", "n0", "n1", "n2"].into_iter().zip(columns) {
            block.set(port, value);
        }
        block.settle();
        if clock > 0 {
            block.expect("holds", !words.is_empty());
        }
        if let Some(word) = words.front() {
            block.expect("word", *word);
            block.expect("is_at_last", words.len() == 1);
        }
        for (port, word) in ["vertex0", "vertex1", "vertex2"].into_iter().zip(&words).filter(|_| is_whole) {
            block.expect(port, word & 0x7fff);
        }
        block.edge();
        if takes {
            words.pop_front();
        }
        if takes_whole {
            words.clear();
        }
        streamed += u32::from(comes && takes_whole && !reset);
        if comes {
            let [v0, v1, v2, n @ ..] = columns;
            words.extend(&layout.record_to_words([v0, v1, v2], n, was_set)[..3]);
        }
        if reset {
            words.clear();
        }
        records += u32::from(comes && !reset);
    }
    assert!(records > 500 && streamed > 50, "{records} records, {streamed} behind each other");
}
