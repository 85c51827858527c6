//! The report of a board after place and route, as JSON.

use super::error::BoardError;
use super::json;
use super::pll::Pll;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The findings of one run of the command.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Name of the board, that of its folder.
    pub board: String,
    /// The FPGA with its speed grade and package.
    pub device: String,
    /// Day of the run, in UTC.
    pub date: String,
    /// Whether the median of the seeds meets the clock; if not, there is no bitstream.
    pub met: bool,
    /// The clock in MHz: that of the bitstream, or the last one that was tried.
    pub clock_mhz: u32,
    /// The clocks that the seeds reach, in MHz.
    pub fmax_mhz: Summary,
    /// The clock that each seed reaches.
    pub seeds: Vec<Seed>,
    /// The fastest seed, from which the bitstream is made.
    pub picked_seed: Option<u32>,
    /// The clocks that were tried before and missed.
    pub missed: Vec<Attempt>,
    /// Name of the core's configuration.
    pub configuration: String,
    /// Number of points that an engine holds.
    pub points: u32,
    /// Number of edges that a boundary list holds.
    pub ring: u32,
    /// Number of contexts of an engine.
    pub contexts: u32,
    /// Number of engines of the core.
    pub engines: u32,
    /// Whether the core has runs, the commands for a mesh that lives.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub runs: bool,
    /// The cells of the parts of the design.
    pub cells: Parts,
    /// The serial line of the board, if that is the link.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub serial: Option<Serial>,
    /// The Ethernet port of the board, if that is the link.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub network: Option<Network>,
    /// The dividers of the PLL: input, loop, output.
    pub pll: [u32; 3],
    pub tools: Versions,
    /// The bitstream, if the clock is met.
    pub bitstream: Option<Bitstream>,
}

/// The result of one seed of the placer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seed {
    pub seed: u32,
    /// The clock that the seed reaches, in MHz.
    pub fmax_mhz: f64,
    /// The clock that the Ethernet port reaches, in MHz, if that is the link; it must be 125.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub port_fmax_mhz: Option<f64>,
}

/// A summary of the clocks that several seeds reach, in MHz.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// The clock of the slowest seed.
    pub min: f64,
    /// The clock of the middle seed, or the mean of the middle two.
    pub median: f64,
    /// The clock of the fastest seed.
    pub max: f64,
}

/// A clock that was tried and missed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Attempt {
    /// The clock that was tried, in MHz.
    pub clock_mhz: u32,
    /// The clocks that the seeds reached, in MHz.
    pub fmax_mhz: Summary,
}

/// Numbers of cells, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cells {
    /// Look-up tables with four inputs, including those of carry chains and of distributed memory.
    pub lut: u64,
    pub ff: u64,
    /// Multipliers of 18 x 18 bits.
    pub dsp: u64,
    /// Block memories of 18 kbit.
    pub ebr: u64,
}

/// The cells that each part of the design takes. Core and shell are counted by name after synthesis; a look-up table
/// that serves both belongs to the one in its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Parts {
    pub core: Cells,
    /// All besides the core: serial link, clock, reset, lamps.
    pub shell: Cells,
    /// The whole design after placement.
    pub placed: Cells,
    /// The cells that the device has.
    pub available: Cells,
}

/// The serial line of a board.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Serial {
    /// The chip or probe at the other end of the line.
    pub bridge: String,
    /// The highest rate that both ends can use.
    pub bits_per_second: u32,
    /// Size of the receive FIFO in bytes.
    pub fifo_bytes: u32,
}

/// The Ethernet port of a board, and the addresses of the device behind it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Network {
    /// Type of the PHY.
    pub phy: String,
    /// IPv4 address, with the bits of it that name the network, as in `192.168.1.50/24`.
    pub ip: String,
    /// Ethernet address, as in `02:00:00:69:43:01`.
    pub mac: String,
    /// UDP port at which the device listens.
    pub udp_port: u16,
    /// Size of the receive FIFO in bytes.
    pub fifo_bytes: u32,
    /// Taps of 25 ps by which the FPGA delays the data from the PHY.
    pub rgmii_delay: u8,
    /// Taps of 25 ps by which the FPGA delays the clock to the PHY.
    pub rgmii_clock_delay: u8,
    /// The clocks that the seeds reach at the port, in MHz.
    pub fmax_mhz: Summary,
}

/// Versions of the tools, in the words of the tools.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Versions {
    pub yosys: String,
    pub nextpnr: String,
    pub ecppack: String,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bitstream {
    /// Name of the bitstream's file, which lies beside the report.
    pub file: String,
    /// Size of the file in bytes.
    pub bytes: u64,
    /// SHA-256 of the file, in hexadecimal.
    pub sha256: String,
}

impl Summary {
    /// The summary of these seeds, all 0 if there are none.
    pub fn of(seeds: &[Seed]) -> Self {
        Self::of_clocks(seeds.iter().map(|seed| seed.fmax_mhz))
    }

    /// The summary of these clocks, all 0 if there are none.
    pub fn of_clocks(clocks: impl Iterator<Item = f64>) -> Self {
        let mut reached: Vec<_> = clocks.collect();
        reached.sort_by(f64::total_cmp);
        let at = |place: usize| reached.get(place).copied().unwrap_or_default();
        let last = reached.len().saturating_sub(1);
        Self { min: at(0), median: (at(last / 2) + at(last.div_ceil(2))) / 2.0, max: at(last) }
    }
}

impl Cells {
    /// Whether there are no more cells of any kind than in `all`.
    pub(super) fn is_within(self, all: Self) -> bool {
        self.lut <= all.lut && self.ff <= all.ff && self.dsp <= all.dsp && self.ebr <= all.ebr
    }
}

impl Report {
    /// Reads a report from a file.
    ///
    /// # Errors
    /// If the file cannot be read or understood.
    pub fn read(path: &Path) -> Result<Self, BoardError> {
        json::read(path)
    }

    /// Writes the report to a file.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), BoardError> {
        json::write(path, self)
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
            let seeds: Vec<_> =
                reached.iter().map(|&fmax_mhz| Seed { seed: 1, fmax_mhz, port_fmax_mhz: None }).collect();
            Summary::of(&seeds)
        };
        assert_eq!(summary(&[]), Summary { min: 0.0, median: 0.0, max: 0.0 });
        assert_eq!(summary(&[90.0, 70.0, 80.0]), Summary { min: 70.0, median: 80.0, max: 90.0 });
        assert_eq!(summary(&[90.0, 70.0]), Summary { min: 70.0, median: 80.0, max: 90.0 });
    }
}
