//! The second pass: the points of all inputs are dealt to one file for each cell.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crc32fast::Hasher;
use incircle::Point;

use super::head::{Head, HEAD_BYTES};
use crate::failure::Failure;
use crate::input::unreadable;
use crate::{interrupt, path};

/// The number of bytes of a point in a file: its index, x and y.
pub const POINT_BYTES: usize = 12;
/// The least and the most bytes of a buffer. Each time that one is full, its file is opened and closed, because there
/// may be more files than a process may keep open.
const BUFFER: std::ops::Range<usize> = 1 << 12..1 << 18;

/// The end of a working name.
pub const WORKING: &str = ".points.part";

/// A file of points under its working name. Dropping the value removes the file.
pub struct PointFile {
    path: PathBuf,
    buffer: Vec<u8>,
    check: Hasher,
    /// The number of points.
    pub points: u64,
}

impl PointFile {
    /// Makes an empty file with room for a head. `number` is part of its working name, and must be another one for each
    /// file of a run.
    pub fn create(folder: &Path, number: usize) -> Result<Self, Failure> {
        let path = folder.join(format!(".{number}.{}{WORKING}", std::process::id()));
        let mut unfinished = interrupt::unfinished();
        let opened = OpenOptions::new().write(true).create(true).truncate(true).open(&path);
        // The value exists before anything is written, so that a failure removes the file.
        let made = opened.map(|file| {
            unfinished.push(path.clone());
            (file, Self { path: path.clone(), buffer: Vec::new(), check: Hasher::new(), points: 0 })
        });
        drop(unfinished);
        let (mut file, made) = made.map_err(|error| cannot_write(&path, &error))?;
        file.write_all(&[0; HEAD_BYTES]).map_err(|error| cannot_write(&path, &error))?;
        Ok(made)
    }

    /// Adds a point. `room` is the size of the buffer, in bytes.
    #[inline]
    pub fn push(&mut self, index: u32, point: Point, room: usize) -> Result<(), Failure> {
        self.buffer.extend([index, point.x, point.y].map(u32::to_le_bytes).as_flattened());
        self.points += 1;
        if self.buffer.len() >= room {
            self.flush()?;
        }
        Ok(())
    }

    /// Writes what is in the buffer.
    pub fn flush(&mut self) -> Result<(), Failure> {
        if self.buffer.is_empty() {
            return Ok(());
        }
        self.check.update(&self.buffer);
        let opened = OpenOptions::new().append(true).open(&self.path);
        let written = opened.and_then(|mut file| file.write_all(&self.buffer));
        self.buffer.clear();
        written.map_err(|error| cannot_write(&self.path, &error))
    }

    /// Calls `take` with the index and the place of each point of the file.
    pub fn each(&mut self, take: &mut dyn FnMut(u32, Point) -> Result<(), Failure>) -> Result<(), Failure> {
        self.flush()?;
        self.buffer = Vec::new();
        let failed = |error: io::Error| unreadable(&error).in_file(path::name(&self.path));
        let mut file = File::open(&self.path).map_err(failed)?;
        file.seek(SeekFrom::Start(HEAD_BYTES as u64)).map_err(failed)?;
        let mut source = BufReader::with_capacity(BUFFER.end, file);
        for _ in 0..self.points {
            let mut bytes = [0; POINT_BYTES];
            source.read_exact(&mut bytes).map_err(failed)?;
            let words = bytes.as_chunks::<4>().0;
            let [index, x, y] = [0, 1, 2].map(|place| u32::from_le_bytes(words[place]));
            take(index, Point::new(x, y))?;
        }
        Ok(())
    }

    /// Writes the head, and gives the file its final name.
    pub fn place(mut self, head: Head, target: &Path) -> Result<Placed, Failure> {
        self.flush()?;
        let check = self.check.clone().finalize();
        let head = Head { check, counts: [self.points, 0, 0, 0, 0], ..head };
        let write = || -> io::Result<()> {
            let mut file = File::options().write(true).open(&self.path)?;
            file.rewind()?;
            file.write_all(&head.to_bytes())
        };
        write().map_err(|error| cannot_write(target, &error))?;
        let mut unfinished = interrupt::unfinished();
        interrupt::check()?;
        fs::rename(&self.path, target).map_err(|error| cannot_write(target, &error))?;
        unfinished.rename(&self.path, target.to_owned());
        drop(unfinished);
        self.path = PathBuf::new();
        Ok(Placed { path: target.to_owned() })
    }
}

impl Drop for PointFile {
    fn drop(&mut self) {
        remove(&self.path);
    }
}

/// A file of points under its final name. Dropping the value removes the file, unless it is kept.
#[must_use]
pub struct Placed {
    path: PathBuf,
}

impl Placed {
    /// Leaves the file where it is.
    pub fn keep(mut self) {
        let path = std::mem::take(&mut self.path);
        interrupt::unfinished().remove(&path);
    }
}

impl Drop for Placed {
    fn drop(&mut self) {
        remove(&self.path);
    }
}

fn remove(path: &Path) {
    if path.as_os_str().is_empty() {
        return;
    }
    let mut unfinished = interrupt::unfinished();
    let _ = fs::remove_file(path);
    unfinished.remove(path);
}

/// Removes the hidden working files with this ending that earlier runs left in a folder because they were killed.
pub fn remove_stale(folder: &Path, ending: &str) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.filter_map(Result::ok) {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with('.') && name.ends_with(ending) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// The size of a buffer, in bytes, if `files` files share `bytes`.
pub fn room_for(bytes: usize, files: usize) -> usize {
    (bytes / files.max(1)).clamp(BUFFER.start, BUFFER.end)
}

fn cannot_write(path: &Path, error: &io::Error) -> Failure {
    Failure::input(format!("{} cannot be written: {error}", path::name(path)))
}
