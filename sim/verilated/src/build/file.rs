//! Files that the build writes.

use std::path::Path;

use super::error::BuildError;

/// Writes a text file.
pub(super) fn write(path: &Path, text: &str) -> Result<(), BuildError> {
    std::fs::write(path, text).map_err(|source| BuildError::File { path: path.to_path_buf(), source })
}
