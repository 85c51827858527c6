//! Why there is no bitstream.

use crate::export::ExportError;
use std::path::PathBuf;

/// Why there is no bitstream, or no table.
#[derive(Debug, thiserror::Error)]
pub enum BoardError {
    /// The device is not fit for export.
    #[error("{0}")]
    Export(#[from] ExportError),
    /// A file cannot be read or written.
    #[error("cannot use {}: {source}", path.display())]
    File {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A tool cannot be started.
    #[error("cannot start {program} ({source}): {remedy}")]
    Missing {
        /// The program.
        program: String,
        /// What the system says.
        source: std::io::Error,
        /// What to do.
        remedy: &'static str,
    },
    /// A tool ended with an error.
    #[error("{program} ends with {status}, the end of {} being\n{tail}", log.display())]
    Failed {
        /// The program.
        program: String,
        /// Its exit status.
        status: std::process::ExitStatus,
        /// All it printed.
        log: PathBuf,
        /// The end of that.
        tail: String,
    },
    /// The tools cannot be fetched.
    #[error("the tools cannot be installed, which needs python3 with venv and a network, the first time: {0}")]
    Install(Box<BoardError>),
    /// A tool ended well and warned of what nobody has judged.
    #[error("{program} warns, see {}: judge these warnings and change the source, or the list of those accepted\n{warnings}", log.display())]
    Warned {
        /// The program.
        program: String,
        /// All it printed.
        log: PathBuf,
        /// The warnings.
        warnings: String,
    },
    /// The result cannot be printed.
    #[error("cannot write to standard output: {0}")]
    Print(std::io::Error),
    /// A folder that the command would empty, and did not make.
    #[error("{} is not of this command, which would empty it: choose another folder for --out", .0.display())]
    Foreign(PathBuf),
    /// Two runs at once.
    #[error("another run works in {}: wait for it, or choose another folder for --out", .0.display())]
    Busy(PathBuf),
    /// A file of a tool, or of the repository, is not in the form known.
    #[error("{} cannot be understood: {reason}", path.display())]
    Form {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A clock that the board's PLL cannot make, or that is not tried.
    #[error("{board} has no clock of {clock_mhz} MHz: choose a multiple of 5 from {least_mhz} to {most_mhz}")]
    Clock {
        /// The board.
        board: &'static str,
        /// What was asked for.
        clock_mhz: u32,
        /// The smallest clock possible.
        least_mhz: u32,
        /// The largest.
        most_mhz: u32,
    },
    /// No clock asked for is met.
    #[error(
        "{board} does not meet {clock_mhz} MHz: the median of {} reaches {:.1} MHz; {} says more, and {}",
        seeds_in_words(*seeds),
        (10.0 * median_mhz).floor() / 10.0,
        report.display(),
        within_reach(*possible_mhz)
    )]
    Timing {
        /// The board.
        board: &'static str,
        /// The clock that is missed.
        clock_mhz: u32,
        /// Seeds placed.
        seeds: usize,
        /// What their median reaches.
        median_mhz: f64,
        /// The largest clock of the board that is met.
        possible_mhz: Option<u32>,
        /// The report.
        report: PathBuf,
    },
}

/// How many seeds.
pub(super) fn seeds_in_words(count: usize) -> String {
    format!("{count} {}", if count == 1 { "seed" } else { "seeds" })
}

/// What a missed clock leaves to try.
fn within_reach(possible_mhz: Option<u32>) -> String {
    possible_mhz.map_or("no clock of the board is within reach".into(), |mhz| format!("--clock {mhz} is within reach"))
}

impl BoardError {
    /// A file that cannot be read or written.
    pub(super) fn file(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        |source| Self::File { path, source }
    }

    /// A file that is not in the form known.
    pub(super) fn form(path: impl Into<PathBuf>, reason: impl ToString) -> Self {
        Self::Form { path: path.into(), reason: reason.to_string() }
    }
}
