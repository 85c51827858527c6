//! The program Verilator: where it is, how it is called, and how it fails.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::error::BuildError;
use super::file::write;
use super::source::{ModelSource, Optimisation};

/// The installed Verilator.
#[derive(Clone, Debug)]
pub struct Verilator {
    version: String,
    include: PathBuf,
}

impl Verilator {
    /// Asks the `verilator` in PATH for its version and for the folder of its C++ runtime.
    ///
    /// # Errors
    /// Verilator is missing, broken, or older than 5.006.
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

    /// The output of `verilator --version`.
    pub fn version(&self) -> &str {
        &self.version
    }

    /// The folder that has `verilated.h`.
    pub fn include(&self) -> &Path {
        &self.include
    }

    /// Translates the model into the C++ class `class`, in `folder/cpp`.
    pub(super) fn translate(&self, model: &ModelSource, class: &str, folder: &Path) -> Result<(), BuildError> {
        write(&folder.join("model.v"), &model.verilog)?;
        run(&arguments(model, class), folder).map(|_| ())
    }
}

/// The arguments of a translation. No path of this machine is among them, so they can be part of the cache's key.
pub(super) fn arguments<'a>(model: &'a ModelSource, class: &'a str) -> Vec<&'a str> {
    let mut arguments = vec!["--cc", "--Mdir", "cpp", "--prefix", class];
    arguments.extend(["--top-module", &model.top]);
    // In waveforms one clock is ten nanoseconds. Most texts have no `timescale`, so the command line sets it.
    arguments.extend(["--timescale", "1ns/1ns"]);
    // WIDTH: generators count literals as 32 bits; the lint of the gate and co-simulation check widths. UNOPTFLAT
    // concerns speed, not correctness.
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

/// Releases of Verilator are numbered 5.006, 5.008 and so on. Builds that print no number are newer than that rule.
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
