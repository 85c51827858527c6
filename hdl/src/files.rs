//! Writes files so that they are complete or unchanged.

use std::io::{self, Write};
use std::path::Path;

/// Replaces the contents of a file in one step. A device or a pipe is written to directly. A symbolic link stays, and
/// its target is replaced.
///
/// # Errors
/// If the file cannot be written; then no part of the new contents stays.
pub(crate) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let path = &path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    if path.metadata().is_ok_and(|data| !data.is_file()) {
        return std::fs::OpenOptions::new().write(true).open(path)?.write_all(bytes);
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let beside = path.with_file_name(format!(".{name}.{}.part", std::process::id()));
    let written = std::fs::write(&beside, bytes).and_then(|()| std::fs::rename(&beside, path));
    // An error of this removal would only hide the error that the user must see.
    written.inspect_err(|_| _ = std::fs::remove_file(&beside))
}
