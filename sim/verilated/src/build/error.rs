//! Why models could not be built.

use std::path::PathBuf;

/// Why models could not be built.
#[derive(Debug, thiserror::Error)]
pub enum BuildError {
    /// No Verilator in PATH, or it does not start.
    #[error("cannot run Verilator ({0}): install Debian package verilator, 5.006 or newer")]
    Missing(std::io::Error),
    /// Verilator is older than the binding knows.
    #[error("{found:?} is too old: install Debian package verilator, 5.006 or newer")]
    TooOld {
        /// What `verilator --version` printed.
        found: String,
    },
    /// Verilator ended with an error.
    #[error("Verilator failed at {what}:\n{output}")]
    Refused {
        /// What it was asked to do.
        what: String,
        /// All it printed.
        output: String,
    },
    /// The C++ compiler ended with an error, or is missing.
    #[error("cannot compile the C++ that Verilator wrote (install Debian package g++ if there is no compiler): {0}")]
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
        "a model cannot be called {name:?}: use lower-case letters, digits and single underscores, begin with a letter, and avoid `find`"
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
    #[error("the variable {variable} is not set: call this from a build script of cargo")]
    NotABuildScript {
        /// The variable that cargo sets.
        variable: &'static str,
    },
}
