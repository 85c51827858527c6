//! Runs `RateControl` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::asked::{CLOSES, OPENS, RATE};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_blocks::QUICK_LINK;
use incircle_hdl::serial::RateControl;
use incircle_protocol::{rate_step, FIRST_RATE, MAX_STEP};
use incircle_testkit::SplitMix64;

named_ports!(
    RateControl,
    [reset, asked, value, fails, acknowledges, closes, is_quiet],
    [step, is_refused, holds],
    clock
);

/// The rate by the rules of the protocol's page.
#[derive(Default)]
struct Rates {
    present: u32,
    wanted: Option<u32>,
    coming: Option<u32>,
    returns: bool,
    refused: bool,
}

#[test]
fn the_rate_changes_behind_its_receipt_and_returns() {
    let first = rate_step(FIRST_RATE, QUICK_LINK.clock_hz).expect("a rate");
    let mut random = SplitMix64::new(9);
    let mut block = Stepper::new("serial_rate_control", RateControl::new(QUICK_LINK), 1);
    let mut rates = Rates::default();
    let mut value = 0u32;
    let (mut changes, mut refusals) = (0, 0);
    for clock in 0..30_000 {
        // The value stands for at least two clocks before it counts.
        let asked =
            if clock % 4 == 3 { [0, 0, 0, RATE, RATE, RATE, OPENS, CLOSES][random.below(8) as usize] } else { 0 };
        if clock % 4 == 0 {
            value = match random.below(6) {
                0 => 0,
                1 => MAX_STEP,
                2 => MAX_STEP + 1 + random.below(u64::from(u32::MAX - MAX_STEP)) as u32,
                _ => 1 + random.below(u64::from(MAX_STEP)) as u32,
            };
        }
        let reset = clock == 0;
        let [fails, begins, closes, is_quiet] = [200, 9, 4, 3].map(|times| clock > 0 && random.below(times) == 0);
        // A frame begins only while the rate is not about to change.
        let begins = begins && rates.coming.is_none() && !rates.returns;
        let (acknowledges, closes) = (begins && !closes, begins && closes);
        block.set("asked", asked);
        block.set("value", value);
        for (port, bit) in [
            ("reset", reset),
            ("fails", fails),
            ("acknowledges", acknowledges),
            ("closes", closes),
            ("is_quiet", is_quiet),
        ] {
            block.set(port, bit);
        }
        block.settle();
        if clock > 0 {
            block.expect("step", rates.present);
            block.expect("is_refused", rates.refused);
            block.expect("holds", rates.coming.is_some() || rates.returns);
        }
        block.edge();
        let before = rates.present;
        if is_quiet {
            if let Some(step) = rates.coming.take() {
                rates.present = step;
            }
            if std::mem::take(&mut rates.returns) {
                rates.present = first;
            }
        }
        if acknowledges {
            rates.coming = rates.wanted.take();
        }
        rates.returns |= closes;
        if asked == RATE {
            let is_fit = (1..=MAX_STEP).contains(&value);
            rates.refused = !is_fit;
            rates.wanted = is_fit.then_some(value);
            refusals += usize::from(!is_fit);
        }
        if asked == OPENS || asked == CLOSES {
            (rates.wanted, rates.refused) = (None, false);
        }
        if fails || reset {
            rates = Rates { present: first, ..Rates::default() };
        }
        changes += usize::from(rates.present != before);
    }
    assert!(changes > 100 && refusals > 100, "{changes} changes, {refusals} refusals");
}
