//! A file for rows that do not fit the memory, which is gone when the process ends, whatever ends it.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use crate::failure::Failure;
use crate::{interrupt, path};

/// The number of rows that become bytes together.
const ROWS: usize = 1 << 12;

/// A file of rows, which can be read and written at any place.
pub struct Spill {
    file: File,
    path: PathBuf,
    length: u64,
    bytes: Vec<u8>,
}

impl Spill {
    /// Makes an empty file in a folder.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub fn create(folder: &Path) -> Result<Self, Failure> {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let path = folder.join(format!(".verify.{}.{number}.part", std::process::id()));
        // No interrupt ends the process between the two steps.
        let mut unfinished = interrupt::unfinished();
        let made = OpenOptions::new().read(true).write(true).create(true).truncate(true).open(&path);
        let file = made.map_err(|error| failed(&path, "written", &error))?;
        if cfg!(unix) {
            // A file without a name stays until it is closed, also if the process is killed.
            fs::remove_file(&path).map_err(|error| failed(&path, "removed", &error))?;
        } else {
            unfinished.push(path.clone());
        }
        Ok(Self { file, path, length: 0, bytes: Vec::new() })
    }

    /// The number of bytes.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// Writes rows at the end, and returns the place of the first one.
    ///
    /// # Errors
    /// The disk is full or fails.
    pub fn append<const N: usize>(&mut self, rows: &[[u32; N]]) -> Result<u64, Failure> {
        let at = self.length;
        self.write(at, rows)?;
        Ok(at)
    }

    /// Writes rows at a place.
    ///
    /// # Errors
    /// The disk is full or fails.
    pub fn write<const N: usize>(&mut self, at: u64, rows: &[[u32; N]]) -> Result<(), Failure> {
        interrupt::check()?;
        let Self { file, path, bytes, .. } = self;
        let mut put = || -> io::Result<()> {
            file.seek(SeekFrom::Start(at))?;
            for rows in rows.chunks(ROWS) {
                bytes.clear();
                bytes.extend(rows.as_flattened().iter().flat_map(|number| number.to_le_bytes()));
                file.write_all(bytes)?;
            }
            Ok(())
        };
        put().map_err(|error| failed(path, "written", &error))?;
        self.length = self.length.max(at + (rows.len() * 4 * N) as u64);
        Ok(())
    }

    /// Adds `count` rows from a place on to a list.
    ///
    /// # Errors
    /// The disk fails.
    pub fn read<const N: usize>(&self, at: u64, count: usize, list: &mut Vec<[u32; N]>) -> Result<(), Failure> {
        interrupt::check()?;
        let mut get = || -> io::Result<()> {
            let mut file = &self.file;
            file.seek(SeekFrom::Start(at))?;
            let mut bytes = vec![0; count.min(ROWS) * 4 * N];
            let mut left = count;
            while left > 0 {
                let rows = left.min(ROWS);
                let bytes = &mut bytes[..rows * 4 * N];
                file.read_exact(bytes)?;
                list.extend(bytes.chunks_exact(4 * N).map(row));
                left -= rows;
            }
            Ok(())
        };
        get().map_err(|error| failed(&self.path, "read", &error))
    }
}

/// The row of these bytes.
fn row<const N: usize>(bytes: &[u8]) -> [u32; N] {
    let mut row = [0; N];
    for (number, word) in row.iter_mut().zip(bytes.as_chunks::<4>().0) {
        *number = u32::from_le_bytes(*word);
    }
    row
}

impl Drop for Spill {
    fn drop(&mut self) {
        if !cfg!(unix) {
            let mut unfinished = interrupt::unfinished();
            let _ = fs::remove_file(&self.path);
            unfinished.remove(&self.path);
        }
    }
}

fn failed(file: &Path, what: &str, error: &io::Error) -> Failure {
    Failure::input(format!("{} cannot be {what}: {error}", path::name(file)))
}
