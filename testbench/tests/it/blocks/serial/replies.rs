//! Runs `Replies` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::asked::{CLOSES, DROPS, GAP, HELLO, NO_SESSION, OPENS, POLLS, RATE, REPEATS, TAKES};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::Replies;
use incircle_testkit::SplitMix64;

named_ports!(Replies, [reset, asked, saw_gap, fails, starts], [is_due, kind, acknowledges, closes], clock);

#[test]
fn replies_go_in_order_and_each_once() {
    const KINDS: [u32; 5] = [0x81, 0x82, 0x88, 0x87, 0];
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("serial_replies", Replies::default(), 1);
    // Hello, Opened, Closed, NoSession in their order; Ack and Nak follow.
    let mut due = [false; 4];
    let (mut ack, mut nak) = (false, false);
    let mut sent = [0; 6];
    for clock in 0..30_000 {
        let busy = [2, 30][clock / 500 % 2];
        let events =
            [HELLO, OPENS, RATE, POLLS, CLOSES, TAKES, REPEATS, GAP, NO_SESSION, DROPS, TAKES, POLLS, GAP, RATE];
        let asked = if clock > 0 && random.below(busy) == 0 { events[random.below(14) as usize] } else { 0 };
        let (saw_gap, fails) = (random.below(2) == 0, clock > 0 && random.below(90) == 0);
        let reset = clock == 0 || random.below(3000) == 0;
        let first = due.iter().position(|is_due| *is_due).unwrap_or(4);
        let is_due = first < 4 || ack || nak;
        let starts = clock > 0 && is_due && random.below(6) == 0;
        block.set("asked", asked);
        for (port, bit) in [("saw_gap", saw_gap), ("fails", fails), ("starts", starts), ("reset", reset)] {
            block.set(port, bit);
        }
        block.settle();
        if clock > 0 {
            block.expect("is_due", is_due);
        }
        if clock > 0 && is_due {
            let kind = if first < 4 { KINDS[first] } else { 0x83 + u32::from(nak) };
            block.expect("kind", kind);
            block.expect("acknowledges", first == 4);
            block.expect("closes", first == 2);
            if starts {
                sent[if first < 4 { first } else { 4 + usize::from(nak) }] += 1;
            }
        }
        block.edge();
        if starts {
            if first < 4 {
                due[first] = false;
            } else {
                (ack, nak) = (false, false);
            }
        }
        due[0] |= asked & HELLO != 0;
        due[3] |= asked & NO_SESSION != 0;
        ack |= asked & (RATE | REPEATS | TAKES) != 0 || asked & POLLS != 0 && !saw_gap;
        nak |= asked & GAP != 0 && !saw_gap || asked & POLLS != 0 && saw_gap;
        nak &= asked & TAKES == 0;
        if asked & (OPENS | CLOSES) != 0 || fails {
            due = [due[0], asked & OPENS != 0, asked & CLOSES != 0, false];
            (ack, nak) = (false, false);
        }
        if reset {
            (due, ack, nak) = ([false; 4], false, false);
        }
    }
    assert!(sent.iter().all(|count| *count > 20), "{sent:?}");
}
