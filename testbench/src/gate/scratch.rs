//! A folder for one run of one tool.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

static NEXT: AtomicU32 = AtomicU32::new(0);

/// A fresh folder below cargo's target folder, shared with no other test and removed in the end.
pub(super) struct Scratch {
    path: PathBuf,
}

impl Scratch {
    pub(super) fn new(top: &str) -> io::Result<Self> {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let name = format!("{top}-{}-{number}", std::process::id());
        let path = Path::new(env!("OUT_DIR")).join("gate").join(name);
        if path.exists() {
            // An earlier process with the same number was killed and left its folder behind.
            std::fs::remove_dir_all(&path)?;
        }
        std::fs::create_dir_all(&path)?;
        Ok(Self { path })
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn write(&self, file: &str, text: &str) -> io::Result<()> {
        std::fs::write(self.path.join(file), text)
    }

    pub(super) fn read(&self, file: &str) -> io::Result<String> {
        std::fs::read_to_string(self.path.join(file))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // Nothing depends on the removal: a folder that stays only takes space until `cargo clean`.
        let _ = std::fs::remove_dir_all(&self.path);
    }
}
