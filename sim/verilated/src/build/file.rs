//! The files and locks of the build.

use std::fs::{self, File};
use std::path::Path;

use super::error::BuildError;

/// Writes a text file.
pub(super) fn write(path: &Path, text: &str) -> Result<(), BuildError> {
    fs::write(path, text).map_err(|source| BuildError::File { path: path.to_path_buf(), source })
}

/// Creates the folder and locks it for this process until the returned file is dropped. While another process has the
/// lock, the call waits.
pub(super) fn lock(folder: &Path) -> Result<File, BuildError> {
    let path = folder.join("lock");
    let failed = |source| BuildError::File { path: path.clone(), source };
    fs::create_dir_all(folder).map_err(failed)?;
    let file = File::create(&path).map_err(failed)?;
    file.lock().map_err(failed)?;
    Ok(file)
}
