//! Runs `FreshIds` in Rust and in Verilog beside plain lists: all three must agree in every clock.

use crate::rig::record_count::{Count, Event};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::FreshIds;
use incircle_testkit::SplitMix64;

named_ports!(FreshIds, [reset, takes, ends, solo_inserts, seeds, clears], [fresh, records], clock);

fn number(number: u64) -> Cell {
    Cell::Number(number.into())
}

/// Runs one clock of the count; nothing is compared in the first one.
fn count_clock(block: &mut Stepper<FreshIds>, count: &mut Count, event: Event) {
    for (port, value) in [
        ("reset", event.reset),
        ("takes", event.takes),
        ("ends", event.ends),
        ("solo_inserts", event.solo_inserts),
        ("seeds", event.seeds),
        ("clears", event.clears),
    ] {
        block.set(port, value);
    }
    block.settle();
    if block.clocks() > 0 {
        block.expect("fresh", count.fresh);
        block.expect("records", count.records);
    }
    block.edge();
    count.edge(event);
}

#[test]
fn fresh_ids_count_records() {
    let mut random = SplitMix64::new(10);
    let mut block = Stepper::new("fresh_ids", FreshIds::default(), 4);
    let mut count = Count::default();
    let (mut since_end, mut ends) = (0, 0);
    for clock in 0..6_000 {
        let choice = random.below(40);
        let is_settled = count.is_settled();
        let event = Event {
            reset: clock == 0 || random.below(500) == 0,
            takes: choice < 20 && !(is_settled && choice < 3) && count.fresh < 0x7f00,
            ends: choice > 34 && since_end >= 2,
            solo_inserts: choice == 0 && is_settled,
            seeds: choice == 1 && is_settled,
            clears: choice == 2 && is_settled,
        };
        since_end = if event.ends { 0 } else { since_end + 1 };
        ends += usize::from(event.ends);
        count_clock(&mut block, &mut count, event);
    }
    assert!(ends > 300, "{ends}");
}

#[test]
fn fresh_ids_show_the_wave_of_their_header() {
    let mut block = Stepper::new("fresh_ids", FreshIds::default(), 4);
    let mut count = Count::default();
    count_clock(&mut block, &mut count, Event { reset: true, ..Event::default() });
    let mut wave = Wave::default();
    for clock in 0..11 {
        let event = Event { seeds: clock == 1, takes: clock == 4 || clock == 5, ends: clock == 7, ..Event::default() };
        wave.take(&[
            ("seeds", Cell::Bit(event.seeds)),
            ("takes", Cell::Bit(event.takes)),
            ("ends", Cell::Bit(event.ends)),
            ("fresh", number(count.fresh)),
            ("records", number(count.records)),
        ]);
        count_clock(&mut block, &mut count, event);
    }
    wave.assert_drawn_in("fresh_ids");
}
