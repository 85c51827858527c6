//! Runs `ResetHandshake` in Rust and in Verilog: both must agree at every edge of either clock, at ratios of 1:4 to 4:1
//! with phases that drift, with resets of any length, and with a clock of the port that stands for a while.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use crate::rig::stream_rig::{rise, Clocks, PERIODS};
use incircle_hdl::udp::ResetHandshake;
use incircle_testkit::SplitMix64;

named_ports!([] ResetHandshake, [core_clock, port_clock, reset], [core_resets, port_resets]);

const CORE_AND_PORT: [&str; 2] = ["core_clock", "port_clock"];
/// Rises of either clock after which the block has come to rest from any contents.
const KNOWN: usize = 400;

/// The block between its clocks.
struct Rig {
    block: Stepper<ResetHandshake>,
    clocks: Clocks,
    /// The clock of the port stands.
    stands: bool,
    /// Rises of the port's clock in reset since `reset` was last 1.
    in_reset: u32,
    /// Rises of the core's clock since `reset` began, while it lasts.
    lasts: u32,
}

impl Rig {
    fn new(periods: [u64; 2], seed: u64) -> Self {
        let block = Stepper::new("udp_reset_handshake", ResetHandshake::default(), seed as u32);
        let mut rig = Self { block, clocks: Clocks::new(periods, seed), stands: false, in_reset: 0, lasts: 0 };
        for time in 0..KNOWN {
            rig.step(time < KNOWN / 2, time == KNOWN - 1);
        }
        rig
    }

    /// Lets the next clock rise. Compares both forms of the block, unless their contents may still differ.
    fn step(&mut self, reset: bool, is_known: bool) {
        let mut rises = self.clocks.next();
        rises[1] &= !self.stands;
        self.block.set("reset", reset);
        self.block.settle();
        if is_known {
            let port_resets = self.block.is("port_resets");
            self.in_reset = match (reset, rises[1] && port_resets) {
                (true, _) => 0,
                (false, counts) => self.in_reset + u32::from(counts),
            };
            self.lasts = if reset { self.lasts + u32::from(rises[0]) } else { 0 };
            assert!(self.lasts < 5 || self.block.is("core_resets"), "a reset of {} clocks is not seen", self.lasts);
        }
        rise(&mut self.block, [(CORE_AND_PORT[0], rises[0]), (CORE_AND_PORT[1], rises[1])]);
    }

    /// Steps without a reset until the core's side has left its own, and returns the number of steps, up to `most`.
    fn ends_within(&mut self, most: usize) -> Option<usize> {
        (0..most).find(|_| {
            self.step(false, true);
            !self.block.is("core_resets")
        })
    }
}

#[test]
fn a_reset_ends_when_both_sides_had_one() {
    let mut stood = 0;
    for (seed, periods) in PERIODS.into_iter().enumerate() {
        let mut random = SplitMix64::new(seed as u64);
        let mut rig = Rig::new(periods, seed as u64);
        // Rises of either clock in as many clocks of the port as a reset and its synchronisers take.
        let whole = 40 * (1 + periods[1].max(periods[0]) / periods[0].min(periods[1])) as usize;
        for _ in 0..200 {
            assert!(!rig.block.is("core_resets") && !rig.block.is("port_resets"), "at rest at {periods:?}");
            rig.stands = random.below(2) == 0;
            // A core that is four times slower needs more steps to see four of its clocks.
            for _ in 0..random.below(60) + 6 * (1 + periods[0].max(periods[1]) / periods[1].min(periods[0])) {
                rig.step(true, true);
            }
            if rig.stands {
                stood += 1;
                assert_eq!(rig.ends_within(random.below(300) as usize), None, "the port's clock stands");
                rig.stands = false;
            }
            let ended = rig.ends_within(whole);
            assert!(ended.is_some(), "a reset takes more than {whole} steps at {periods:?}");
            assert!(!rig.block.is("port_resets"), "the port's side is still in reset at {periods:?}");
            for _ in 0..random.below(60) + 20 {
                rig.step(false, true);
                assert!(!rig.block.is("core_resets") && !rig.block.is("port_resets"), "no reset was asked for");
            }
        }
    }
    assert!(stood > 500, "the port's clock stood {stood} times");
}

#[test]
fn the_port_is_in_reset_for_eight_clocks() {
    for (seed, periods) in PERIODS.into_iter().enumerate() {
        for stands in [false, true] {
            let mut rig = Rig::new(periods, seed as u64);
            rig.stands = stands;
            // The clock of the port is not slower than a quarter of the core's, so that it rises a few times at most
            // while this reset lasts; those rises do not count here.
            for _ in 0..6 * (1 + periods[0].max(periods[1]) / periods[1].min(periods[0])) {
                rig.step(true, true);
            }
            rig.stands = false;
            assert!(rig.ends_within(800).is_some());
            assert!(!stands || rig.in_reset >= ResetHandshake::PORT_CLOCKS, "{} clocks at {periods:?}", rig.in_reset);
        }
    }
}

#[test]
fn a_reset_during_a_reset_is_whole_too() {
    for (seed, periods) in PERIODS.into_iter().enumerate() {
        let mut random = SplitMix64::new(99 + seed as u64);
        let mut rig = Rig::new(periods, seed as u64);
        for _ in 0..300 {
            // Resets that follow each other at any distance, shorter and longer than the handshake.
            for _ in 0..random.below(4) + 1 {
                rig.stands = random.below(3) == 0;
                for _ in 0..random.below(80) {
                    rig.step(true, true);
                }
                for _ in 0..random.below(80) {
                    rig.step(false, true);
                }
            }
            rig.stands = false;
            // The last of them may still be in the synchroniser.
            (0..40).for_each(|_| rig.step(false, true));
            let quiet = (0..1600).position(|_| {
                rig.step(false, true);
                !rig.block.is("core_resets") && !rig.block.is("port_resets")
            });
            assert!(quiet.is_some(), "the block does not come to rest at {periods:?}");
            for _ in 0..100 {
                rig.step(false, true);
                assert!(!rig.block.is("core_resets") && !rig.block.is("port_resets"), "a reset came late");
            }
        }
    }
}

#[test]
fn a_long_reset_holds_both_sides() {
    let mut rig = Rig::new([10_000, 8000], 5);
    for time in 0..2000 {
        rig.step(true, true);
        assert!(time < 60 || rig.block.is("core_resets") && rig.block.is("port_resets"), "at step {time}");
    }
}

#[test]
fn wave_of_a_short_reset_at_equal_clocks() {
    let mut block = Stepper::new("udp_reset_handshake", ResetHandshake::default(), 1);
    let mut wave = Wave::default();
    for time in 0..KNOWN + 26 {
        let reset = time < KNOWN / 2 || (KNOWN + 1..KNOWN + 5).contains(&time);
        block.set("reset", reset);
        block.settle();
        if time >= KNOWN {
            wave.take(&[
                ("reset", Cell::Bit(reset)),
                ("core_resets", Cell::Bit(block.is("core_resets"))),
                ("port_resets", Cell::Bit(block.is("port_resets"))),
            ]);
        }
        rise(&mut block, [(CORE_AND_PORT[0], true), (CORE_AND_PORT[1], true)]);
    }
    wave.assert_drawn_in("reset_handshake");
}
