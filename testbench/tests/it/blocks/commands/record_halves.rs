//! Runs `RecordHalves` in Rust and in Verilog beside the layout that the protocol states: all three must agree over
//! random inputs.

use crate::rig::record_beats::Columns;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::commands::RecordHalves;
use incircle_testkit::SplitMix64;

named_ports!(RecordHalves, [record, vertices_alone], [halves], clock);

const ROUNDS: usize = 4000;

#[test]
fn halves_are_those_of_the_words_or_the_ids_of_the_vertices() {
    let mut random = SplitMix64::new(24);
    let mut block = Stepper::new("record_halves", RecordHalves::default(), 1);
    let mut kept: Option<Columns> = None;
    for _ in 0..ROUNDS {
        let record = Columns::random(&mut random);
        let vertices_alone = random.below(2) == 0;
        record.set(&mut block);
        block.set("vertices_alone", vertices_alone);
        block.settle();
        if let Some(kept) = kept {
            let halves = kept.words().map(|word| [word & 0xffff, word >> 16]).concat();
            let expected = if vertices_alone { &kept.v[..] } else { &halves[..] };
            let ports = ["half0", "half1", "half2", "half3", "half4", "half5"];
            for (port, half) in ports.into_iter().zip(expected) {
                block.expect(port, *half);
            }
        }
        block.edge();
        kept = Some(record);
    }
}
