//! What is said of a board after place and route, as JSON.

use super::error::BoardError;
use super::pll::Pll;
use crate::files::replace;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// What a run of the command found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Name of the board.
    pub board: String,
    /// The FPGA.
    pub device: String,
    /// Day of the run, in UTC.
    pub date: String,
    /// Whether the median of the seeds meets the clock; without that there is no bitstream.
    pub met: bool,
    /// The clock in MHz: of the bitstream, or the last one that was tried.
    pub clock_mhz: u32,
    /// Over all seeds, in MHz.
    pub fmax_mhz: Summary,
    /// Each seed at that clock.
    pub seeds: Vec<Seed>,
    /// The fastest of them, which became the bitstream.
    pub picked_seed: Option<u32>,
    /// Clocks that were tried before and missed.
    pub missed: Vec<Attempt>,
    /// Configuration of the core.
    pub configuration: String,
    /// Points it holds.
    pub points: u32,
    /// Edges of a boundary list.
    pub ring: u32,
    /// Contexts.
    pub contexts: u32,
    /// What it takes.
    pub cells: Parts,
    /// The serial line.
    pub serial: Serial,
    /// The PLL's dividers: input, loop, output.
    pub pll: [u32; 3],
    /// Versions of the tools.
    pub tools: Versions,
    /// The bitstream, if the clock is met.
    pub bitstream: Option<Bitstream>,
}

/// A seed of the placer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seed {
    /// The seed.
    pub seed: u32,
    /// The clock it reaches, in MHz.
    pub fmax_mhz: f64,
}

/// Clocks reached by several seeds, in MHz.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// The slowest.
    pub min: f64,
    /// The middle one, or half-way between the middle two.
    pub median: f64,
    /// The fastest.
    pub max: f64,
}

/// A clock that was tried.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Attempt {
    /// The clock.
    pub clock_mhz: u32,
    /// What the seeds reached.
    pub fmax_mhz: Summary,
}

/// Cells of the device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cells {
    /// Look-up tables of four inputs, those of carry chains and distributed memory included.
    pub lut: u64,
    /// Flip-flops.
    pub ff: u64,
    /// Multipliers of 18 x 18 bits.
    pub dsp: u64,
    /// Block memories of 18 kbit.
    pub ebr: u64,
}

/// Who takes which cells. Core and shell are counted after synthesis, by name; a table between the two counts where its name lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Parts {
    /// The core.
    pub core: Cells,
    /// All else: serial link, clock, reset, lamps.
    pub shell: Cells,
    /// All of it after placement.
    pub placed: Cells,
    /// What the device has.
    pub available: Cells,
}

/// The serial line.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Serial {
    /// What it goes to.
    pub bridge: String,
    /// Most bits per second of both ends.
    pub bits_per_second: u32,
    /// Bytes of the receive FIFO.
    pub fifo_bytes: u32,
}

/// Versions of the tools, as they name them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Versions {
    /// Synthesis.
    pub yosys: String,
    /// Place and route.
    pub nextpnr: String,
    /// Bitstream.
    pub ecppack: String,
}

/// A bitstream.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bitstream {
    /// Its file, beside the report.
    pub file: String,
    /// Its size.
    pub bytes: u64,
    /// Its check sum.
    pub sha256: String,
}

impl Summary {
    /// Of these seeds; all 0 if there are none.
    pub fn of(seeds: &[Seed]) -> Self {
        let mut reached: Vec<_> = seeds.iter().map(|seed| seed.fmax_mhz).collect();
        reached.sort_by(f64::total_cmp);
        let at = |place: usize| reached.get(place).copied().unwrap_or_default();
        let last = reached.len().saturating_sub(1);
        Self { min: at(0), median: (at(last / 2) + at(last.div_ceil(2))) / 2.0, max: at(last) }
    }
}

impl Cells {
    /// There are as many of each kind.
    pub(super) fn is_within(self, all: Self) -> bool {
        self.lut <= all.lut && self.ff <= all.ff && self.dsp <= all.dsp && self.ebr <= all.ebr
    }
}

impl Report {
    /// The report in a file.
    ///
    /// # Errors
    /// It cannot be read or understood.
    pub fn read(path: &Path) -> Result<Self, BoardError> {
        let text = std::fs::read_to_string(path).map_err(BoardError::file(path))?;
        serde_json::from_str(&text).map_err(|error| BoardError::form(path, error))
    }

    /// Writes it to a file.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), BoardError> {
        let text = serde_json::to_string_pretty(self).map_err(|error| BoardError::form(path, error))?;
        replace(path, (text + "\n").as_bytes()).map_err(BoardError::file(path))
    }
}

/// The PLL's dividers in the order of [`Report::pll`].
pub(super) fn dividers(pll: Pll) -> [u32; 3] {
    [pll.input_divider, pll.loop_divider, pll.output_divider]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians() {
        let summary = |reached: &[f64]| {
            let seeds: Vec<_> = reached.iter().map(|&fmax_mhz| Seed { seed: 1, fmax_mhz }).collect();
            Summary::of(&seeds)
        };
        assert_eq!(summary(&[]), Summary { min: 0.0, median: 0.0, max: 0.0 });
        assert_eq!(summary(&[90.0, 70.0, 80.0]), Summary { min: 70.0, median: 80.0, max: 90.0 });
        assert_eq!(summary(&[90.0, 70.0]), Summary { min: 70.0, median: 80.0, max: 90.0 });
    }
}
