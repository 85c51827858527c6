//! Files that are there whole or not at all.

use std::io::{self, Write};
use std::path::Path;

/// Writes a file in one step, in place of the one that is there. What is no plain file, a device or a pipe, is written to as it is; a link stays,
/// and leads to what is written.
///
/// # Errors
/// It cannot be written; then nothing of it stays.
pub(crate) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let path = &path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    if path.metadata().is_ok_and(|data| !data.is_file()) {
        return std::fs::OpenOptions::new().write(true).open(path)?.write_all(bytes);
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let beside = path.with_file_name(format!(".{name}.{}.part", std::process::id()));
    let written = std::fs::write(&beside, bytes).and_then(|()| std::fs::rename(&beside, path));
    // That it cannot be removed either changes nothing for the user.
    written.inspect_err(|_| _ = std::fs::remove_file(&beside))
}
