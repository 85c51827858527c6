//! Boards: from the source to a bitstream that meets its clock, and the table of what was measured.
//!
//! A board is a folder under `constraints/` with its pins (`pins.lpf`), a thin top (`top.v`), a README and the report of the last
//! measurement (`report.json`); [`BOARDS`] holds what the command must know besides. [`build`] makes a bitstream, [`renew_tables`]
//! writes the tables of the documents from the reports.

mod date;
mod error;
mod flow;
mod mapping;
mod pll;
mod readings;
mod report;
mod table;
mod tools;
mod workshop;

pub use error::BoardError;
pub use flow::{build, Clock, Request};
pub use mapping::mapping;
pub use pll::{Pll, MHZ};
pub use report::{Attempt, Bitstream, Cells, Parts, Report, Seed, Serial, Summary, Versions};
pub use table::{documents, held_text, pages, renew_tables};
pub use tools::Origin;

use incircle_protocol::{Config, LinkConfig, FULL, SILENCE_MS, SMALL};
use std::path::{Path, PathBuf};

/// MHz between two clocks that are tried.
const CLOCK_STEP: u32 = 5;

/// A board that a bitstream can be made for.
#[derive(Clone, Copy, Debug)]
pub struct Board {
    /// Name of its folder under `constraints/`.
    pub name: &'static str,
    /// What its makers call it.
    pub title: &'static str,
    /// The FPGA, with speed grade and package.
    pub device: &'static str,
    /// Module of its `top.v`.
    pub top: &'static str,
    /// Options of nextpnr that name the FPGA.
    pub chip: [&'static str; 5],
    /// Its oscillator in Hz.
    pub oscillator_hz: u32,
    /// The largest clock that may be asked for, in MHz.
    pub most_mhz: u32,
    /// The clock that is tried unless another is asked for, in MHz: what its last report met.
    pub usual_mhz: u32,
    /// The smallest clock that is tried, in MHz; below it the command fails.
    pub least_mhz: u32,
    /// Configuration of the core, unless another is asked for.
    pub config: Config,
    /// Bytes of the link's receive FIFO.
    pub fifo_bytes: u32,
    /// What the serial line goes to.
    pub bridge: &'static str,
    /// Most bits per second of that.
    pub bridge_rate: u32,
}

/// All boards, the reference first.
pub const BOARDS: [Board; 3] = [
    Board {
        name: "ulx3s-85f",
        title: "ULX3S-85F",
        device: "LFE5U-85F-6BG381C",
        top: "ulx3s_85f",
        chip: ["--85k", "--speed", "6", "--package", "CABGA381"],
        oscillator_hz: 25 * MHZ,
        most_mhz: 150,
        usual_mhz: 120,
        least_mhz: 50,
        config: FULL,
        fifo_bytes: 16384,
        bridge: "FT231X",
        bridge_rate: 3_000_000,
    },
    Board {
        name: "colorlight-i5",
        title: "Colorlight i5",
        device: "LFE5U-25F-6BG381C",
        top: "colorlight_i5",
        chip: ["--25k", "--speed", "6", "--package", "CABGA381"],
        oscillator_hz: 25 * MHZ,
        most_mhz: 150,
        usual_mhz: 120,
        least_mhz: 50,
        config: SMALL,
        fifo_bytes: 4096,
        bridge: "DAPLink",
        bridge_rate: 115_200,
    },
    Board {
        name: "ecpix-5",
        title: "ECPIX-5 85F",
        device: "LFE5UM5G-85F-8BG554I",
        top: "ecpix_5",
        chip: ["--um5g-85k", "--speed", "8", "--package", "CABGA554"],
        oscillator_hz: 100 * MHZ,
        most_mhz: 180,
        usual_mhz: 150,
        least_mhz: 50,
        config: FULL,
        fifo_bytes: 16384,
        bridge: "FT2232H",
        bridge_rate: 12_000_000,
    },
];

impl Board {
    /// The board of this name.
    pub fn named(name: &str) -> Option<Self> {
        BOARDS.into_iter().find(|board| board.name == name)
    }

    /// Its folder.
    pub fn folder(&self) -> PathBuf {
        constraints().join(self.name)
    }

    /// The clocks that are tried from `most_mhz` down, in MHz: multiples of [`CLOCK_STEP`] that the PLL makes exactly.
    pub fn clocks(&self, most_mhz: u32) -> Vec<u32> {
        let multiples = (self.least_mhz.div_ceil(CLOCK_STEP)..=most_mhz / CLOCK_STEP).rev();
        multiples.map(|multiple| multiple * CLOCK_STEP).filter(|&mhz| self.pll(mhz).is_some()).collect()
    }

    /// The PLL's settings for a clock, if it can make that exactly.
    pub fn pll(&self, clock_mhz: u32) -> Option<Pll> {
        Pll::new(self.oscillator_hz, clock_mhz * MHZ)
    }

    /// Whether the floorplan in `constraints/ecp5` is for it: one of the largest devices, with the full core.
    pub fn has_floorplan(&self, config: Config) -> bool {
        self.chip[0].ends_with("85k") && config == FULL
    }

    /// The serial link at a clock.
    pub fn link(&self, clock_mhz: u32) -> LinkConfig {
        LinkConfig { clock_hz: clock_mhz * MHZ, fifo_bytes: self.fifo_bytes, silence_ms: SILENCE_MS }
    }
}

/// The root of the repository.
fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The folder of the boards.
fn constraints() -> PathBuf {
    repository().join("constraints")
}
