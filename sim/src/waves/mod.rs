//! Layouts of waveforms: which signals a viewer shows, in which order, and the names of their states.
//!
//! [`write_layout`] reads the head of a VCD file of a core and writes a save file of the viewer GTKWave beside it. The
//! layout shows the ports of the core, and every signal that has named states. The names come from the Verilog of the
//! cores: the build script collects them.

mod header;
mod layout;
mod named_state;
// A part of the build script, which has no tests of its own.
#[cfg(test)]
#[path = "../../build/states.rs"]
mod states;

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

pub use header::Signal;

/// The most bytes at the end of a waveform that hold its last time: every clock writes fewer.
const TAIL: u64 = 1 << 20;

/// The reason why a layout could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// A file cannot be read or written.
    #[error("cannot read or write {path}: {source}", path = path.display())]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: std::io::Error,
    },
    /// The file has no complete head of a VCD waveform.
    #[error("{path} is no VCD waveform: its head does not end in $enddefinitions", path = path.display())]
    NoWaveform {
        /// Path of the file.
        path: PathBuf,
    },
    /// The waveform is that of another design.
    #[error("{path} is not the waveform of a core: it has no signal {COMMAND}", path = path.display())]
    NoCore {
        /// Path of the file.
        path: PathBuf,
    },
}

/// A signal that every core has.
const COMMAND: &str = "TOP.command_valid";

/// Writes the layout of a waveform of a core: `NAME.gtkw` beside `NAME.vcd`, and a file `NAME.ENUMERATION.txt` with the
/// names of the states of each enumeration. Files of these names are replaced. Returns what was written, the layout
/// first. Open it with `gtkwave NAME.gtkw`.
///
/// # Errors
/// [`LayoutError`]: the file is no waveform of a core, or a file cannot be read or written.
pub fn write_layout(waveform: impl AsRef<Path>) -> Result<Vec<PathBuf>, LayoutError> {
    let waveform = waveform.as_ref();
    let at = |path: &Path| {
        let path = path.to_owned();
        move |source| LayoutError::File { path, source }
    };
    let mut file = File::open(waveform).map_err(at(waveform))?;
    let signals = header::signals(BufReader::new(&file)).map_err(at(waveform))?;
    let signals = signals.ok_or_else(|| LayoutError::NoWaveform { path: waveform.to_owned() })?;
    if !signals.iter().any(|signal| signal.full_name() == COMMAND) {
        return Err(LayoutError::NoCore { path: waveform.to_owned() });
    }
    let times = times(&mut file).map_err(at(waveform))?;
    let mut written = Vec::new();
    for (path, text) in layout::files(waveform, &signals, &named_state::named_states(), times) {
        std::fs::write(&path, text).map_err(at(&path))?;
        written.push(path);
    }
    Ok(written)
}

/// The first and the last time of the waveform, in nanoseconds.
fn times(file: &mut File) -> Result<(u64, u64), std::io::Error> {
    let time = |line: &str| line.strip_prefix('#').and_then(|time| time.trim().parse().ok());
    let length = file.metadata()?.len();
    file.seek(SeekFrom::Start(length.saturating_sub(TAIL)))?;
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes)?;
    let last = String::from_utf8_lossy(&bytes).lines().rev().find_map(time);
    file.seek(SeekFrom::Start(0))?;
    let mut first = None;
    for line in BufReader::new(file).lines() {
        first = time(&line?);
        if first.is_some() {
            break;
        }
    }
    Ok((first.unwrap_or(0), last.or(first).unwrap_or(0)))
}

#[cfg(test)]
mod tests {
    use super::states;

    #[test]
    fn states_are_found_in_verilog() {
        let text = "x\nmodule root$a$b(clock);\n    localparam Step$Idle = 0;\n    localparam Step$Work = 1;\n    \
                    localparam other = 3'h2;\n    case (state$q)\n        Step$Idle:\n        state$d = Step$Work;\n\
                    is_idle = phase == Step$Idle;\nendmodule\nmodule root();\n    localparam Way$Up = 0;\nendmodule\n";
        let found: Vec<String> = states::named_states(text).into_iter().collect();
        assert_eq!(found, ["a$b phase Step Idle=0 Work=1", "a$b state$q Step Idle=0 Work=1"]);
    }
}
