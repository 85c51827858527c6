//! The folder of the files of a proof.

use std::path::Path;

/// The folder of the files of a proof, and whether no progress is shown.
#[derive(Clone, Copy)]
pub struct Place<'a> {
    /// The folder for files.
    pub folder: &'a Path,
    /// Whether no progress is shown.
    pub quiet: bool,
}
