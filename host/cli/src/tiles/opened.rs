//! A file of tiles that is open for reading: lists of whole numbers, and the check sum of all of them.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use crc32fast::Hasher;

use super::head::{damaged, Head, Kind, HEAD_BYTES};
use crate::failure::Failure;
use crate::input::unreadable;
use crate::path;

/// The number of bytes that are read at a time.
const PIECE: usize = 1 << 16;

/// The run and the tile that a file must belong to.
#[derive(Clone, Copy, Debug)]
pub struct Owner {
    /// The run of the manifest.
    pub run: u64,
    /// The number of the tile.
    pub tile: u32,
}

/// Gives the bytes behind a head with these counts; `None` for more than 2^64.
pub type BytesOf = fn(&[u64; 5]) -> Option<u64>;

/// A file whose head was read.
pub struct Opened {
    /// The head.
    pub head: Head,
    path: PathBuf,
    /// The open file; `None` while it is [closed](Opened::close).
    source: Option<BufReader<File>>,
    /// The place of the next byte.
    at: u64,
    check: Hasher,
    /// Bytes that were not read yet.
    left: u64,
}

impl Opened {
    /// Opens a file and reads its head. `bytes_of` gives the bytes behind the head for the counts in the head, unless
    /// only the file says how many there are.
    pub fn open(path: &Path, kind: Kind, owner: Option<Owner>, bytes_of: Option<BytesOf>) -> Result<Self, Failure> {
        let opened = Self::begin(path, kind).and_then(|opened| {
            opened.check_owner(owner)?;
            if bytes_of.is_some_and(|bytes_of| bytes_of(&opened.head.counts) != Some(opened.left)) {
                let left = opened.left;
                return Err(damaged(&format!("the {left} bytes behind its head are not those that the head counts")));
            }
            Ok(opened)
        });
        opened.map_err(|failure| failure.in_file(path::name(path)))
    }

    fn begin(path: &Path, kind: Kind) -> Result<Self, Failure> {
        let file = File::open(path).map_err(|error| unreadable(&error))?;
        let length = file.metadata().map_err(|error| unreadable(&error))?.len();
        let mut source = BufReader::with_capacity(PIECE, file);
        let mut bytes = [0; HEAD_BYTES];
        source.read_exact(&mut bytes).map_err(|error| ended(&error))?;
        let head = Head::of_bytes(&bytes, kind)?;
        let at = HEAD_BYTES as u64;
        let left = length.saturating_sub(at);
        Ok(Self { head, path: path.to_owned(), source: Some(source), at, check: Hasher::new(), left })
    }

    fn check_owner(&self, owner: Option<Owner>) -> Result<(), Failure> {
        let Some(owner) = owner else { return Ok(()) };
        if self.head.run != owner.run {
            return Err(Failure::input(format!(
                "the file belongs to run {:016x}, and the manifest to run {:016x}: remove the file and do its \
                 step again, or remove the folder and begin again",
                self.head.run, owner.run
            )));
        }
        if self.head.tile != owner.tile {
            return Err(Failure::input(format!(
                "the file belongs to tile {}, not to tile {}: give each file its own name back",
                self.head.tile, owner.tile
            )));
        }
        Ok(())
    }

    /// The number of bytes that were not read yet.
    pub fn left(&self) -> u64 {
        self.left
    }

    /// Fills the bytes.
    pub fn fill(&mut self, bytes: &mut [u8]) -> Result<(), Failure> {
        self.read(bytes).map_err(|error| self.in_file(ended(&error)))?;
        self.check.update(bytes);
        self.pass(bytes.len() as u64);
        Ok(())
    }

    fn read(&mut self, bytes: &mut [u8]) -> io::Result<()> {
        if let Some(source) = &mut self.source {
            return source.read_exact(bytes);
        }
        let mut file = File::open(&self.path)?;
        file.seek(SeekFrom::Start(self.at))?;
        self.source.insert(BufReader::with_capacity(PIECE, file)).read_exact(bytes)
    }

    fn pass(&mut self, bytes: u64) {
        self.at = self.at.saturating_add(bytes);
        self.left = self.left.saturating_sub(bytes);
    }

    /// Closes the file until more of it is read. A process may keep fewer files open than a set has tiles.
    pub fn close(&mut self) {
        self.source = None;
    }

    /// Calls `take` with each of `count` rows of `N` numbers.
    pub fn rows<const N: usize>(
        &mut self,
        count: u64,
        mut take: impl FnMut([u32; N]) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let rows_of_piece = PIECE / (4 * N);
        let mut piece = vec![0; rows_of_piece * 4 * N];
        let mut left = count;
        while left > 0 {
            let rows = left.min(rows_of_piece as u64);
            let bytes = &mut piece[..rows as usize * 4 * N];
            self.fill(bytes)?;
            for row in bytes.chunks_exact(4 * N) {
                let mut numbers = [0; N];
                for (number, word) in numbers.iter_mut().zip(row.as_chunks::<4>().0) {
                    *number = u32::from_le_bytes(*word);
                }
                take(numbers)?;
            }
            left -= rows;
        }
        Ok(())
    }

    /// A list of `count` rows of `N` numbers. The length of the file must have proved that they are there.
    pub fn list<const N: usize>(&mut self, count: u64) -> Result<Vec<[u32; N]>, Failure> {
        let mut list = Vec::new();
        let room = usize::try_from(count).unwrap_or(usize::MAX);
        list.try_reserve_exact(room)
            .map_err(|_| self.in_file(Failure::input(format!("{count} rows do not fit the memory"))))?;
        self.rows(count, |row| {
            list.push(row);
            Ok(())
        })?;
        Ok(list)
    }

    /// Passes over bytes without checking them, before anything else is read.
    pub fn skip(&mut self, bytes: u64) {
        self.close();
        self.pass(bytes);
    }

    /// Compares the check sum of the head with that of all bytes that were read. Until then none of them is certain.
    /// A check sum of what follows begins.
    pub fn end_of_content(&mut self) -> Result<(), Failure> {
        match std::mem::take(&mut self.check).finalize() == self.head.check {
            true => Ok(()),
            false => Err(self.wrong_sum()),
        }
    }

    /// Compares the check sum of all bytes behind the head. Until then nothing that was read is certain.
    pub fn finish(mut self) -> Result<(), Failure> {
        if self.left > 0 {
            return Err(self.wrong_sum());
        }
        self.end_of_content()
    }

    /// Compares the check sum of what was read with the one at the end of the file.
    pub fn finish_with_sum(mut self) -> Result<(), Failure> {
        let sum = std::mem::take(&mut self.check).finalize();
        let mut bytes = [0; 4];
        self.fill(&mut bytes)?;
        if self.left > 0 || u32::from_le_bytes(bytes) != sum {
            return Err(self.wrong_sum());
        }
        Ok(())
    }

    fn wrong_sum(&self) -> Failure {
        self.in_file(damaged("its check sum is wrong"))
    }

    fn in_file(&self, failure: Failure) -> Failure {
        failure.in_file(path::name(&self.path))
    }
}

fn ended(error: &io::Error) -> Failure {
    match error.kind() {
        io::ErrorKind::UnexpectedEof => damaged("it ends too early"),
        _ => unreadable(error),
    }
}
