//! Decides who may push visits into the queue, in Rust and in Verilog beside a statement of
//! the rules: all three must agree.

use crate::rig::stepper::bundles::{flip, id, Visit};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::PushPort;
use incircle_testkit::SplitMix64;

named_ports!(PushPort, [reset, follow, start, solo_is_at_work, solo], [push], clock);

const ROUNDS: usize = 6000;

/// The blocks that ask for visits in a clock.
#[derive(Clone, Copy, Debug, Default)]
struct Asking {
    reset: bool,
    may_ask: bool,
    asks: bool,
    starts: bool,
    solo_is_at_work: bool,
    solo_asks: bool,
    follows: Visit,
    starter: Visit,
    solo: Visit,
}

/// Runs one clock of the push port, and returns the visit that it must show in the next one.
fn push_clock(block: &mut Stepper<PushPort>, asking: &Asking, shown: Option<Visit>) -> Option<Visit> {
    for (port, value) in [
        ("reset", asking.reset),
        ("may_ask", asking.may_ask),
        ("asks", asking.asks),
        ("start_valid", asking.starts),
        ("solo_is_at_work", asking.solo_is_at_work),
        ("solo_valid", asking.solo_asks),
    ] {
        block.set(port, value);
    }
    block.set("follow_bundle", asking.follows.bundle(3, 1, 2, 3));
    block.set("start_context", asking.starter.context);
    block.set("start_record", asking.starter.record);
    block.set("solo_bundle", asking.solo.bundle(1, 0, 0, 0));
    block.settle();
    if block.clocks() > 0 {
        block.expect("push_valid", shown.is_some());
    }
    if let Some(visit) = shown {
        // The visit of a walk has no entry.
        let visits = if visit.locks && !visit.rotates { 3 } else { 1 };
        let bits = if visits == 3 {
            93
        } else if visit.rotates {
            57
        } else {
            9
        };
        let mask = (1 << bits) - 1;
        block.expect_masked("push_bundle", mask, visit.bundle(visits, 1, 2, 3) & mask);
        block.expect_masked("push_bundle", 0x7fff << 42, u128::from(visit.record) << 42);
    }
    block.edge();
    match (asking.reset, asking.asks, asking.starts, asking.solo_asks) {
        (true, ..) => None,
        (_, true, ..) => Some(asking.follows),
        (_, _, true, _) => Some(asking.starter),
        (.., true) => Some(asking.solo),
        _ => None,
    }
}

#[test]
fn push_port_takes_the_visits_of_whoever_asks() {
    let mut random = SplitMix64::new(58);
    let mut block = Stepper::new("push_port", PushPort::default(), 1);
    let mut shown = push_clock(&mut block, &Asking { reset: true, ..Asking::default() }, None);
    for _ in 0..ROUNDS {
        let [solo_is_at_work, may_ask, asks, solo_asks, starts] = [(); 5].map(|()| flip(&mut random));
        let asking = Asking {
            reset: random.below(100) == 0,
            may_ask: may_ask && !solo_is_at_work,
            asks: asks && may_ask && !solo_is_at_work,
            starts: starts && !may_ask && !solo_is_at_work,
            solo_is_at_work,
            solo_asks: solo_is_at_work && solo_asks,
            // A root visit here, so that its three tests can be told from other visits by their kind.
            follows: Visit { rotates: false, locks: true, ..Visit::random(&mut random) },
            starter: Visit { context: random.below(24), ..Visit::look(id(&mut random)) },
            solo: Visit { rotates: true, ..Visit::random(&mut random) },
        };
        shown = push_clock(&mut block, &asking, shown);
    }
}

#[test]
fn push_port_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("push_port", PushPort::default(), 2);
    let mut shown = push_clock(&mut block, &Asking { reset: true, ..Asking::default() }, None);
    let mut wave = Wave::default();
    for clock in 0..7 {
        let asking = Asking {
            may_ask: matches!(clock, 1 | 2),
            asks: clock == 1,
            starts: clock == 3,
            solo_is_at_work: matches!(clock, 4 | 5),
            solo_asks: clock == 5,
            follows: Visit { locks: true, ..Visit::look(5) },
            starter: Visit::look(6),
            solo: Visit { rotates: true, ..Visit::look(7) },
            ..Asking::default()
        };
        let number =
            |is_shown: bool, visit: Visit| if is_shown { Cell::Number(visit.record.into()) } else { Cell::Open };
        wave.take(&[
            ("asks", Cell::Bit(asking.asks)),
            ("may_ask", Cell::Bit(asking.may_ask)),
            ("follows.record", number(asking.asks, asking.follows)),
            ("starts", Cell::Bit(asking.starts)),
            ("record", number(asking.starts, asking.starter)),
            ("solo_is_at_work", Cell::Bit(asking.solo_is_at_work)),
            ("solo_asks", Cell::Bit(asking.solo_asks)),
            ("solo.record", number(asking.solo_asks, asking.solo)),
            ("push", Cell::Bit(shown.is_some())),
            ("bundle.record", number(shown.is_some(), shown.unwrap_or_default())),
        ]);
        shown = push_clock(&mut block, &asking, shown);
    }
    wave.assert_drawn_in("push_port");
}
