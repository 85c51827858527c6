//! Runs `AnswerHead` in Rust and in Verilog beside the protocol as `incircle-protocol` states it: all three must agree
//! over random commands, and counts of a mesh that change in every clock.

use crate::rig::answer_words::{commands, Answer, Asked};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::commands::AnswerHead;
use incircle_protocol::{answer_header, signed_header, Opcode, ShortIds, Status};
use incircle_testkit::SplitMix64;

named_ports!(AnswerHead, [request, clearing, engine, records, collinear, stuck, some_refused], [head], clock);

#[test]
fn answer_heads_follow_the_protocol() {
    let mut random = SplitMix64::new(5);
    let mut block = Stepper::new("answer_head", AnswerHead::default(), 1);
    let mut bad_ranges = 0;
    for (opcode, is_refused, clocks) in commands(&mut random) {
        let mut answers: Vec<Answer> = vec![];
        let Asked { engine, tag, short_ids, .. } = Asked::random(&mut random);
        for clock in 0..clocks {
            let asked = Asked { opcode, is_refused, engine, tag, short_ids, ..Asked::random(&mut random) };
            for (port, value) in [
                ("opcode", u32::from(asked.opcode)),
                ("first", asked.first),
                ("count", asked.count),
                ("request_has_short_ids", asked.short_ids.is_some().into()),
                ("request_has_rests", (asked.short_ids == Some(ShortIds::Twelve)).into()),
                ("is_refused", asked.is_refused.into()),
                ("tag", asked.tag.into()),
                ("engine", asked.engine.into()),
                ("collinear", asked.collinear.into()),
                ("stuck", asked.stuck.into()),
                ("some_refused", (asked.report.refused > 0).into()),
                ("records", asked.report.records),
            ] {
                block.set(port, value);
            }
            block.settle();
            answers.push(asked.answer());
            block.expect("is_read", [Opcode::Read as u8, Opcode::Triangles as u8].contains(&opcode));
            block.expect("is_packed", opcode == Opcode::Triangles as u8);
            block.expect("head_has_short_ids", asked.short_ids.is_some());
            block.expect("head_has_rests", asked.short_ids == Some(ShortIds::Twelve));
            if clock >= 3 {
                let answer = &answers[clock - 3];
                bad_ranges += u32::from(answer.status == Status::BadRange);
                block.expect("header", signed_header(answer_header(answer.opcode, answer.status), engine, tag));
                block.expect("length", answer.length);
                block.expect("is_empty", answer.length == 0);
            }
            block.edge();
        }
    }
    assert!(bad_ranges > 100, "{bad_ranges}");
}
