//! Triangles that come in any order, kept in sorted runs: one in memory, the others in files.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use super::canonical::sorted;
use super::written::write_rows;
use crate::failure::Failure;
use crate::{interrupt, path};

/// Triangles in runs.
pub struct Runs {
    folder: PathBuf,
    /// The most triangles in memory.
    room: usize,
    buffer: Vec<[u32; 3]>,
    files: Vec<Run>,
}

impl Runs {
    /// Makes an empty list, which has at most `memory` bytes in memory, and the rest in hidden files of the folder.
    pub fn new(folder: &Path, memory: u64) -> Self {
        // A sort takes the memory of a second list.
        let room = usize::try_from(memory / 24).unwrap_or(usize::MAX).max(1 << 10);
        Self { folder: folder.to_owned(), room, buffer: Vec::new(), files: Vec::new() }
    }

    /// Adds triangles.
    pub fn add(&mut self, triangles: &[[u32; 3]]) -> Result<(), Failure> {
        for some in triangles.chunks(self.room) {
            if self.buffer.len() + some.len() > self.room {
                self.files.push(Run::write(&self.folder, &sorted(&[&self.buffer]))?);
                self.buffer.clear();
            }
            self.buffer.extend_from_slice(some);
        }
        Ok(())
    }

    /// The run in memory, and those in files.
    pub fn finish(self) -> (Vec<[u32; 3]>, Vec<Run>) {
        (sorted(&[&self.buffer]), self.files)
    }
}

/// The number of triangles that are read at a time.
const PIECE: usize = 1 << 12;

/// A sorted run in a file, which is open only while it is read: there may be more runs than a process may have open
/// files. Dropping the value removes the file.
pub struct Run {
    path: PathBuf,
    /// The triangles that were read.
    done: u64,
    left: u64,
}

impl Run {
    fn write(folder: &Path, triangles: &[[u32; 3]]) -> Result<Self, Failure> {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let path = folder.join(format!(".join.{}.{number}.part", std::process::id()));
        let mut unfinished = interrupt::unfinished();
        let made = OpenOptions::new().write(true).create(true).truncate(true).open(&path);
        let mut file = made.map_err(|error| failed(&path, "written", &error))?;
        unfinished.push(path.clone());
        drop(unfinished);
        // The value exists before the file is written, so that a failure removes the file.
        let run = Self { path, done: 0, left: triangles.len() as u64 };
        write_rows(triangles, &mut file)
            .and_then(|()| file.flush())
            .map_err(|error| failed(&run.path, "written", &error))?;
        Ok(run)
    }

    /// Whether triangles are left to be read.
    pub fn has_more(&self) -> bool {
        self.left > 0
    }

    /// Adds up to `most` triangles to a list.
    pub fn read(&mut self, list: &mut Vec<[u32; 3]>, most: usize) -> Result<(), Failure> {
        let count = self.left.min(most as u64);
        self.read_rows(list, count).map_err(|error| failed(&self.path, "read", &error))?;
        self.done += count;
        self.left -= count;
        Ok(())
    }

    fn read_rows(&self, list: &mut Vec<[u32; 3]>, count: u64) -> io::Result<()> {
        let mut file = File::open(&self.path)?;
        file.seek(SeekFrom::Start(self.done * 12))?;
        let mut left = usize::try_from(count).unwrap_or(usize::MAX);
        let mut piece = vec![0; left.min(PIECE) * 12];
        while left > 0 {
            let bytes = &mut piece[..left.min(PIECE) * 12];
            file.read_exact(bytes)?;
            let words = bytes.as_chunks::<4>().0.as_chunks::<3>().0;
            list.extend(words.iter().map(|row| row.map(u32::from_le_bytes)));
            left -= words.len();
        }
        Ok(())
    }
}

impl Drop for Run {
    fn drop(&mut self) {
        let mut unfinished = interrupt::unfinished();
        let _ = fs::remove_file(&self.path);
        unfinished.retain(|kept| *kept != self.path);
    }
}

fn failed(file: &Path, what: &str, error: &io::Error) -> Failure {
    Failure::input(format!("{} cannot be {what}: {error}", path::name(file)))
}
