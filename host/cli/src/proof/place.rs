//! Where the files of a proof go.

use std::path::Path;

/// Where files go, and whether no progress is shown.
#[derive(Clone, Copy)]
pub struct Place<'a> {
    /// The folder for files.
    pub folder: &'a Path,
    /// Whether no progress is shown.
    pub quiet: bool,
}
