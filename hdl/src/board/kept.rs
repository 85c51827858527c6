//! Keeps the files of finished steps, so that a new run after a stopped one need not repeat them.
//!
//! Synthesis and each seed of a large board take many minutes. The files that such a step made are kept under a digest
//! of all that the step depends on: version and arguments of the tool, and the contents of the files it reads. A later
//! run with the same digest takes the files and leaves out the step.

use super::error::BoardError;
use sha2::{Digest, Sha256};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Name of the folder of the kept files, in the folder in which the tools work.
pub(super) const FOLDER: &str = "kept";

/// The digest of all that a step depends on.
#[derive(Clone, Default)]
pub(super) struct Key(Sha256);

impl Key {
    /// Adds a text, such as an argument.
    pub fn text(mut self, text: &str) -> Self {
        self.0.update((text.len() as u64).to_le_bytes());
        self.0.update(text);
        self
    }

    /// Adds the contents of a file.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn file(self, path: &Path) -> Result<Self, BoardError> {
        let bytes = std::fs::read(path).map_err(BoardError::file(path))?;
        Ok(self.text(&hexadecimal(Sha256::digest(bytes))))
    }

    fn name(self) -> String {
        hexadecimal(self.0.finalize())
    }
}

/// A digest as hexadecimal text.
pub(super) fn hexadecimal(digest: impl AsRef<[u8]>) -> String {
    digest.as_ref().iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The kept files of a run and of the runs before it.
pub(super) struct Kept {
    folder: PathBuf,
    /// The folders, named by digest, of the steps of this run.
    used: RefCell<BTreeSet<String>>,
}

impl Kept {
    /// The kept files of a run whose tools work in the folder `work`.
    pub fn within(work: &Path) -> Self {
        Self { folder: work.join(FOLDER), used: RefCell::default() }
    }

    /// Does a step that makes `files` in the folder `work`, or copies the files there if an earlier run kept them.
    /// Returns `true` if the step was left out because of that.
    ///
    /// `check` must find the files sound. If it does not, kept files are forgotten and the step is done, and new ones
    /// are not kept.
    ///
    /// # Errors
    /// The errors of the step and of the check, and any file that cannot be copied.
    pub fn step(
        &self,
        key: Key,
        work: &Path,
        files: &[&str],
        check: impl Fn() -> Result<(), BoardError>,
        step: impl FnOnce() -> Result<(), BoardError>,
    ) -> Result<bool, BoardError> {
        let name = key.name();
        let folder = self.folder.join(&name);
        self.used.borrow_mut().insert(name.clone());
        if folder.exists() {
            if copy(files, &folder, work).and_then(|()| check()).is_ok() {
                return Ok(true);
            }
            std::fs::remove_dir_all(&folder).map_err(BoardError::file(&folder))?;
        }
        step()?;
        check()?;
        // An interrupted copy leaves a folder with the ending `.part`, which no run uses.
        let part = self.folder.join(format!("{name}.part"));
        std::fs::create_dir_all(&part).map_err(BoardError::file(&part))?;
        copy(files, work, &part)?;
        std::fs::rename(&part, &folder).map_err(BoardError::file(&folder))?;
        Ok(false)
    }

    /// Removes the kept files of every step that this run did not need.
    ///
    /// # Errors
    /// If a folder cannot be read or removed.
    pub fn drop_others(self) -> Result<(), BoardError> {
        let used = self.used.into_inner();
        for entry in std::fs::read_dir(&self.folder).map_err(BoardError::file(&self.folder))? {
            let entry = entry.map_err(BoardError::file(&self.folder))?;
            let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
            if is_folder && !used.contains(&*entry.file_name().to_string_lossy()) {
                std::fs::remove_dir_all(entry.path()).map_err(BoardError::file(entry.path()))?;
            }
        }
        Ok(())
    }
}

fn copy(files: &[&str], from: &Path, to: &Path) -> Result<(), BoardError> {
    for file in files {
        let file = (from.join(file), to.join(file));
        std::fs::copy(&file.0, &file.1).map_err(BoardError::file(file.0))?;
    }
    Ok(())
}
