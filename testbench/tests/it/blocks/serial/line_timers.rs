//! Runs `LineTimers` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_blocks::HASTY_LINK;
use incircle_hdl::serial::LineTimers;
use incircle_testkit::SplitMix64;

named_ports!(LineTimers, [reset, is_low, hears], [is_broken, is_silent, beat], clock);

#[test]
fn timers_tell_silence_and_breaks() {
    let eighth = HASTY_LINK.clock_hz as usize / 8000;
    let millisecond = 8 * eighth;
    let silence = HASTY_LINK.silence_ms as usize * millisecond;
    let mut random = SplitMix64::new(8);
    let mut block = Stepper::new("serial_line_timers", LineTimers::new(HASTY_LINK), 1);
    let (mut low_for, mut silent_for) = (0, 0);
    let (mut low_left, mut hears_in) = (0, 0);
    let (mut breaks, mut silences, mut beats) = (0, 0, 0);
    let (mut was_broken, mut was_silent, mut beat) = (false, false, false);
    for clock in 0..400_000 {
        if low_left == 0 && random.below(3 * millisecond as u64) == 0 {
            low_left = 1 + random.below(2 * millisecond as u64);
        }
        let is_low = clock > 0 && low_left > 0;
        low_left = low_left.saturating_sub(1);
        if hears_in == 0 {
            hears_in = 1 + random.below(2 * silence as u64);
        }
        hears_in -= 1;
        let (hears, reset) = (clock > 0 && hears_in == 0, clock == 0);
        for (port, value) in [("reset", reset), ("is_low", is_low), ("hears", hears)] {
            block.set(port, value);
        }
        block.settle();
        if clock > 0 {
            let (is_broken, is_silent) = (block.is("is_broken"), block.is("is_silent"));
            // Bounds of the clock in which each timer fires, from below and from above.
            assert!(low_for >= millisecond || !is_broken, "a break after {low_for} clocks");
            assert!(low_for < millisecond + eighth + 3 || is_broken, "no break after {low_for} clocks");
            assert!(silent_for >= silence || !is_silent, "silence after {silent_for} clocks");
            assert!(silent_for < silence + eighth + 3 || is_silent, "no silence after {silent_for} clocks");
            breaks += usize::from(is_broken && !was_broken);
            silences += usize::from(is_silent && !was_silent);
            beats += usize::from(beat != block.is("beat"));
            (was_broken, was_silent, beat) = (is_broken, is_silent, block.is("beat"));
        }
        block.edge();
        low_for = if is_low { low_for + 1 } else { 0 };
        silent_for = if hears || reset { 0 } else { silent_for + 1 };
    }
    assert!(breaks > 20 && silences > 3, "{breaks} breaks, {silences} silences");
    assert!(beats <= 1, "{beats} beats in less than half a second");
}
