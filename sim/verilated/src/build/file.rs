//! Files that the build writes.

use std::fs::{self, File};
use std::path::Path;

use super::error::BuildError;

/// Writes a text file.
pub(super) fn write(path: &Path, text: &str) -> Result<(), BuildError> {
    fs::write(path, text).map_err(|source| BuildError::File { path: path.to_path_buf(), source })
}

/// Makes the folder and locks it for this process until the file is dropped; waits for whoever has it.
pub(super) fn lock(folder: &Path) -> Result<File, BuildError> {
    let path = folder.join("lock");
    let failed = |source| BuildError::File { path: path.clone(), source };
    fs::create_dir_all(folder).map_err(failed)?;
    let file = File::create(&path).map_err(failed)?;
    file.lock().map_err(failed)?;
    Ok(file)
}
