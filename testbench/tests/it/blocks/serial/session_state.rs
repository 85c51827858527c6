//! Runs `SessionState` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::asked::{CLOSES, GAP, HEARS, OPENS, POLLS, REPEATS, TAKES};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::SessionState;
use incircle_testkit::SplitMix64;

named_ports!(SessionState, [reset, asked, session, fails], [open, saw_gap, forgets, settles], clock);

/// The session by the rules of the protocol's page.
#[derive(Default)]
struct Session {
    number: u8,
    expected: u8,
    saw_gap: bool,
    begins: bool,
    settling: u32,
}

#[test]
fn session_opens_counts_and_ends() {
    let mut random = SplitMix64::new(5);
    let mut block = Stepper::new("serial_session_state", SessionState::default(), 1);
    let mut session = Session::default();
    let (mut openings, mut ends) = (0, 0);
    for clock in 0..20_000 {
        let event = [TAKES, TAKES, TAKES, GAP, OPENS, CLOSES, POLLS, REPEATS][random.below(8) as usize];
        let asks = clock > 0 && random.below(3) == 0 && (event & (OPENS | CLOSES) == 0 || random.below(9) == 0);
        let asked = if asks { HEARS | event } else { 0 };
        let named = 1 + random.below(255) as u8;
        let (fails, reset) = (clock > 0 && random.below(150) == 0, clock == 0 || random.below(2000) == 0);
        block.set("asked", asked);
        block.set("session", named);
        block.set("fails", fails);
        block.set("reset", reset);
        block.settle();
        if clock > 0 {
            block.expect("is_open", session.number != 0);
            block.expect("number", session.number);
            block.expect("expected", session.expected);
            block.expect("saw_gap", session.saw_gap);
            block.expect("forgets", session.begins || session.number == 0);
            block.expect("settles", session.settling > 0);
        }
        block.edge();
        session.settling = if asks || fails || reset { 7 } else { session.settling.saturating_sub(1) };
        session.begins = asked & OPENS != 0;
        session.expected = session.expected.wrapping_add((asked & TAKES != 0).into());
        session.saw_gap = (session.saw_gap || asked & GAP != 0) && asked & TAKES == 0;
        if asked & (OPENS | CLOSES) != 0 || fails || reset {
            let opens = asked & OPENS != 0 && !reset;
            ends += usize::from(session.number != 0);
            openings += usize::from(opens);
            session.number = if opens { named } else { 0 };
            (session.expected, session.saw_gap) = (0, false);
        }
    }
    assert!(openings > 50 && ends > 50, "{openings} openings, {ends} ends");
}
