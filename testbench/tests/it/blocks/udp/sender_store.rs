//! Runs `SenderStore` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::udp::SenderStore;
use incircle_testkit::SplitMix64;

named_ports!(
    SenderStore,
    [reset, head_valid, index, byte_data, keeps, opens, reads_question, read_index],
    [session_byte, copies, read_data],
    clock
);

/// Indices whose bytes mean something, and those that are compared.
fn counts(index: usize) -> bool {
    matches!(index, 0..12 | 20..28)
}

fn is_compared(index: usize) -> bool {
    matches!(index, 6..12 | 20..28)
}

/// Passes a clock with these inputs.
fn clock(block: &mut Stepper<SenderStore>, head: Option<(usize, u8)>, keeps: bool, opens: bool) {
    block.set("head_valid", head.is_some());
    block.set("index", head.map_or(31, |(index, _)| index as u32));
    block.set("byte_data", head.map_or(0, |(_, byte)| byte));
    block.set("keeps", keeps);
    block.set("opens", opens);
    block.settle();
    block.edge();
}

#[test]
fn store_keeps_question_and_session_while_datagrams_come() {
    let mut random = SplitMix64::new(2);
    let mut block = Stepper::new("udp_sender_store", SenderStore::default(), 1);
    block.set("reads_question", false);
    block.set("read_index", 0u32);
    block.set("reset", true);
    clock(&mut block, None, false, false);
    block.set("reset", false);
    let (mut question, mut session): (Option<Vec<u8>>, Option<Vec<u8>>) = (None, None);
    for run in 0..400 {
        // A datagram may end early: then it is no question.
        let bytes: Vec<u8> = (0..32).map(|_| random.below(256) as u8).collect();
        let length = if random.below(4) == 0 { random.below(32) as usize } else { 32 };
        for (index, &byte) in bytes.iter().enumerate().take(length) {
            if let Some(session) = session.as_ref().filter(|_| is_compared(index)) {
                block.set("index", index as u32);
                block.settle();
                block.expect("session_byte", session[index]);
            }
            // What was kept can be read at any time.
            let read = random.below(28) as usize;
            for (kept, reads_question) in [(&question, true), (&session, false)] {
                if let Some(kept) = kept.as_ref().filter(|_| counts(read)) {
                    block.set("reads_question", reads_question);
                    block.set("read_index", read as u32);
                    block.settle();
                    block.expect("read_data", kept[read]);
                }
            }
            clock(&mut block, Some((index, byte)), false, false);
        }
        if length < 32 || run > 0 && random.below(3) == 0 {
            continue;
        }
        let opens = random.below(3) == 0;
        clock(&mut block, None, true, opens);
        question = Some(bytes.clone());
        if opens {
            session = Some(bytes);
        }
        for waited in 0..40 {
            block.settle();
            block.expect("copies", opens && waited < 32);
            clock(&mut block, None, false, false);
        }
    }
    assert!(session.is_some());
}

#[test]
fn wave_of_a_question_that_opens_a_session() {
    let mut block = Stepper::new("udp_sender_store", SenderStore::default(), 1);
    block.set("reads_question", false);
    block.set("read_index", 27u32);
    block.set("reset", true);
    clock(&mut block, None, false, false);
    block.set("reset", false);
    (0..27).for_each(|index| clock(&mut block, Some((index, 0)), false, false));
    let mut wave = Wave::default();
    for now in 0..38 {
        let (head, opens) = ((now == 0).then_some((27, 70)), now == 2);
        // Both can be read when the question has been copied.
        let reads_question = now < 36;
        block.set("reads_question", reads_question);
        clock_settled(&mut block, head, opens);
        let reads = now >= 35;
        if !(5..32).contains(&now) {
            wave.take(&[
                ("head_valid", Cell::Bit(head.is_some())),
                ("keeps", Cell::Bit(opens)),
                ("opens", Cell::Bit(opens)),
                ("copies", Cell::Bit(block.is("copies"))),
                ("reads_question", Cell::Bit(reads_question)),
                ("read_data", if reads { Cell::Number(block.get("read_data")) } else { Cell::Open }),
            ]);
        }
        block.edge();
    }
    wave.assert_drawn_in("sender_store");
}

/// Sets the inputs of a clock and brings the outputs up to date.
fn clock_settled(block: &mut Stepper<SenderStore>, head: Option<(usize, u8)>, opens: bool) {
    block.set("head_valid", head.is_some());
    block.set("index", head.map_or(31, |(index, _)| index as u32));
    block.set("byte_data", head.map_or(0, |(_, byte)| byte));
    block.set("keeps", opens);
    block.set("opens", opens);
    block.settle();
}
