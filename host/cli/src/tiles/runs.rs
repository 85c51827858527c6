//! Triangles that come in any order, kept in sorted runs: one in memory, the others in files.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use super::canonical::sorted;
use super::written::write_rows;
use crate::failure::Failure;
use crate::{interrupt, path};

/// The number of bytes of a triangle in a file.
const TRIANGLE_BYTES: usize = 12;

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
        let room = usize::try_from(memory / (2 * TRIANGLE_BYTES as u64)).unwrap_or(usize::MAX).max(1 << 10);
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

/// A sorted run in a file, which is open only while it is read. Dropping the value removes the file.
pub struct Run {
    path: PathBuf,
    /// The numbers of triangles that were read, and that were not.
    read: u64,
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
        let run = Self { path, read: 0, left: triangles.len() as u64 };
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
        self.read_some(list, count).map_err(|error| failed(&self.path, "read", &error))?;
        self.read += count;
        self.left -= count;
        Ok(())
    }

    fn read_some(&self, list: &mut Vec<[u32; 3]>, count: u64) -> io::Result<()> {
        let mut file = File::open(&self.path)?;
        file.seek(SeekFrom::Start(self.read * TRIANGLE_BYTES as u64))?;
        let mut source = BufReader::with_capacity(1 << 16, file);
        for _ in 0..count {
            let mut bytes = [0; TRIANGLE_BYTES];
            source.read_exact(&mut bytes)?;
            let words = bytes.as_chunks::<4>().0;
            list.push([0, 1, 2].map(|place| u32::from_le_bytes(words[place])));
        }
        Ok(())
    }
}

impl Drop for Run {
    fn drop(&mut self) {
        let mut unfinished = interrupt::unfinished();
        let _ = fs::remove_file(&self.path);
        unfinished.remove(&self.path);
    }
}

fn failed(file: &Path, what: &str, error: &io::Error) -> Failure {
    Failure::input(format!("{} cannot be {what}: {error}", path::name(file)))
}
