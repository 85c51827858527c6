//! Runs `DatagramReplies` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw_range, When};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::udp::DatagramReplies;
use incircle_testkit::SplitMix64;

named_ports!(
    DatagramReplies,
    [reset, asks, saw_gap, forgets, starts, ended],
    [is_due, kind, is_in_place, place_is_taken],
    clock
);

/// What is due: the kind in the one place, and a receipt.
#[derive(Clone, Copy, Debug, Default)]
struct Due {
    place: Option<u8>,
    ack: bool,
    nak: bool,
}

impl Due {
    fn kind(self) -> Option<u8> {
        self.place.or(self.nak.then_some(0x84)).or(self.ack.then_some(0x83))
    }
}

#[test]
fn replies_are_due_once_and_in_their_order() {
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("udp_datagram_replies", DatagramReplies::default(), 1);
    let (mut due, mut sends, mut saw_gap) = (Due::default(), None, false);
    let mut counts = [0; 3];
    for clock in 0..40_000 {
        let reset = clock == 0 || random.below(9000) == 0;
        let pick = random.below(60);
        let replies = pick == 0 && due.place.is_none();
        let reply = [1, 2, 7, 8, 9][random.below(5) as usize];
        let closes = replies && reply == 8;
        let [polls, takes, repeats, gap] = [1, 2, 3, 4].map(|choice| pick == choice);
        let forgets = random.below(200) == 0;
        let starts = sends.is_none() && due.kind().is_some() && random.below(5) == 0;
        let ended = sends.is_some() && random.below(20) == 0;
        for (port, bit) in [
            ("reset", reset),
            ("replies", replies),
            ("closes", closes),
            ("polls", polls),
            ("takes", takes),
            ("repeats", repeats),
            ("gap", gap),
            ("saw_gap", saw_gap),
            ("forgets", forgets),
            ("starts", starts),
            ("ended", ended),
        ] {
            block.set(port, bit);
        }
        block.set("reply", reply);
        block.settle();
        if clock > 0 {
            block.expect("is_due", due.kind().is_some());
            due.kind().into_iter().for_each(|kind| block.expect("kind", kind));
            block.expect("place_is_taken", due.place.is_some());
            block.expect("is_in_place", sends == Some(true));
        }
        block.edge();
        if ended {
            if sends == Some(true) {
                due.place = None;
            }
            sends = None;
        }
        if starts {
            sends = Some(due.place.is_some());
            counts[usize::from(due.place.is_some())] += 1;
            if due.place.is_none() {
                counts[2] += usize::from(due.nak);
                (due.ack, due.nak) = (false, false);
            }
        }
        if replies {
            due.place = Some(0x80 | reply);
        }
        due.ack |= takes || repeats || polls && !saw_gap;
        due.nak |= gap && !saw_gap || polls && saw_gap;
        due.nak &= !takes;
        saw_gap = (saw_gap || gap) && !takes;
        if forgets || closes {
            (due.ack, due.nak, saw_gap) = (false, false, false);
        }
        if reset {
            // A receipt belongs to a session, and none is open after a reset.
            block.set("reset", false);
            block.set("forgets", true);
            for port in ["replies", "polls", "takes", "repeats", "gap", "starts", "ended"] {
                block.set(port, false);
            }
            block.settle();
            block.edge();
            (due, sends, saw_gap) = (Due::default(), None, false);
        }
    }
    assert!(counts.iter().all(|count| *count > 100), "{counts:?}");
}

#[test]
fn wave_of_a_receipt_and_of_an_answer_that_goes_first() {
    // Kind 81, a greeting, is 129; the wave shows kinds without their highest bit.
    let stimuli = [
        (0, "forgets", 1),
        (2, "asks_takes", 1),
        (3, "asks_replies", 1),
        (3, "asks_reply", 1),
        (5, "starts", 1),
        (8, "ended", 1),
        (10, "starts", 1),
        (12, "ended", 1),
    ];
    let lanes = [
        ("asks.takes", "asks_takes", 0, 1, When::Always),
        ("asks.replies", "asks_replies", 0, 1, When::Always),
        ("is_due", "is_due", 0, 1, When::Always),
        ("kind[6:0]", "kind", 0, 7, When::If("is_due")),
        ("starts", "starts", 0, 1, When::Always),
        ("ended", "ended", 0, 1, When::Always),
        ("is_in_place", "is_in_place", 0, 1, When::Always),
        ("place_is_taken", "place_is_taken", 0, 1, When::Always),
    ];
    // A reset leaves receipts alone, so the drawing begins behind `forgets`.
    let block = DatagramReplies::default();
    draw_range("udp_datagram_replies", block, &stimuli, 1..14, &lanes).assert_drawn_in("datagram_replies");
}
