//! Boards: makes a bitstream that meets its clock from the source, and the tables of the measurements.
//!
//! A board is a folder under `constraints/` with its pins (`pins.lpf`), a thin top module (`top.v`), a README and a
//! report for each core that was measured: `report.json` for the board's first core, `report-quad.json` and the like
//! for others. A board with an Ethernet port also has `pins-udp.lpf`, `top-udp.v`, and `report-udp.json` and the like.
//! [`BOARDS`] holds what the command must know besides. [`build`] makes a bitstream, and [`renew_tables`] writes the
//! tables of the documents from the reports. [`sizes`] compares cores of many sizes in many families of FPGAs, with the
//! same tools.

mod date;
mod error;
mod flow;
mod json;
mod kept;
mod link;
mod mapping;
mod pll;
mod port;
mod readings;
mod report;
pub mod sizes;
mod table;
mod tools;
mod workshop;

pub use error::BoardError;
pub use flow::{build, Clock, Request};
pub use link::BoardLink;
pub use mapping::mapping;
pub use pll::{Pll, MHZ};
pub use port::Rgmii;
pub use report::{Attempt, Bitstream, Cells, Network, Parts, Report, Seed, Serial, Summary, Versions};
pub use table::{documents, held_text, pages, renew_tables};
pub use tools::Origin;

use incircle_protocol::{Config, LinkConfig, DUAL, FULL, QUAD, SILENCE_MS, SMALL};
use std::path::{Path, PathBuf};

/// Difference between two clocks that are tried, in MHz.
const CLOCK_STEP: u32 = 5;

/// A core on a board.
#[derive(Clone, Copy, Debug)]
pub struct BoardCore {
    /// Configuration of the core.
    pub config: Config,
    /// The clock in MHz that the command tries first: the clock that the last report met, or an aim if there is no
    /// report.
    pub usual_mhz: u32,
}

/// A board for which the command can make a bitstream.
#[derive(Clone, Copy, Debug)]
pub struct Board {
    /// Name of the board's folder under `constraints/`.
    pub name: &'static str,
    /// Name that the makers of the board use.
    pub title: &'static str,
    /// The FPGA with its speed grade and package.
    pub device: &'static str,
    /// Name of the module in the board's `top.v`.
    pub top: &'static str,
    /// Options of nextpnr that name the FPGA.
    pub chip: [&'static str; 5],
    /// Frequency of the oscillator in Hz.
    pub oscillator_hz: u32,
    /// The largest clock that a user may ask for, in MHz.
    pub most_mhz: u32,
    /// The smallest clock that the command tries, in MHz; if the board misses this clock, the command fails.
    pub least_mhz: u32,
    /// The cores to measure on this board: each has a row in the tables and a report. The command takes the first
    /// unless the user names another.
    pub cores: &'static [BoardCore],
    /// Size of the link's receive FIFO in bytes.
    pub fifo_bytes: u32,
    /// The chip or probe at the other end of the serial line.
    pub bridge: &'static str,
    /// The highest rate of that chip or probe, in bits per second.
    pub bridge_rate: u32,
    /// The Ethernet port, if the board has one.
    pub ethernet: Option<Rgmii>,
}

/// All boards; the first one is the reference.
pub const BOARDS: [Board; 3] = [
    Board {
        name: "ulx3s-85f",
        title: "ULX3S-85F",
        device: "LFE5U-85F-6BG381C",
        top: "ulx3s_85f",
        chip: ["--85k", "--speed", "6", "--package", "CABGA381"],
        oscillator_hz: 25 * MHZ,
        most_mhz: 150,
        least_mhz: 40,
        cores: &[BoardCore { config: FULL, usual_mhz: 120 }, BoardCore { config: QUAD, usual_mhz: 100 }],
        fifo_bytes: 16384,
        bridge: "FT231X",
        bridge_rate: 3_000_000,
        ethernet: None,
    },
    Board {
        name: "colorlight-i5",
        title: "Colorlight i5",
        device: "LFE5U-25F-6BG381C",
        top: "colorlight_i5",
        chip: ["--25k", "--speed", "6", "--package", "CABGA381"],
        oscillator_hz: 25 * MHZ,
        most_mhz: 150,
        least_mhz: 50,
        cores: &[BoardCore { config: SMALL, usual_mhz: 120 }],
        fifo_bytes: 4096,
        bridge: "DAPLink",
        bridge_rate: 115_200,
        // litex-boards' target delays nothing on the way to the PHY, and LiteEth received data by 2 ns unless told
        // else.
        ethernet: Some(Rgmii { phy: "B50612D", usual_mhz: 105, delay: 80, clock_delay: 0 }),
    },
    Board {
        name: "ecpix-5",
        title: "ECPIX-5 85F",
        device: "LFE5UM5G-85F-8BG554I",
        top: "ecpix_5",
        chip: ["--um5g-85k", "--speed", "8", "--package", "CABGA554"],
        oscillator_hz: 100 * MHZ,
        most_mhz: 180,
        least_mhz: 50,
        cores: &[
            BoardCore { config: FULL, usual_mhz: 150 },
            BoardCore { config: DUAL, usual_mhz: 150 },
            BoardCore { config: QUAD, usual_mhz: 135 },
        ],
        fifo_bytes: 16384,
        bridge: "FT2232H",
        bridge_rate: 12_000_000,
        // litex-boards' target delays no received data, and LiteEth the clock to the PHY by 2 ns unless told else.
        ethernet: Some(Rgmii { phy: "gigabit PHY", usual_mhz: 150, delay: 0, clock_delay: 80 }),
    },
];

impl Board {
    /// The board with this name, if there is one.
    pub fn named(name: &str) -> Option<Self> {
        BOARDS.into_iter().find(|board| board.name == name)
    }

