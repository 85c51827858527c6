//! A model to build, with its options.

use std::path::Path;

use super::error::BuildError;

/// The effort of the C++ compiler on a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Optimisation {
    /// `-O1`: a model compiles in a second, for blocks that are tested over thousands of clocks.
    Quick,
    /// `-O2`, or `-O3` with `fast_clocks`, and `-O3` of Verilator: for whole cores that run millions of clocks.
    Fast,
}

/// A model to build.
#[derive(Clone, Debug)]
pub struct ModelSource {
    pub(super) name: String,
    pub(super) top: String,
    pub(super) verilog: String,
    pub(super) trace: bool,
    pub(super) random_initial_state: bool,
    pub(super) optimisation: Optimisation,
    pub(super) fast_clocks: bool,
}

impl ModelSource {
    /// The module `top` of this Verilog text, as the model `name`: without traces, with zero initial
    /// state, quick to compile.
    ///
    /// `name` becomes a Rust function and part of C++ names. A name starts with a lower-case letter, and has only
    /// lower-case letters, digits and single underscores; any other name is an error of `Builder::try_compile`.
    pub fn new(name: &str, top: &str, verilog: impl Into<String>) -> Self {
        Self {
            name: name.to_string(),
            top: top.to_string(),
            verilog: verilog.into(),
            trace: false,
            random_initial_state: false,
            optimisation: Optimisation::Quick,
            fast_clocks: false,
        }
    }

    /// The module `top` of a Verilog file, as the model `name`. The build script runs again when the file changes.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn file(name: &str, top: &str, path: impl AsRef<Path>) -> Result<Self, BuildError> {
        let path = path.as_ref();
        println!("cargo:rerun-if-changed={}", path.display());
        let verilog =
            std::fs::read_to_string(path).map_err(|source| BuildError::File { path: path.to_path_buf(), source })?;
        Ok(Self::new(name, top, verilog))
    }

    /// Chooses whether the model can write VCD waveforms. Such a model takes longer to compile, and is slower even
    /// while no trace is open.
    pub fn trace(mut self, on: bool) -> Self {
        self.trace = on;
        self
    }

    /// Chooses whether registers and memories can start with random contents (`Model::randomized`). Without this option
    /// they start as zero, whatever the seed.
    pub fn random_initial_state(mut self, on: bool) -> Self {
        self.random_initial_state = on;
        self
    }

    /// Chooses the effort of the C++ compiler.
    pub fn optimisation(mut self, level: Optimisation) -> Self {
        self.optimisation = level;
        self
    }

    /// Chooses whether the text is rewritten before it is translated, so that a clock costs about half as much and the
    /// model compiles sooner. All outputs stay the same. The root module needs a single clock, the input `clock`, which
    /// only `Model::clock` may drive, and one port a line, as `input wire [31:0] name,`. For whole cores; blocks whose
    /// inputs change at every clock gain little.
    pub fn fast_clocks(mut self, on: bool) -> Self {
        self.fast_clocks = on;
        self
    }

    pub(super) fn check_name(&self) -> Result<(), BuildError> {
        let valid = self.name.starts_with(|c: char| c.is_ascii_lowercase())
            && self.name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
            && !self.name.contains("__")
            && self.name != "find";
        valid.then_some(()).ok_or_else(|| BuildError::Name { name: self.name.clone() })
    }
}
