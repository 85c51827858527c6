//! The folder of a run that keeps its tiles in files, and may go on after it was killed.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use super::manifest::manifest_path;
use crate::failure::Failure;
use crate::{interrupt, path};

/// A folder that this process alone works in. Dropping the value removes the folder if it has nothing to go on from.
pub struct Scratch {
    folder: PathBuf,
    lock: PathBuf,
    /// Keeps the lock while the value lives.
    _file: File,
}

impl Scratch {
    /// The folder for the mesh of this file name within `parent`.
    pub fn place(parent: &Path, mesh: &Path) -> PathBuf {
        let mut name = std::ffi::OsString::from(".");
        name.push(mesh.file_name().unwrap_or("mesh".as_ref()));
        name.push(".tiles");
        parent.join(name)
    }

    /// Makes the folder. One that an earlier run left is taken only if the run `is_resumed`.
    ///
    /// # Errors
    /// The folder cannot be made, is there already, or another process works in it.
    pub fn open(folder: PathBuf, is_resumed: bool) -> Result<Self, Failure> {
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
        let file = File::options().write(true).create(true).truncate(false).open(&lock).map_err(failed)?;
        file.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => Failure::input(format!(
                "another process works in {}: wait for it, or choose another --scratch",
                path::name(&folder)
            )),
            TryLockError::Error(error) => failed(error),
        })?;
        unfinished.extend([folder.clone(), lock.clone()]);
        drop(unfinished);
        remove_parts(&folder);
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

/// Removes the working files of a run that was killed.
fn remove_parts(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.filter_map(Result::ok) {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with('.') && name.ends_with(".part") {
            let _ = fs::remove_file(entry.path());
        }
    }
}
