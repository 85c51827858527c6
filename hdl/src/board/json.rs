//! Reads and writes files of JSON.

use super::error::BoardError;
use crate::files::replace;
use serde::{de::DeserializeOwned, Serialize};
use std::path::Path;

/// Reads a value from a file.
///
/// # Errors
/// If the file cannot be read or understood.
pub(super) fn read<T: DeserializeOwned>(path: &Path) -> Result<T, BoardError> {
    let text = std::fs::read_to_string(path).map_err(BoardError::file(path))?;
    serde_json::from_str(&text).map_err(|error| BoardError::form(path, error))
}

/// Replaces a file by a value.
///
/// # Errors
/// If the file cannot be written.
pub(super) fn write(path: &Path, value: &impl Serialize) -> Result<(), BoardError> {
    let text = serde_json::to_string_pretty(value).map_err(|error| BoardError::form(path, error))?;
    replace(path, (text + "\n").as_bytes()).map_err(BoardError::file(path))
}
