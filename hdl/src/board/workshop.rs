//! Provides the folder in which the tools work, locked, and emptied except for the kept files.

use super::error::BoardError;
use super::kept;
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};

/// File that marks the folder as made by this command. A user's own folder with the same name has no such file
/// and is not emptied.
const MARK: &str = ".incircle-board";

/// Empties and returns the folder `work`; only the [kept](super::kept) files stay. The returned file is a lock: no
/// other run can have the folder until the file is closed.
///
/// # Errors
/// If a folder of this name exists that the command did not make, another run works in it, or it cannot be made.
pub(super) fn take(out: &Path) -> Result<(PathBuf, File), BoardError> {
    let work = out.join("work");
    let mark = work.join(MARK);
    if work.exists() && !mark.exists() {
        return Err(BoardError::Foreign(work));
    }
    std::fs::create_dir_all(&work).map_err(BoardError::file(&work))?;
    let lock = File::create(&mark).map_err(BoardError::file(&mark))?;
    match lock.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => return Err(BoardError::Busy(work)),
        Err(TryLockError::Error(source)) => return Err(BoardError::file(mark)(source)),
    }
    for entry in std::fs::read_dir(&work).map_err(BoardError::file(&work))? {
        let entry = entry.map_err(BoardError::file(&work))?;
        let path = entry.path();
        if path == mark || path == work.join(kept::FOLDER) {
            continue;
        }
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        let removed = if is_folder { std::fs::remove_dir_all(&path) } else { std::fs::remove_file(&path) };
        removed.map_err(BoardError::file(path))?;
    }
    Ok((work, lock))
}
