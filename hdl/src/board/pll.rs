//! Finds settings of the ECP5's PLL for a clock.
//!
//! Source of the limits: Lattice, ECP5 and ECP5-5G Family Data Sheet, sysCLOCK PLL timing. `constraints/ecp5/clock.v`
//! says what the dividers do.

/// Number of Hz in a MHz.
pub const MHZ: u32 = 1_000_000;

const LEAST_COMPARED_HZ: u64 = 10 * MHZ as u64;
const LEAST_VCO_HZ: u64 = 400 * MHZ as u64;
const MOST_VCO_HZ: u64 = 800 * MHZ as u64;
const MOST_DIVIDER: u64 = 128;

/// The three dividers of the PLL; see `constraints/ecp5/clock.v`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pll {
    /// Divider between the oscillator and the phase detector.
    pub input_divider: u32,
    /// Divider between the VCO and the phase detector.
    pub loop_divider: u32,
    /// Divider between the VCO and the clock.
    pub output_divider: u32,
}

impl Pll {
    /// The settings that make exactly `clock_hz` from `oscillator_hz`, or `None`. Among several, those with the highest
    /// frequency at the phase detector win, and among these the ones with the VCO nearest to the middle of its range.
    pub fn new(oscillator_hz: u32, clock_hz: u32) -> Option<Self> {
        let (oscillator, clock) = (u64::from(oscillator_hz), u64::from(clock_hz));
        let input_dividers = 1..=(oscillator / LEAST_COMPARED_HZ).min(MOST_DIVIDER);
        let mut settings = input_dividers.filter_map(|input| Self::with_input(oscillator, clock, input));
        settings.next()
    }

    fn with_input(oscillator: u64, clock: u64, input: u64) -> Option<Self> {
        let outputs = (1..=MOST_DIVIDER).filter_map(|output| {
            let vco = clock * output;
            let is_possible = (LEAST_VCO_HZ..=MOST_VCO_HZ).contains(&vco) && (vco * input).is_multiple_of(oscillator);
            let looped = vco * input / oscillator;
            (is_possible && looped <= MOST_DIVIDER).then_some((vco, looped, output))
        });
        let middle = (LEAST_VCO_HZ + MOST_VCO_HZ) / 2;
        let (_, looped, output) = outputs.min_by_key(|(vco, _, _)| vco.abs_diff(middle))?;
        let divider = |value: u64| u32::try_from(value).ok();
        Some(Self { input_divider: divider(input)?, loop_divider: divider(looped)?, output_divider: divider(output)? })
    }

    /// The Verilog macro that passes the settings to the top module of a board.
    pub fn define(self) -> String {
        format!("BOARD_PLL={},{},{}", self.input_divider, self.loop_divider, self.output_divider)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_settings() {
        let settings = |oscillator, clock| Pll::new(oscillator * MHZ, clock * MHZ).map(|pll| pll.define());
        assert_eq!(settings(25, 125).as_deref(), Some("BOARD_PLL=1,25,5"));
        assert_eq!(settings(25, 95).as_deref(), Some("BOARD_PLL=1,19,5"));
        assert_eq!(settings(100, 150).as_deref(), Some("BOARD_PLL=1,6,4"));
        assert_eq!(settings(100, 155).as_deref(), Some("BOARD_PLL=4,31,5"));
        assert_eq!(settings(25, 149), None);
        assert_eq!(Pll::new(5 * MHZ, 125 * MHZ), None);
    }

    #[test]
    fn every_setting_is_exact_and_inside_the_limits() {
        for oscillator in [12, 25, 48, 100].map(|mhz| mhz * MHZ) {
            for clock in (50..=200).map(|mhz| mhz * MHZ) {
                let Some(pll) = Pll::new(oscillator, clock) else { continue };
                let [input, looped, output] = [pll.input_divider, pll.loop_divider, pll.output_divider].map(u64::from);
                assert_eq!(u64::from(oscillator) * looped, u64::from(clock) * input * output);
                let vco = u64::from(clock) * output;
                assert!((LEAST_VCO_HZ..=MOST_VCO_HZ).contains(&vco), "{vco}");
                assert!(u64::from(oscillator) / input >= LEAST_COMPARED_HZ);
                assert!(input.max(looped).max(output) <= MOST_DIVIDER);
            }
        }
    }
}
