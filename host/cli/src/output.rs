//! Output files that are either complete or absent.
//!
//! A file is written under another name in the same folder and renamed at the end of the run. Devices and pipes are
//! written directly. A link to a file is followed; a link that leads nowhere is refused.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use flate2::write::GzEncoder;

use crate::failure::Failure;
use crate::interrupt;
use crate::path::{self, check_standard, is_standard, Compression};

/// The most working names that are tried for an output.
const TRIES: u32 = 100;

/// The destination of an output.
#[derive(Debug)]
enum Target {
    Standard,
    /// A device or a pipe, which a rename would replace.
    Special(PathBuf),
    Ordinary(PathBuf),
}

impl Target {
    /// The destination that a path names. The name is for messages.
    fn of(path: &Path, name: &str) -> Result<Self, Failure> {
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => Err(Failure::input(format!("{name} cannot be written: it is a folder"))),
            Ok(found) if found.is_file() => {
                let writable = OpenOptions::new().write(true).open(path);
                writable.map_err(|error| cannot_write(name, &error))?;
                // The path behind links is used, so that the rename replaces the file and not the link.
                path.canonicalize().map(Self::Ordinary).map_err(|error| cannot_write(name, &error))
            }
            Ok(_) => Ok(Self::Special(path.to_owned())),
            Err(error) if error.kind() == ErrorKind::NotFound => {
                // Another process may have made an ordinary file meanwhile.
                if fs::symlink_metadata(path).is_ok_and(|found| found.is_symlink()) {
                    return Err(Failure::input(format!(
                        "{name} cannot be written: it is a link to a file that does not exist"
                    )));
                }
                if !names_a_file(path) {
                    return Err(Failure::input(format!(
                        "{name} cannot be written: the name is one of a folder, which does not exist"
                    )));
                }
                fs::metadata(folder_of(path)).map_err(|error| cannot_write(name, &error))?;
                Ok(Self::Ordinary(path.to_owned()))
            }
            Err(error) => Err(cannot_write(name, &error)),
        }
    }
}

/// An output that has been checked but not yet written.
#[derive(Debug)]
pub struct Output {
    target: Target,
    /// The packing of the bytes.
    compression: Compression,
    name: String,
}

/// An output that is written but not yet in place. Dropping the value without [`finish`] removes the file.
#[must_use]
#[derive(Debug)]
pub struct Written {
    /// The working name and the final name of the file; `None` if no renaming is needed.
    renaming: Option<(PathBuf, PathBuf)>,
    name: String,
}

impl Output {
    /// Checks an output before the work: the output must be none of the inputs, of which only one may be standard
    /// input; its folder must exist and take new files, and an existing file must be writable.
    pub fn prepare(path: &Path, inputs: &[PathBuf]) -> Result<Self, Failure> {
        check_standard(inputs)?;
        if is_standard(path) {
            return Ok(Self {
                target: Target::Standard,
                compression: Compression::None,
                name: "standard output".to_owned(),
            });
        }
        let name = path::name(path);
        if inputs.iter().any(|input| is_same(input, path)) {
            return Err(Failure::usage(format!("{name} is both the input and the output: choose another output")));
        }
        let target = Target::of(path, &name)?;
        if let Target::Ordinary(path) = &target {
            check_folder(path).map_err(|error| cannot_write(&name, &error))?;
        }
        Ok(Self { target, compression: Compression::of(path), name })
    }

    /// Whether the output is standard output.
    pub fn is_standard(&self) -> bool {
        matches!(self.target, Target::Standard)
    }

    /// Makes an empty file for a writer that needs a file name, which is [`Written::part`]. Devices, pipes and
    /// standard output are refused.
    pub fn reserve(self) -> Result<Written, Failure> {
        match self.target {
            Target::Ordinary(_) => self.write(|_| Ok(())),
            Target::Standard | Target::Special(_) => {
                Err(Failure::usage(format!("{} is not an ordinary file: choose another output", self.name)))
            }
        }
    }

    /// Whether two outputs are the same ordinary file, which may or may not exist yet.
    pub fn is_same(&self, other: &Self) -> bool {
        let place = |output: &Self| match &output.target {
            Target::Ordinary(path) => {
                folder_of(path).canonicalize().ok().map(|folder| folder.join(path.file_name().unwrap_or_default()))
            }
            Target::Standard | Target::Special(_) => None,
        };
        place(self).is_some_and(|path| place(other) == Some(path))
    }

