//! The triangles of a mesh file, read as often as they are needed.

use std::cell::Cell;
use std::path::{Path, PathBuf};

use super::sorter::{Sorted, Sorter};
use crate::failure::{counted, Failure};
use crate::formats::{MeshFormat, TakeTriangle};
use crate::input::Input;
use crate::path;
use crate::progress::CountMeter;
use crate::tiles::scattered;

/// A mesh file that is read piece by piece, and must be the same each time.
pub struct MeshFile {
    path: PathBuf,
    format: MeshFormat,
    /// The number and the digest of the triangles, once they were read.
    seen: Cell<Option<(u64, u64)>>,
    /// All triangles in order, if those of the file may be in any order.
    sorted: Option<Sorted<3>>,
    /// The memory for reading.
    memory: u64,
}

impl MeshFile {
    /// A file of this format.
    pub fn new(path: &Path, format: MeshFormat, memory: u64) -> Self {
        Self { path: path.to_owned(), format, seen: Cell::new(None), sorted: None, memory }
    }

    /// Sorts the triangles, within the memory for reading.
    ///
    /// # Errors
    /// The file cannot be read, or the folder cannot be written.
    pub fn sort(&mut self, folder: &Path) -> Result<(), Failure> {
        let mut sorter = Sorter::new(folder, self.memory);
        self.each(&mut |triangle| sorter.push(triangle))?;
        self.sorted = Some(sorter.finish()?);
        Ok(())
    }

    /// Calls `take` with all triangles, in the order of the list that is checked.
    ///
    /// # Errors
    /// The file cannot be read, holds something else, or has changed; or `take` fails.
    pub fn each(&self, take: TakeTriangle<'_>) -> Result<(), Failure> {
        if let Some(sorted) = &self.sorted {
            let mut stream = sorted.stream(self.memory)?;
            while let Some(triangle) = stream.take()? {
                take(triangle)?;
            }
            return Ok(());
        }
        let (mut count, mut digest) = (0u64, 0u64);
        // A failure of `take` is not one of the file.
        let mut failed = None;
        let done = self.format.each_triangle(&|| Input::open(&self.path, true), &mut |triangle| {
            count += 1;
            digest = triangle.into_iter().fold(digest, |digest, corner| scattered(digest ^ u64::from(corner)));
            take(triangle).inspect_err(|failure| failed = Some(failure.clone()))
        });
        match failed {
            Some(failure) => return Err(failure),
            None => done.map_err(|failure| failure.in_file(path::name(&self.path)))?,
        }
        match self.seen.replace(Some((count, digest))) {
            Some(seen) if seen != (count, digest) => Err(self.changed()),
            _ => Ok(()),
        }
    }

    /// Calls `take` like [`each`](Self::each), and shows the progress. `total` is the expected number of triangles.
    ///
    /// # Errors
    /// As for [`each`](Self::each).
    pub fn each_shown(&self, total: u64, quiet: bool, take: TakeTriangle<'_>) -> Result<(), Failure> {
        const SOME: u64 = 1 << 16;
        let meter = CountMeter::new(total, "checking", "triangles", quiet);
        let mut count = 0;
        self.each(&mut |triangle| {
            count += 1u64;
            if count.is_multiple_of(SOME) {
                meter.advance(SOME);
            }
            take(triangle)
        })
    }

    /// The number of triangles.
    ///
    /// # Errors
    /// As for [`each`](Self::each).
    pub fn count(&self) -> Result<usize, Failure> {
        let mut count = 0;
        self.each(&mut |_| {
            count += 1;
            Ok(())
        })?;
        Ok(count)
    }

    /// The places of some triangles in the list, each for its first copy.
    ///
    /// # Errors
    /// As for [`each`](Self::each), or a triangle is no longer there.
    pub fn places(&self, triangles: &[[u32; 3]]) -> Result<Vec<usize>, Failure> {
        let (mut place, mut found) = (0, vec![None; triangles.len()]);
        self.each(&mut |triangle| {
            for (wanted, found) in triangles.iter().zip(&mut found) {
                if found.is_none() && *wanted == triangle {
                    *found = Some(place);
                }
            }
            place += 1;
            Ok(())
        })?;
        found.into_iter().map(|found| found.ok_or_else(|| self.changed())).collect()
    }

    fn changed(&self) -> Failure {
        let count = self.seen.get().map_or(0, |(count, _)| count);
        Failure::input(format!(
            "{} has changed while it was read, and has {} now: verify it again, and leave it alone meanwhile",
            path::name(&self.path),
            counted(count as usize, "triangle")
        ))
    }
}
