//! The errors of a build for a board.

use super::port::PORT_MHZ;
use crate::export::ExportError;
use std::path::PathBuf;

/// The reason why there is no bitstream or no table.
#[derive(Debug, thiserror::Error)]
pub enum BoardError {
    /// The design is not fit for export.
    #[error("{0}")]
    Export(#[from] ExportError),
    /// A file cannot be read or written.
    #[error("cannot use {}: {source}", path.display())]
    File { path: PathBuf, source: std::io::Error },
    /// A tool cannot be started.
    #[error("cannot start {program} ({source}): {remedy}")]
    Missing {
        program: String,
        source: std::io::Error,
        /// Advice to the user.
        remedy: &'static str,
    },
    /// A tool has ended with an error.
    #[error("{program} ends with {status}, the end of {} being\n{tail}", log.display())]
    Failed {
        program: String,
        status: std::process::ExitStatus,
        /// The file with all output of the tool.
        log: PathBuf,
        /// The last lines of that output.
        tail: String,
    },
    /// The tools cannot be fetched.
    #[error("the tools cannot be installed, which needs python3 with venv and a network, the first time: {0}")]
    Install(Box<BoardError>),
    /// A tool has ended well but printed warnings that nobody has judged yet.
    #[error(
        "{program} warns, see {}: judge these warnings and change the source, or the list of those \
         accepted\n{warnings}",
        log.display()
    )]
    Warned {
        program: String,
        /// The file with all output of the tool.
        log: PathBuf,
        warnings: String,
    },
    /// The result cannot be printed.
    #[error("cannot write to standard output: {0}")]
    Print(std::io::Error),
    /// The folder for the output exists, and another program made it, so the command does not empty it.
    #[error("{} is not of this command, which would empty it: choose another folder for --out", .0.display())]
    Foreign(PathBuf),
    /// Another run of the command works in the same folder.
    #[error("another run works in {}: wait for it, or choose another folder for --out", .0.display())]
    Busy(PathBuf),
    /// A file of a tool or of the repository does not have the form that the command knows.
    #[error("{} cannot be understood: {reason}", path.display())]
    Form {
        path: PathBuf,
        /// The part that is wrong.
        reason: String,
    },
    /// The board's PLL cannot make this clock, or the clock is outside the range that the board is tried at.
    #[error("{board} has no clock of {clock_mhz} MHz: choose a multiple of 5 from {least_mhz} to {most_mhz}")]
    Clock {
        board: &'static str,
        /// The clock that the user asked for, in MHz.
        clock_mhz: u32,
        /// The smallest clock that the board is tried at, in MHz.
        least_mhz: u32,
        /// The largest clock that the board is tried at, in MHz.
        most_mhz: u32,
    },
    /// The board has no Ethernet port.
    #[error("{board} has no Ethernet port: leave out --link udp, or choose colorlight-i5 or ecpix-5")]
    NoPort { board: &'static str },
    /// Addresses are given to a board behind its serial line.
    #[error("a serial line has no addresses: add --link udp, or leave out --ip, --mac and --udp-port")]
    NoAddresses,
    /// The placed design misses the clock of the PHY, which cannot be lowered.
    #[error(
        "{board} does not meet the {PORT_MHZ} MHz of its Ethernet port: the median of {} reaches {:.1} MHz; {} says \
         more, and more --seeds may help",
        seeds_in_words(*seeds),
        (10.0 * median_mhz).floor() / 10.0,
        report.display()
    )]
    PortTiming {
        board: &'static str,
        /// Number of seeds placed.
        seeds: usize,
        /// The median of the clocks that the seeds reach at the port, in MHz.
        median_mhz: f64,
        /// The file of the report.
        report: PathBuf,
    },
    /// No report is kept of this core on this board.
    #[error(
        "no report of {board} with {config} is kept: leave out --renew, or add the core to `cores` of the board in \
         hdl/src/board/mod.rs"
    )]
    NoReport {
        board: &'static str,
        /// Name of the configuration.
        config: &'static str,
    },
    /// The board meets none of the clocks that were tried.
    #[error(
        "{board} does not meet {clock_mhz} MHz: the median of {} reaches {:.1} MHz; {} says more, and {}",
        seeds_in_words(*seeds),
        (10.0 * median_mhz).floor() / 10.0,
        report.display(),
        within_reach(*possible_mhz)
    )]
    Timing {
        board: &'static str,
        /// The clock that the board misses, in MHz.
        clock_mhz: u32,
        /// Number of seeds placed.
        seeds: usize,
        /// The median of the clocks that the seeds reach, in MHz.
        median_mhz: f64,
        /// The largest clock in MHz that the board meets, if there is one.
        possible_mhz: Option<u32>,
        /// The file of the report.
        report: PathBuf,
    },
}

/// A number of seeds in words, such as "1 seed".
pub(super) fn seeds_in_words(count: usize) -> String {
    format!("{count} {}", if count == 1 { "seed" } else { "seeds" })
}

/// The end of the message about a missed clock: which clock to try instead.
fn within_reach(possible_mhz: Option<u32>) -> String {
    possible_mhz.map_or("no clock of the board is within reach".into(), |mhz| format!("--clock {mhz} is within reach"))
}

impl BoardError {
    /// The error of a file that cannot be read or written.
    pub(super) fn file(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        |source| Self::File { path, source }
    }

    /// The error of a file that does not have the known form.
    pub(super) fn form(path: impl Into<PathBuf>, reason: impl ToString) -> Self {
        Self::Form { path: path.into(), reason: reason.to_string() }
    }
}
