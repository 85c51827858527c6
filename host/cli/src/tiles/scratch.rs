//! The folder of a run that keeps its tiles in files, and may go on after it was killed.

use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

use super::deal::remove_stale;
use super::manifest::manifest_path;
use crate::failure::Failure;
use crate::{interrupt, output, path};

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
        if !is_resumed && manifest_path(&folder).exists() {
            return Err(Failure::input(format!(
                "{} is there from a run that did not end: give --resume to go on with it, or remove it",
                path::name(&folder)
            )));
        }
        let lock = folder.join("lock");
        let failed = |error: io::Error| Failure::input(format!("{} cannot be made: {error}", path::name(&folder)));
        let mut unfinished = interrupt::unfinished();
        fs::create_dir_all(&folder).map_err(failed)?;
        let mut file =
            File::options().read(true).write(true).create(true).truncate(false).open(&lock).map_err(failed)?;
        file.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => Failure::input(format!(
                "another process works in {}: wait for it, or choose another --scratch",
                path::name(&folder)
            )),
            TryLockError::Error(error) => failed(error),
        })?;
        unfinished.extend([folder.clone(), lock.clone()]);
        drop(unfinished);
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

    /// Removes the folder with all tiles.
    pub fn remove(self) -> io::Result<()> {
        let folder = self.folder.clone();
        drop(self);
        match fs::remove_dir_all(folder) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            other => other,
        }
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let mut unfinished = interrupt::unfinished();
        let _ = fs::remove_file(&self.lock);
        if !self.can_go_on() {
            // The files of a split that failed are gone, so the folder is empty.
            let _ = fs::remove_dir(&self.folder);
        }
        unfinished.retain(|kept| *kept != self.lock && *kept != self.folder);
    }
}
