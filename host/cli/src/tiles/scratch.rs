//! The folder of a run that keeps its tiles in files, and may go on after it was killed.

use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

use super::deal::remove_stale;
use super::manifest::manifest_path;
use crate::failure::Failure;
use crate::{interrupt, output, path};

/// The number of times that a folder is made again if another process removes it at the same time.
const TRIES: usize = 100;

/// A folder that this process alone works in. Dropping the value removes the folder if it has nothing to go on from.
pub struct Scratch {
    folder: PathBuf,
    lock: PathBuf,
    /// Keeps the lock while the value lives.
    _file: File,
}

impl Scratch {
    /// Makes the folder for the tiles of a mesh, within `parent`. One that an earlier run left is taken only if the run
    /// `is_resumed`; what that run left because it was killed is removed, but for its finished tiles.
    ///
    /// # Errors
    /// The folder cannot be made, is there already, or another process works in it.
    pub fn open(parent: &Path, mesh: &Path, is_resumed: bool) -> Result<Self, Failure> {
        let mut name = std::ffi::OsString::from(".");
        name.push(mesh.file_name().unwrap_or("mesh".as_ref()));
        name.push(".tiles");
        let folder = parent.join(name);
        let lock = folder.join("lock");
        if !is_resumed && manifest_path(&folder).exists() {
            if let Ok(file) = File::open(&lock) {
                lock_now(&file, &folder)?;
            }
            return Err(Failure::input(format!(
                "{} is there from a run that did not end: give --resume to go on with it, or remove it",
                path::name(&folder)
            )));
        }
        let failed = |error: io::Error| Failure::input(format!("{} cannot be made: {error}", path::name(&folder)));
        let mut file = make_and_lock(&folder, &lock)?;
        remove_stale(&folder, ".part");
        // A process that was killed has left its number here.
        let mut process = String::new();
        file.read_to_string(&mut process).map_err(failed)?;
        if let Ok(process) = process.trim().parse() {
            output::remove_part(mesh, process);
        }
        file.rewind().and_then(|()| file.set_len(0)).map_err(failed)?;
        writeln!(file, "{}", std::process::id()).map_err(failed)?;
        Ok(Self { folder, lock, _file: file })
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Whether there is anything that a later run can go on from.
    pub fn can_go_on(&self) -> bool {
        manifest_path(&self.folder).exists()
    }

    /// Removes the tiles, and the folder unless it has files of others. The lock goes last, so that no other process
    /// begins before.
    pub fn remove(self) -> io::Result<()> {
        // Without its manifest a folder has nothing to go on from, also if this process is killed now.
        gone(fs::remove_file(manifest_path(&self.folder)))?;
        let Ok(entries) = fs::read_dir(&self.folder) else { return Ok(()) };
        for entry in entries {
            let entry = entry?;
            if is_of_tiles(&entry.file_name().to_string_lossy()) {
                gone(fs::remove_file(entry.path()))?;
            }
        }
        Ok(())
    }
}

/// Whether a file of this name is one that a run in tiles writes.
fn is_of_tiles(name: &str) -> bool {
    let number = name.strip_suffix(".points").or_else(|| name.strip_suffix(".local"));
    let is_tile = number.is_some_and(|number| !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()));
    is_tile || name.starts_with('.') && name.ends_with(".part")
}

/// The result of a removal, where a file that is gone already is no failure.
fn gone(removed: io::Result<()>) -> io::Result<()> {
    match removed {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        other => other,
    }
}

/// Makes a folder with a locked file in it. An interrupt removes both.
fn make_and_lock(folder: &Path, lock: &Path) -> Result<File, Failure> {
    let failed = |error: io::Error| Failure::input(format!("{} cannot be made: {error}", path::name(folder)));
    let mut tries = 0;
    loop {
        tries += 1;
        let is_last = tries == TRIES;
        let mut unfinished = interrupt::unfinished();
        fs::create_dir_all(folder).map_err(failed)?;
        let opened = File::options().read(true).write(true).create(true).truncate(false).open(lock);
        let file = match opened {
            // A process that ended has just removed the folder.
            Err(error) if error.kind() == io::ErrorKind::NotFound && !is_last => continue,
            other => other.map_err(failed)?,
        };
        lock_now(&file, folder)?;
        // The lock of a process that ended meanwhile is gone with its folder, and others make a new one.
        if is_last || is_file(&file, lock) {
            unfinished.push(folder.to_owned());
            unfinished.push(lock.to_owned());
            return Ok(file);
        }
    }
}

/// Locks the file of a folder, or says that another process has it.
fn lock_now(file: &File, folder: &Path) -> Result<(), Failure> {
    let name = path::name(folder);
    file.try_lock().map_err(|error| match error {
        TryLockError::WouldBlock => {
            Failure::input(format!("another process works in {name}: wait for it, or choose another --scratch"))
        }
        TryLockError::Error(error) => Failure::input(format!("{name} cannot be locked: {error}")),
    })
}

/// Whether an open file is the one with this path.
#[cfg(unix)]
fn is_file(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |found: fs::Metadata| (found.dev(), found.ino());
    let own = file.metadata().ok().map(identity);
    own.is_some() && own == fs::metadata(path).ok().map(identity)
}

/// Other systems do not remove an open file.
#[cfg(not(unix))]
fn is_file(_: &File, path: &Path) -> bool {
    path.exists()
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let mut unfinished = interrupt::unfinished();
        let _ = fs::remove_file(&self.lock);
        if !self.can_go_on() {
            // The files of a split that failed are gone, so the folder is empty.
            let _ = fs::remove_dir(&self.folder);
        }
        unfinished.remove(&self.lock);
        unfinished.remove(&self.folder);
    }
}
