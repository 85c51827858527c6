//! The errors of building models.

use std::path::PathBuf;

/// The reason why models could not be built.
#[derive(Debug, thiserror::Error)]
pub enum BuildError {
    /// There is no Verilator in PATH, or it does not start.
    #[error("cannot run Verilator ({0}): install Debian package verilator, 5.006 or newer")]
    Missing(std::io::Error),
    /// Verilator is older than the binding supports.
    #[error("{found:?} is too old: install Debian package verilator, 5.006 or newer")]
    TooOld {
        /// The output of `verilator --version`.
        found: String,
    },
    /// Verilator ended with an error.
    #[error("Verilator failed at {what}:\n{output}")]
    Refused {
        /// The command line that failed.
        what: String,
        /// Everything that Verilator printed.
        output: String,
    },
    /// The C++ compiler ended with an error, or is missing.
    #[error("cannot compile the C++ that Verilator wrote (install Debian package g++ if there is no compiler): {0}")]
    Compiler(#[from] cc::Error),
    /// A file cannot be read or written.
    #[error("cannot read or write {path}: {source}", path = path.display())]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: std::io::Error,
    },
    /// The binding does not support this kind of port.
    #[error("model {model}: port declaration `{declaration}` is neither a plain input nor a plain output")]
    Port {
        /// Name of the model.
        model: String,
        /// The line in Verilator's header.
        declaration: String,
    },
    /// The inputs of the module cannot be held, as `ModelSource::fast_clocks` asks.
    #[error(
        "model {model}: module {top} needs an input `clock`, and each port on a line such as `input wire [31:0] name,`"
    )]
    Inputs {
        /// Name of the model.
        model: String,
        /// Name of the root module.
        top: String,
    },
    /// The name cannot become the name of a function.
    #[error(
        "a model cannot be called {name:?}: use lower-case letters, digits and single underscores, begin with a \
         letter, and avoid `find`"
    )]
    Name {
        /// The name that was given.
        name: String,
    },
    /// Two models have the same name.
    #[error("two models are called {name:?}: give each its own name")]
    NameTwice {
        /// The name that both have.
        name: String,
    },
    /// The builder was called outside a build script.
    #[error("the variable {variable} is not set: call this from a build script of cargo")]
    NotABuildScript {
        /// The variable that cargo sets for build scripts.
        variable: &'static str,
    },
}
