//! Runs `FrameChoice` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::FrameChoice;
use incircle_testkit::SplitMix64;

named_ports!(
    FrameChoice,
    [is_idle, reply_is_due, reply_kind, answer_is_due, answer_is_last, holds, cuts],
    [starts, starts_reply, starts_answer, kind, contents],
    clock
);

#[test]
fn choice_sends_replies_before_answers() {
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("serial_frame_choice", FrameChoice::default(), 1);
    let mut kind = None;
    let mut counts = [0; 2];
    for _ in 0..6000 {
        let reply_kind = [0x81, 0x82, 0x83, 0x84, 0x87, 0x88][random.below(6) as usize];
        let mut bit = |times| random.below(times) == 0;
        let (is_idle, reply, answer, last) = (bit(2), bit(3), bit(2), bit(2));
        let (holds, cuts) = (bit(3), bit(3));
        block.set("reply_kind", reply_kind as u32);
        for (port, bit) in [
            ("is_idle", is_idle),
            ("reply_is_due", reply),
            ("answer_is_due", answer),
            ("answer_is_last", last),
            ("holds", holds),
            ("cuts", cuts),
        ] {
            block.set(port, bit);
        }
        block.settle();
        let may = is_idle && !holds;
        let (starts_reply, starts_answer) = (may && reply, may && answer && !reply && !cuts);
        block.expect("starts_reply", starts_reply);
        block.expect("starts_answer", starts_answer);
        block.expect("starts", starts_reply || starts_answer);
        if let Some(kind) = kind {
            block.expect("kind", kind);
            block.expect("has_greeting", kind == 0x81);
            block.expect("has_digest", kind == 0x83 || kind == 0x84);
            block.expect("has_answer", kind == 0x85 || kind == 0x86);
            block.expect("ends_answer", kind == 0x86);
        }
        block.edge();
        counts[0] += usize::from(starts_reply);
        counts[1] += usize::from(starts_answer);
        if starts_reply {
            kind = Some(reply_kind as u64);
        }
        if starts_answer {
            kind = Some(if last { 0x86 } else { 0x85 });
        }
    }
    assert!(counts.iter().all(|count| *count > 200), "{counts:?}");
}