    /// The core of the board with this configuration. A configuration that is not in `cores` is tried at the clock of
    /// the first core.
    pub fn core(&self, config: Config) -> BoardCore {
        let usual_mhz = self.cores.first().map_or(self.least_mhz, |core| core.usual_mhz);
        self.cores.iter().find(|core| core.config == config).copied().unwrap_or(BoardCore { config, usual_mhz })
    }

    /// The file with the report on a core of this configuration; `None` if such reports are not kept. `suffix` is that
    /// of the link, see [`BoardLink::suffix`].
    pub fn report(&self, config: Config, suffix: &str) -> Option<PathBuf> {
        let place = self.cores.iter().position(|core| core.config == config)?;
        let core = if place == 0 { String::new() } else { format!("-{}", config.name) };
        Some(self.folder().join(format!("report{core}{suffix}.json")))
    }

    /// The folder of the board.
    pub fn folder(&self) -> PathBuf {
        constraints().join(self.name)
    }

    /// The clocks to try from `most_mhz` down, in MHz: multiples of [`CLOCK_STEP`] that the PLL makes exactly.
    pub fn clocks(&self, most_mhz: u32) -> Vec<u32> {
        let multiples = (self.least_mhz.div_ceil(CLOCK_STEP)..=most_mhz / CLOCK_STEP).rev();
        multiples.map(|multiple| multiple * CLOCK_STEP).filter(|&mhz| self.pll(mhz).is_some()).collect()
    }

    /// The settings of the PLL for a clock, if the PLL can make the clock exactly.
    pub fn pll(&self, clock_mhz: u32) -> Option<Pll> {
        Pll::new(self.oscillator_hz, clock_mhz * MHZ)
    }

    /// The file in `constraints/ecp5` with the places of block RAMs, if the board has one of the largest devices and
    /// there is such a file for this core.
    fn floorplan(&self, config: Config) -> Option<String> {
        let name = format!("floorplan-{}.ys", config.name);
        let is_there = constraints().join("ecp5").join(&name).exists();
        (is_there && self.chip[0].ends_with("85k")).then_some(name)
    }

    /// The parameters of the serial link at a clock.
    pub fn link(&self, clock_mhz: u32) -> LinkConfig {
        LinkConfig { clock_hz: clock_mhz * MHZ, fifo_bytes: self.fifo_bytes, silence_ms: SILENCE_MS }
    }
}

/// The root folder of the repository.
fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The folder that holds a folder for each board.
fn constraints() -> PathBuf {
    repository().join("constraints")
}
