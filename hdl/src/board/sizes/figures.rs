//! The figures of all sizes, as they are kept in `hdl/sizes.json`.

use super::super::{json, repository, BoardError};
use super::family::FamilyCells;
use incircle_protocol::{Config, DUAL, FULL, LARGE, QUAD, SMALL};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The cores to measure. Two without a name of their own lie between `small` and `full`.
pub const SIZES: [Config; 7] = [
    SMALL,
    Config { name: "custom", points: 2048, ring: FULL.ring, contexts: 16, engines: 1 },
    Config { name: "custom", points: 4096, ring: FULL.ring, contexts: 16, engines: 1 },
    FULL,
    LARGE,
    DUAL,
    QUAD,
];

/// The figures of all sizes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sizes {
    /// Version of yosys.
    pub yosys: String,
    /// Day of the run, in UTC.
    pub date: String,
    pub sizes: Vec<Size>,
}

/// The figures of a size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Size {
    pub configuration: String,
    pub engines: u32,
    /// Number of points that an engine holds.
    pub points: u32,
    /// Number of contexts of an engine.
    pub contexts: u32,
    /// The cells, by the name of the family.
    pub cells: BTreeMap<String, FamilyCells>,
    /// The placement on the reference board, if there was one.
    pub placed: Option<Placed>,
}

/// A placement with one seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Placed {
    pub board: String,
    /// The clock that the seed reaches, in MHz.
    pub fmax_mhz: f64,
}

impl Size {
    /// The core of these figures; `None` if it is none of [`SIZES`].
    pub fn config(&self) -> Option<Config> {
        let own = (self.engines, self.points, self.contexts);
        SIZES.into_iter().find(|config| (config.engines, config.points, config.contexts) == own)
    }
}

impl Sizes {
    /// The figures with those of another measurement in the place of older ones, in the order of [`SIZES`].
    #[must_use]
    pub fn renewed_by(mut self, newer: Self) -> Self {
        for mut size in newer.sizes {
            let config = size.config();
            if let Some(place) = self.sizes.iter().position(|old| old.config() == config) {
                let old = self.sizes.swap_remove(place);
                size.placed = size.placed.or(old.placed);
                size.cells = old.cells.into_iter().chain(size.cells).collect();
            }
            self.sizes.push(size);
        }
        self.sizes.sort_by_key(|size| SIZES.iter().position(|config| Some(*config) == size.config()));
        Self { yosys: newer.yosys, date: newer.date, sizes: self.sizes }
    }

    /// Reads the figures from a file.
    ///
    /// # Errors
    /// If the file cannot be read or understood.
    pub fn read(path: &Path) -> Result<Self, BoardError> {
        json::read(path)
    }

    /// Writes the figures to a file.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), BoardError> {
        json::write(path, self)
    }
}

/// The committed file with the figures.
pub fn figures() -> PathBuf {
    repository().join("hdl").join("sizes.json")
}

/// The name of a size for files and for the command line: `full`, or `2048-points`.
pub fn size_name(config: Config) -> String {
    match config.name {
        "custom" => format!("{}-points", config.points),
        name => name.to_owned(),
    }
}