    /// Writes the output by calling `content`. A pipe whose reader has closed it is not a failure.
    pub fn write(self, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<Written, Failure> {
        let Self { target, compression, name } = self;
        let done = |renaming| Written { renaming, name: name.clone() };
        let result = match target {
            Target::Standard => ignore_closed(fill(io::stdout().lock(), compression, content)).map(|()| done(None)),
            Target::Special(path) => {
                let opened = OpenOptions::new().write(true).open(path);
                opened.and_then(|file| ignore_closed(fill(file, compression, content))).map(|()| done(None))
            }
            Target::Ordinary(path) => {
                begin(&path).and_then(|(file, part)| {
                    // `written` exists before the content is written, so any later failure removes the part.
                    let written = done(Some((part, path)));
                    fill(file, compression, content).map(|()| written)
                })
            }
        };
        result.map_err(|error| cannot_write(&name, &error))
    }
}

impl Written {
    /// The working name of the file; `None` if no renaming is needed.
    pub fn part(&self) -> Option<&Path> {
        self.renaming.as_ref().map(|(part, _)| part.as_path())
    }

    /// Renames the file to its final name, unless the run was interrupted, and returns that name.
    fn place(mut self) -> Result<Option<PathBuf>, Failure> {
        let Some((part, path)) = &self.renaming else {
            return Ok(None);
        };
        let mut unfinished = interrupt::unfinished();
        interrupt::check()?;
        keep_permissions(part, path);
        let older = older_of_process(path, std::process::id());
        // A killed process with the same id, as in a container, may have left a file of this name.
        let _ = fs::remove_file(&older);
        // Without second names for files, as on some file systems, an older file is not kept.
        let has_older = fs::hard_link(path, &older).is_ok();
        if let Err(error) = fs::rename(part, path) {
            let _ = has_older.then(|| fs::remove_file(older));
            return Err(cannot_write(&self.name, &error));
        }
        if has_older {
            interrupt::replaced().push([older, path.clone()]);
        }
        // Until the run is done an interrupt removes the file under its final name.
        unfinished.rename(part, path.clone());
        drop(unfinished);
        Ok(self.renaming.take().map(|(_, path)| path))
    }
}

impl Drop for Written {
    fn drop(&mut self) {
        if let Some((part, _)) = self.renaming.take() {
            let mut unfinished = interrupt::unfinished();
            let _ = fs::remove_file(&part);
            unfinished.remove(&part);
        }
    }
}

/// Puts all outputs in place, calls `last`, and marks the run as complete. If anything fails, none of the outputs is
/// left, and the files that they replaced are there again.
pub fn finish(
    outputs: impl IntoIterator<Item = Written>,
    last: impl FnOnce() -> Result<(), Failure>,
) -> Result<(), Failure> {
    keep(outputs, || {
        last()?;
        interrupt::done()
    })
}

/// Puts all outputs of a step in place and then calls `last`. If anything fails, none of the outputs is left, and the
/// files that they replaced are there again. An interrupt of a later step leaves the outputs where they are.
pub fn keep(
    outputs: impl IntoIterator<Item = Written>,
    last: impl FnOnce() -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut placed = Vec::new();
    let place_all = || {
        for written in outputs {
            placed.extend(written.place()?);
        }
        last()
    };
    let result = place_all();
    let mut unfinished = interrupt::unfinished();
    for path in placed {
        settle(&path, result.is_ok());
        unfinished.remove(&path);
    }
    result
}

/// Drops the older file behind an output, or puts it back; if there was none, the output is removed.
fn settle(path: &Path, is_good: bool) {
    let mut replaced = interrupt::replaced();
    let older = replaced.iter().position(|[_, name]| name == path).map(|place| replaced.swap_remove(place));
    let _ = match (older, is_good) {
        (Some([older, _]), true) => fs::remove_file(older),
        (Some([older, path]), false) => fs::rename(older, path),
        (None, false) => fs::remove_file(path),
        (None, true) => Ok(()),
    };
}

/// Prints text on standard output. A pipe whose reader has closed it is not a failure.
pub fn print(text: &str) -> Result<(), Failure> {
    let result = fill(io::stdout().lock(), Compression::None, |out| out.write_all(text.as_bytes()));
    ignore_closed(result).map_err(|error| cannot_write("standard output", &error))
}

/// Prints a line on standard error, and ignores a closed one.
pub fn note(line: &str) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// Makes the working file of an output, and removes it again. No interrupt comes between.
fn check_folder(path: &Path) -> io::Result<()> {
    let _unfinished = interrupt::unfinished();
    let (_, part) = create_part(path)?;
    fs::remove_file(part)
}

/// Makes the working file of an output, which an interrupt removes.
fn begin(path: &Path) -> io::Result<(File, PathBuf)> {
    let mut unfinished = interrupt::unfinished();
    let (file, part) = create_part(path)?;
    unfinished.push(part.clone());
    Ok((file, part))
}

/// Makes a file beside an output: hidden, and in the same folder, so that the rename stays on one disk. The process id
/// keeps runs apart. In a container a killed process may have had the same id, and left its file: then the name gets a
/// number.
fn create_part(path: &Path) -> io::Result<(File, PathBuf)> {
    let process = std::process::id();
    let others = (1..TRIES).map(|number| part_named(path, &format!("{process}.{number}")));
    let mut last = io::Error::from(ErrorKind::AlreadyExists);
    for part in std::iter::once(part_of_process(path, process)).chain(others) {
        match OpenOptions::new().write(true).create_new(true).open(&part) {
            Ok(file) => return Ok((file, part)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => last = error,
            Err(error) => return Err(error),
        }
    }
    Err(last)
}

/// Writes the content into a file, packed by `compression`.
fn fill(
    file: impl Write,
    compression: Compression,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut buffered = BufWriter::with_capacity(1 << 16, file);
    match compression {
        Compression::None => content(&mut buffered)?,
        Compression::Gzip => {
            let mut packed = BufWriter::with_capacity(1 << 16, GzEncoder::new(&mut buffered, Default::default()));
            content(&mut packed)?;
            packed.into_inner()?.finish()?;
        }
        Compression::Zstd => {
            // Level 0 stands for the library's usual level.
            let mut packed = BufWriter::with_capacity(1 << 16, zstd::Encoder::new(&mut buffered, 0)?);
            content(&mut packed)?;
            packed.into_inner()?.finish()?;
        }
    }
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

/// Whether a path ends in the name of a file, and not in `/`, `.` or `..`.
fn names_a_file(path: &Path) -> bool {
    let whole = path.as_os_str().as_encoded_bytes();
    path.file_name().is_some_and(|name| whole.ends_with(name.as_encoded_bytes()))
}

/// The folder of a file.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// The working name that a process chooses first for an output.
fn part_of_process(path: &Path, process: u32) -> PathBuf {
    part_named(path, &process.to_string())
}

fn part_named(path: &Path, run: &str) -> PathBuf {
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{run}.part"));
    folder_of(path).join(name)
}

/// The name under which a process keeps the file that its output replaces.
fn older_of_process(path: &Path, process: u32) -> PathBuf {
    part_named(path, &format!("{process}.older"))
}

/// Removes what a process left beside an output because it was killed: the unfinished output, and the second name of
/// the file that the output replaced.
pub fn remove_part(path: &Path, process: u32) {
    // The name stands beside the file itself, behind links.
    let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let _ = fs::remove_file(part_of_process(&path, process));
    let _ = fs::remove_file(older_of_process(&path, process));
}

/// Gives the new file the permissions of the file that it replaces, as far as the system allows.
fn keep_permissions(part: &Path, path: &Path) {
    if let Ok(found) = fs::metadata(path) {
        let _ = fs::set_permissions(part, found.permissions());
    }
}

/// Whether input and output are the same file, also through links.
fn is_same(input: &Path, output: &Path) -> bool {
    #[cfg(unix)]
    {
        let id = identity(input);
        id.is_some() && id == identity(output)
    }
    #[cfg(not(unix))]
    {
        let (one, other) = (input, output);
        let place = |path: &Path| path.canonicalize().ok();
        place(one).is_some() && place(one) == place(other)
    }
}

/// Device number and inode of an ordinary file. The path `-` stands for the file behind standard input.
#[cfg(unix)]
fn identity(path: &Path) -> Option<(u64, u64)> {
    use std::os::fd::AsFd;
    use std::os::unix::fs::MetadataExt;
    let found = if is_standard(path) {
        let descriptor = io::stdin().as_fd().try_clone_to_owned().ok()?;
        File::from(descriptor).metadata().ok()?
    } else {
        fs::metadata(path).ok()?
    };
    found.is_file().then(|| (found.dev(), found.ino()))
}
