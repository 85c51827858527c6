//! Runs `Watchdog` in Rust and in Verilog beside lists of what must happen: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::Watchdog;
use incircle_protocol::{patience, MAX_POINTS};
use incircle_testkit::SplitMix64;

named_ports!(Watchdog, [reset, finishes, is_quiet, patience], [stuck], clock);

#[test]
fn watchdog_loses_its_patience_and_not_before() {
    let mut random = SplitMix64::new(34);
    let mut block = Stepper::new("watchdog", Watchdog::default(), 1);
    for given in [0, 1, 5, 40] {
        let (mut idle_since, mut rested, mut is_over, mut stuck, mut times) = (0, false, false, false, 0);
        for clock in 0..2000 {
            let reset = clock == 0 || random.below(if stuck { 10 } else { 200 }) == 0;
            let [finishes, is_quiet] = [(); 2].map(|()| random.below(2 * given + 8) == 0);
            block.set("reset", reset);
            block.set("finishes", finishes);
            block.set("is_quiet", is_quiet);
            block.set("patience", given);
            block.settle();
            if clock > 0 {
                block.expect("stuck", stuck);
            }
            block.edge();
            // Three facts are known a clock later each: the core rests, it has taken too long, it is stuck.
            times += usize::from(!stuck && is_over);
            stuck = !reset && (stuck || is_over);
            is_over = !reset && clock - idle_since == given;
            if rested || reset {
                idle_since = clock + 1;
            }
            rested = !reset && (finishes || is_quiet);
        }
        assert!(times > 5, "{times}");
    }
    assert!(patience(MAX_POINTS) < 1 << 22, "the port is wide enough");
}

#[test]
fn watchdog_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("watchdog", Watchdog::default(), 1);
    block.set("patience", 4u64);
    let mut wave = Wave::default();
    for clock in 0..17 {
        let (is_quiet, finishes) = (clock == 1, clock == 4);
        block.set("reset", clock == 0);
        block.set("is_quiet", is_quiet);
        block.set("finishes", finishes);
        block.settle();
        if clock > 0 {
            wave.take(&[
                ("is_quiet", Cell::Bit(is_quiet)),
                ("finishes", Cell::Bit(finishes)),
                ("stuck", Cell::Bit(block.is("stuck"))),
            ]);
        }
        block.edge();
    }
    wave.assert_drawn_in("watchdog");
}
