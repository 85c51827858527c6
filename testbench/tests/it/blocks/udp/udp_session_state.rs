//! Runs `UdpSessionState` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::udp::UdpSessionState;
use incircle_testkit::SplitMix64;

named_ports!(UdpSessionState, [reset, asks, fails], [session, saw_gap, forgets], clock);

#[test]
fn session_opens_counts_and_ends() {
    let mut random = SplitMix64::new(3);
    let mut block = Stepper::new("udp_session_state", UdpSessionState::default(), 1);
    let (mut is_open, mut expected, mut gap, mut begins) = (false, 0u32, false, false);
    let mut sessions = 0;
    for clock in 0..30_000 {
        let reset = clock == 0 || random.below(5000) == 0;
        // At most one of them at a time; an `Open` begins a session only while none is open.
        let pick = random.below(40);
        let (opens, closes, fails) = (!is_open && pick == 0, is_open && pick == 1, is_open && pick == 2);
        let (takes, seen) = (is_open && (3..20).contains(&pick), is_open && pick == 21);
        for (port, bit) in [
            ("reset", reset),
            ("opens", opens),
            ("closes", closes),
            ("fails", fails),
            ("takes", takes),
            ("gap", seen),
            ("hears", random.below(2) == 0),
        ] {
            block.set(port, bit);
        }
        block.settle();
        if clock > 0 {
            block.expect("is_open", is_open);
            block.expect("expected", expected);
            block.expect("saw_gap", gap);
            block.expect("forgets", begins || !is_open);
        }
        block.edge();
        begins = opens;
        if takes {
            (expected, gap) = (expected.wrapping_add(1), false);
        }
        gap |= seen;
        is_open |= opens;
        sessions += usize::from(opens);
        if closes || fails || reset {
            (is_open, expected, gap) = (false, 0, false);
        }
    }
    assert!(sessions > 100, "{sessions} sessions");
}

#[test]
fn wave_of_a_session_with_a_gap() {
    let stimuli =
        [(1, "asks_opens", 1), (4, "asks_takes", 1), (6, "asks_gap", 1), (8, "asks_takes", 1), (10, "asks_closes", 1)];
    let lanes = [
        ("asks.opens", "asks_opens", 0, 1, When::Always),
        ("asks.takes", "asks_takes", 0, 1, When::Always),
        ("asks.gap", "asks_gap", 0, 1, When::Always),
        ("asks.closes", "asks_closes", 0, 1, When::Always),
        ("session.is_open", "session_is_open", 0, 1, When::Always),
        ("session.expected", "session_expected", 0, 32, When::Always),
        ("saw_gap", "saw_gap", 0, 1, When::Always),
        ("forgets", "forgets", 0, 1, When::Always),
    ];
    draw("udp_session_state", UdpSessionState::default(), &stimuli, 13, &lanes).assert_drawn_in("udp_session_state");
}
