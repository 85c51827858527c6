//! Runs `RecordHalves` in Rust and in Verilog beside the layout that the protocol states: all three must agree over
//! random inputs.

use crate::rig::record_beats::{Columns, Form};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::commands::RecordHalves;
use incircle_testkit::SplitMix64;

named_ports!(RecordHalves, [record, vertices_alone, has_short_ids], [halves, rest], clock);

const ROUNDS: usize = 4000;

#[test]
fn halves_are_those_of_the_words_or_the_ids_of_the_vertices() {
    let mut random = SplitMix64::new(24);
    let mut block = Stepper::new("record_halves", RecordHalves::default(), 1);
    let mut kept: Option<Columns> = None;
    for _ in 0..ROUNDS {
        let record = Columns::random(&mut random);
        let form = Form::random(&mut random);
        record.set(&mut block);
        block.set("vertices_alone", form.has_vertices_alone());
        block.set("has_short_ids", form.has_short_ids());
        block.settle();
        if let Some(kept) = kept {
            let halves = kept.words().map(|word| [word & 0xffff, word >> 16]).concat();
            let [a, b, c] = kept.v;
            let low = a & 0x3ff | (b & 0x3ff) << 10 | (c & 0x3ff) << 20 | (a >> 10 & 3) << 30;
            let short = [low & 0xffff, low >> 16];
            let expected = match form {
                Form::Whole => &halves[..],
                Form::Vertices => &kept.v[..],
                Form::Short(_) => &short[..],
            };
            let ports = ["half0", "half1", "half2", "half3", "half4", "half5"];
            for (port, half) in ports.into_iter().zip(expected) {
                block.expect(port, *half);
            }
        }
        block.edge();
        kept = Some(record);
    }
}
