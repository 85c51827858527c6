//! Output files that are either whole or not there.
//!
//! A file is written under another name in the same folder and renamed when all is done. What is no ordinary file (a
//! device, a pipe) is written as it is.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::interrupt;
use crate::source::is_standard;

/// Where output goes.
#[derive(Debug)]
enum Target {
    Standard,
    /// A device, a pipe: something that a rename would replace.
    Special(PathBuf),
    Ordinary(PathBuf),
}

/// An output that has been checked but not yet written.
#[derive(Debug)]
pub struct Output {
    target: Target,
    name: String,
}

/// An output that is written but not yet in place. Dropped without [`Written::finish`], it is removed.
#[must_use]
#[derive(Debug)]
pub struct Written {
    /// The file under its working name and its place; `None` if there is nothing left to do.
    renaming: Option<(PathBuf, PathBuf)>,
    name: String,
}

impl Output {
    /// Checks what can be checked before the work: the output must not be the input, its folder must exist, and a file
    /// that is there must be writable.
    pub fn prepare(path: &Path, input: Option<&Path>) -> Result<Self, Failure> {
        if is_standard(path) {
            return Ok(Self {
                target: Target::Standard,
                name: "standard output".to_owned(),
            });
        }
        let name = path.display().to_string();
        if input.is_some_and(|input| is_same(input, path)) {
            return Err(Failure::usage(format!(
                "{name} is both the input and the output: choose another output"
            )));
        }
        let target = match fs::metadata(path) {
            Ok(found) if found.is_dir() => {
                return Err(Failure::input(format!(
                    "{name} cannot be written: it is a folder"
                )));
            }
            Ok(found) if found.is_file() => {
                let writable = OpenOptions::new().write(true).open(path);
                writable.map_err(|error| cannot_write(&name, &error))?;
                // A link is followed, so that what it points to is replaced and not the link.
                Target::Ordinary(
                    path.canonicalize()
                        .map_err(|error| cannot_write(&name, &error))?,
                )
            }
            Ok(_) => Target::Special(path.to_owned()),
            Err(error) if error.kind() == ErrorKind::NotFound => {
                fs::metadata(folder_of(path)).map_err(|error| cannot_write(&name, &error))?;
                Target::Ordinary(path.to_owned())
            }
            Err(error) => return Err(cannot_write(&name, &error)),
        };
        Ok(Self { target, name })
    }

    /// Whether this is standard output.
    pub fn is_standard(&self) -> bool {
        matches!(self.target, Target::Standard)
    }

    /// Writes everything that `content` writes. A reader that closed the pipe is no failure.
    pub fn write(
        self,
        content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<Written, Failure> {
        let Self { target, name } = self;
        let done = |renaming| Written {
            renaming,
            name: name.clone(),
        };
        let result = match target {
            Target::Standard => {
                ignore_closed(fill(io::stdout().lock(), content)).map(|()| done(None))
            }
            Target::Special(path) => {
                let opened = OpenOptions::new().write(true).open(path);
                opened
                    .and_then(|file| ignore_closed(fill(file, content)))
                    .map(|()| done(None))
            }
            Target::Ordinary(path) => {
                let part = part_beside(&path);
                begin(&part).and_then(|file| {
                    // From here on dropping it removes the part, whatever fails.
                    let written = done(Some((part, path)));
                    fill(file, content).map(|()| written)
                })
            }
        };
        result.map_err(|error| cannot_write(&name, &error))
    }
}

impl Written {
    /// Puts the file in its place, unless the run was interrupted.
    pub fn finish(mut self) -> Result<(), Failure> {
        let mut unfinished = interrupt::unfinished();
        let result = match &self.renaming {
            Some((part, path)) => interrupt::check().and_then(|()| {
                keep_permissions(part, path);
                fs::rename(part, path).map_err(|error| cannot_write(&self.name, &error))
            }),
            None => Ok(()),
        };
        if result.is_ok() {
            *unfinished = None;
            self.renaming = None;
        }
        drop(unfinished);
        result
    }
}

impl Drop for Written {
    fn drop(&mut self) {
        if let Some((part, _)) = self.renaming.take() {
            let mut unfinished = interrupt::unfinished();
            let _ = fs::remove_file(part);
            *unfinished = None;
        }
    }
}

/// Prints text on standard output. A reader that closed the pipe is no failure.
pub fn print(text: &str) -> Result<(), Failure> {
    let result = fill(io::stdout().lock(), |out| out.write_all(text.as_bytes()));
    ignore_closed(result).map_err(|error| cannot_write("standard output", &error))
}

/// Prints a line on standard error, if anybody reads it.
pub fn note(line: &str) {
    let _ = writeln!(io::stderr(), "{line}");
}

fn begin(part: &Path) -> io::Result<File> {
    let mut unfinished = interrupt::unfinished();
    let file = OpenOptions::new().write(true).create_new(true).open(part)?;
    *unfinished = Some(part.to_owned());
    Ok(file)
}

fn fill(
    file: impl Write,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut buffered = BufWriter::with_capacity(1 << 16, file);
    content(&mut buffered)?;
    buffered.flush()
}

fn ignore_closed(result: io::Result<()>) -> io::Result<()> {
    match result {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        other => other,
    }
}

fn cannot_write(name: &str, error: &io::Error) -> Failure {
    Failure::input(format!("{name} cannot be written: {error}"))
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// The working name: hidden, beside the file, so that the rename stays on one disk; the process id keeps runs apart.
fn part_beside(path: &Path) -> PathBuf {
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.part", std::process::id()));
    folder_of(path).join(name)
}

/// A file that is replaced hands its permissions on, as far as the system allows.
fn keep_permissions(part: &Path, path: &Path) {
    if let Ok(found) = fs::metadata(path) {
        let _ = fs::set_permissions(part, found.permissions());
    }
}

/// Whether two paths lead to one file, by whatever links.
fn is_same(one: &Path, other: &Path) -> bool {
    if is_standard(one) {
        return false;
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let id = |path: &Path| {
            fs::metadata(path)
                .ok()
                .filter(fs::Metadata::is_file)
                .map(|found| (found.dev(), found.ino()))
        };
        id(one).is_some() && id(one) == id(other)
    }
    #[cfg(not(unix))]
    {
        let place = |path: &Path| path.canonicalize().ok();
        place(one).is_some() && place(one) == place(other)
    }
}
