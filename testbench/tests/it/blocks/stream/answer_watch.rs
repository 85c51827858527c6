//! Runs `AnswerWatch` in Rust and in Verilog beside plain code: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::stream_bits::set_bits;
use incircle_hdl::stream::AnswerWatch;
use incircle_protocol::{answer_header, Opcode, Status};
use incircle_testkit::SplitMix64;

named_ports!([const W: usize] AnswerWatch<W>,
    [reset, resets, m_axis_tvalid, m_axis_tready, m_axis_tdata, m_axis_tlast], [events], clock);

#[test]
fn failed_answers_are_seen() {
    let mut random = SplitMix64::new(5);
    let mut block = Stepper::new("stream_answer_watch", AnswerWatch::<64>::default(), 1);
    let (mut is_first, mut events, mut header) = (true, [false; 4], 0);
    let mut failures = 0;
    for clock in 0..6000 {
        let (reset, resets) = (clock == 0 || random.below(300) == 0, random.below(200) == 0);
        let (valid, ready, is_last) = (random.below(4) != 0, random.below(3) != 0, random.below(3) == 0);
        let status = [Status::Ok, Status::Ok, Status::Full, Status::UnknownOpcode][random.below(4) as usize];
        let word = answer_header(Opcode::Insert as u8, status);
        set_bits(
            &mut block,
            &[("reset", reset), ("resets", resets), ("m_axis_tvalid", valid), ("m_axis_tready", ready)],
        );
        block.set("m_axis_tlast", is_last);
        block.set("m_axis_tdata", u64::from(word) | random.below(1 << 32) << 32);
        block.settle();
        if clock > 0 {
            for (port, event) in ["took", "waited", "ended", "failed"].into_iter().zip(events) {
                block.expect(port, event);
            }
            if events[3] {
                block.expect("header", header);
            }
        }
        block.edge();
        let takes = valid && ready;
        let fails = takes && is_first && status != Status::Ok;
        events = [takes, valid && !ready, takes && is_last, fails].map(|event| event && !reset);
        failures += usize::from(fails);
        header = word;
        if takes {
            is_first = is_last;
        }
        is_first |= reset || resets;
    }
    assert!(failures > 300);
}
