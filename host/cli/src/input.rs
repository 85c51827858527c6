//! Input files: their bytes, unpacked and bounded by the memory that is free.

use std::fs::File;
use std::io::{self, BufReader, Cursor, Read, Seek};
use std::path::Path;

use flate2::read::MultiGzDecoder;

use crate::failure::Failure;
use crate::memory::Memory;
use crate::path::{self, Compression};
use crate::progress::ReadMeter;

/// A source that can be read from any place.
pub trait ReadSeek: Read + Seek + Send + Sync {}

impl<T: Read + Seek + Send + Sync> ReadSeek for T {}

/// An input that is open for reading. Reading more bytes than half of the free memory is an error, so that neither a
/// packed file nor a pipe without an end can take all memory.
pub struct Input {
    source: Box<dyn Read + Send>,
    /// The file itself, if its bytes are not packed.
    file: Option<File>,
    /// The number of bytes in the file; zero if it is unknown or the file is packed.
    size: u64,
    /// Bytes that may still be read.
    left: u64,
    memory: Memory,
    quiet: bool,
}

impl Input {
    /// Opens a file, or standard input for the path `-`. Files with the extension `.gz` or `.zst` are unpacked.
    pub fn open(path: &Path, quiet: bool) -> Result<Self, Failure> {
        Self::open_within(path, quiet, Memory::free())
    }

    fn open_within(path: &Path, quiet: bool, memory: Memory) -> Result<Self, Failure> {
        let left = memory.input_bytes();
        if path::is_standard(path) {
            let source = Box::new(ReadMeter::new(io::stdin(), 0, quiet));
            return Ok(Self { source, file: None, size: 0, left, memory, quiet });
        }
        let file = File::open(path).map_err(|error| unreadable(&error))?;
        let found = file.metadata().map_err(|error| unreadable(&error))?;
        if found.is_dir() {
            return Err(unreadable(&io::Error::from(io::ErrorKind::IsADirectory)));
        }
        let own = file.try_clone().map_err(|error| unreadable(&error))?;
        let raw = ReadMeter::new(file, found.len(), quiet);
        let compression = Compression::of(path);
        let source: Box<dyn Read + Send> = match compression {
            Compression::None => Box::new(raw),
            Compression::Gzip => {
                let packed = BufReader::with_capacity(1 << 16, raw);
                Box::new(Unpacked { source: MultiGzDecoder::new(packed), packer: "gzip" })
            }
            Compression::Zstd => {
                let source = zstd::Decoder::new(raw).map_err(|error| unreadable(&error))?;
                Box::new(Unpacked { source, packer: "zstd" })
            }
        };
        let is_plain = compression == Compression::None && found.is_file();
        let size = if is_plain { found.len() } else { 0 };
        Ok(Self { source, file: is_plain.then_some(own), size, left, memory, quiet })
    }

    /// An input of these bytes, with as much memory as it takes.
    pub fn of_bytes(bytes: &[u8]) -> Self {
        Self::of_bytes_within(bytes, Memory::ENDLESS)
    }

    /// An input of these bytes. What is made of it may take so much memory.
    pub fn of_bytes_within(bytes: &[u8], memory: Memory) -> Self {
        let source = Box::new(Cursor::new(bytes.to_vec()));
        Self { source, file: None, size: bytes.len() as u64, left: memory.input_bytes(), memory, quiet: true }
    }

    /// The number of bytes of the input, or zero if that is not known before it is read.
    pub fn size(&self) -> u64 {
        self.size
    }

    /// The memory that the input, and what is made of it, may take.
    pub fn memory(&self) -> Memory {
        self.memory
    }

    /// The input without a bound on its bytes, for readers that keep only a piece of it.
    pub fn without_end(self) -> Self {
        Self { left: u64::MAX, ..self }
    }

    /// All bytes of the input.
    pub fn into_bytes(mut self) -> Result<Vec<u8>, Failure> {
        if self.size > self.memory.input_bytes() {
            return Err(unreadable(&too_large(self.memory)));
        }
        let mut bytes = Vec::new();
        // With room for one byte more than the file has, reading notices the end without another allocation.
        let room = usize::try_from(self.size).unwrap_or(usize::MAX).saturating_add(1);
        bytes.try_reserve_exact(room).map_err(|_| unreadable(&too_large(self.memory)))?;
        self.read_to_end(&mut bytes).map_err(|error| unreadable(&error))?;
        // A list that grew may have twice the room that it needs.
        bytes.shrink_to_fit();
        Ok(bytes)
    }

    /// The input as a source that can be read from any place: the file itself, or else all its bytes in memory.
    pub fn into_seekable(self) -> Result<Box<dyn ReadSeek>, Failure> {
        match self.file {
            Some(file) => {
                let meter = ReadMeter::new(file, self.size, self.quiet);
                Ok(Box::new(BufReader::with_capacity(1 << 20, meter)))
            }
            None => Ok(Box::new(Cursor::new(self.into_bytes()?))),
        }
    }
}

impl Read for Input {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(into)?;
        self.left = self.left.checked_sub(count as u64).ok_or_else(|| too_large(self.memory))?;
        Ok(count)
    }
}

/// A packed source, whose damage is told in a sentence.
struct Unpacked<R> {
    source: R,
    packer: &'static str,
}

impl<R: Read> Read for Unpacked<R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        self.source.read(into).map_err(|error| match error.raw_os_error() {
            // The disk is at fault, and not the data.
            Some(_) => error,
            None => io::Error::other(format!(
                "its data packed by {} is damaged or cut off ({error}): copy the file again, or pack it again",
                self.packer
            )),
        })
    }
}

/// The failure of an input that cannot be read.
pub fn unreadable(error: &io::Error) -> Failure {
    if error.kind() == io::ErrorKind::UnexpectedEof {
        return Failure::input("the file ends too early: it is cut off, or it changed while it was read");
    }
    Failure::input(format!("the file cannot be read: {error}"))
}

fn too_large(memory: Memory) -> io::Error {
    let mebibytes = memory.input_bytes() >> 20;
    io::Error::other(format!(
        "the input has more than {mebibytes} MiB, which is half of the free memory: triangulate a part of it, or use a \
         machine with more memory"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_input_without_an_end_is_refused() {
        let mut input = Input::of_bytes(b"");
        (input.source, input.left, input.memory) = (Box::new(io::repeat(b'1')), 1 << 20, Memory::of_bytes(1 << 21));
        let failure = input.into_bytes().expect_err("more than a mebibyte");
        assert!(failure.message.contains("more than 1 MiB"), "{failure}");
    }

    #[test]
    fn a_packed_file_cannot_take_all_memory() {
        let path = std::env::temp_dir().join(format!("incircle-bomb-{}.csv.zst", std::process::id()));
        let packed = zstd::encode_all(io::repeat(b'1').take(1 << 24), 0).expect("memory takes all bytes");
        assert!(packed.len() < 1 << 14);
        std::fs::write(&path, packed).expect("the folder can be written");
        let read = |bound| Input::open_within(&path, true, Memory::of_bytes(bound)).and_then(Input::into_bytes);
        let (within, beyond) = (read(1 << 25), read((1 << 25) - 1));
        std::fs::remove_file(&path).expect("the file was written");
        assert_eq!(within.map(|bytes| bytes.len()), Ok(1 << 24));
        let failure = beyond.expect_err("one byte too many");
        assert!(failure.message.contains("more than 15 MiB"), "{failure}");
    }
}
