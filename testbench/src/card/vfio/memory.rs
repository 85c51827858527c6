//! The host's memory as the card may reach it: what was mapped for the card, and nothing else.

use std::fs::File;

use rustix::fs::{fcntl_get_seals, SealFlags};
use vfio_user::DmaMapFlags;
use vm_memory::{FileOffset, MmapRegion, VolatileMemory};

/// The reasons why memory is not mapped or not unmapped.
#[derive(Debug, thiserror::Error)]
pub enum MapError {
    /// Memory without a file could be reached by messages only.
    #[error("the memory at {0:#x} comes without a file: give one that can be mapped")]
    NoFile(u64),
    /// The process would die if it read beyond the end of a file that was cut.
    #[error("the file of the memory at {0:#x} may become shorter: seal it against that")]
    Shrinks(u64),
    /// The file ends before the range does.
    #[error(
        "the file of the memory at {address:#x} has {length} bytes, less than {size} from {offset} on: \
         give its true size"
    )]
    Short {
        /// First address of the range.
        address: u64,
        /// Bytes of the file.
        length: u64,
        /// Bytes to be mapped.
        size: u64,
        /// Offset of the range in the file.
        offset: u64,
    },
    /// The addresses form no range.
    #[error("{size} bytes at {address:#x} are no range of addresses: map at least a byte, and at most up to 2^64 - 1")]
    Range {
        /// First address of the range.
        address: u64,
        /// Number of bytes in the range.
        size: u64,
    },
    /// A part of the range is mapped already.
    #[error("{size} bytes at {address:#x} overlap what is mapped: unmap that first")]
    Overlaps {
        /// First address of the range.
        address: u64,
        /// Number of bytes in the range.
        size: u64,
    },
    /// The range is not a mapping.
    #[error("{size} bytes at {address:#x} are no mapping: unmap what was mapped as a whole")]
    NotMapped {
        /// First address of the range.
        address: u64,
        /// Number of bytes in the range.
        size: u64,
    },
    /// The system refuses the mapping.
    #[error("the memory at {address:#x} cannot be mapped: {source}: check offset and size of its file")]
    System {
        /// First address of the memory.
        address: u64,
        /// The reason that the system gives.
        source: vm_memory::mmap::MmapRegionError,
    },
}

/// An access to an address that is not mapped, or not mapped for this kind of access.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refused;

/// Memory of the host at the addresses of the card, with the accesses that the host allows.
#[derive(Debug)]
struct Mapping {
    address: u64,
    flags: DmaMapFlags,
    memory: MmapRegion,
}

impl Mapping {
    fn size(&self) -> u64 {
        self.memory.size() as u64
    }

    /// Number of bytes from the start of the mapping to `address`, if the address lies in the mapping.
    fn offset(&self, address: u64) -> Option<u64> {
        address.checked_sub(self.address).filter(|&offset| offset < self.size())
    }
}

/// All mappings of the card.
#[derive(Debug, Default)]
pub struct HostMemory {
    mappings: Vec<Mapping>,
}

impl HostMemory {
    /// Maps a piece of a file to these addresses.
    ///
    /// # Errors
    /// [`MapError`] says why not.
    pub fn map(
        &mut self,
        flags: DmaMapFlags,
        (address, size): (u64, u64),
        file: Option<File>,
        offset: u64,
    ) -> Result<(), MapError> {
        let no_range = MapError::Range { address, size };
        if size == 0 || address.checked_add(size).is_none() {
            return Err(no_range);
        }
        let length = usize::try_from(size).map_err(|_| no_range)?;
        if self.mappings.iter().any(|other| address < other.address + other.size() && other.address < address + size) {
            return Err(MapError::Overlaps { address, size });
        }
        let file = file.ok_or(MapError::NoFile(address))?;
        if !fcntl_get_seals(&file).is_ok_and(|seals| seals.contains(SealFlags::SHRINK)) {
            return Err(MapError::Shrinks(address));
        }
        let file_length = file.metadata().map_or(0, |data| data.len());
        if offset.checked_add(size).is_none_or(|end| end > file_length) {
            return Err(MapError::Short { address, length: file_length, size, offset });
        }
        let memory = MmapRegion::from_file(FileOffset::new(file, offset), length)
            .map_err(|source| MapError::System { address, source })?;
        self.mappings.push(Mapping { address, flags, memory });
        Ok(())
    }

    /// Unmaps a range that was mapped as a whole.
    ///
    /// # Errors
    /// [`MapError::NotMapped`] if the range is not a mapping.
    pub fn unmap(&mut self, (address, size): (u64, u64)) -> Result<(), MapError> {
        let place = self.mappings.iter().position(|mapping| (mapping.address, mapping.size()) == (address, size));
        self.mappings.swap_remove(place.ok_or(MapError::NotMapped { address, size })?);
        Ok(())
    }

    /// Unmaps all of the memory.
    pub fn clear(&mut self) {
        self.mappings.clear();
    }

    /// Reads from these addresses on.
    ///
    /// # Errors
    /// One of the addresses is not mapped for reading; `bytes` then holds what was read before it.
    pub fn read(&self, address: u64, bytes: &mut [u8]) -> Result<(), Refused> {
        let mut done = 0;
        while done < bytes.len() {
            let (mapping, offset, count) = self.piece(address, done, bytes.len(), DmaMapFlags::READ)?;
            let slice = mapping.get_slice(offset, count).map_err(|_| Refused)?;
            done += slice.copy_to(&mut bytes[done..done + count]);
        }
        Ok(())
    }

    /// Writes to these addresses on.
    ///
    /// # Errors
    /// One of the addresses is not mapped for writing; the bytes before it are written.
    pub fn write(&self, address: u64, bytes: &[u8]) -> Result<(), Refused> {
        let mut done = 0;
        while done < bytes.len() {
            let (mapping, offset, count) = self.piece(address, done, bytes.len(), DmaMapFlags::WRITE)?;
            mapping.get_slice(offset, count).map_err(|_| Refused)?.copy_from(&bytes[done..done + count]);
            done += count;
        }
        Ok(())
    }

    /// Finds the byte that lies `done` bytes behind `address`: its mapping, its offset there, and how many of `length`
    /// bytes the mapping holds from there on.
    fn piece(
        &self,
        address: u64,
        done: usize,
        length: usize,
        access: DmaMapFlags,
    ) -> Result<(&MmapRegion, usize, usize), Refused> {
        let at = address.checked_add(done as u64).ok_or(Refused)?;
        let mut allowed = self.mappings.iter().filter(|mapping| mapping.flags.contains(access));
        let found = allowed.find_map(|mapping| Some((mapping, mapping.offset(at)?)));
        let (mapping, offset) = found.ok_or(Refused)?;
        // The cast is safe: the offset is less than the size of the mapping, which is in memory.
        let offset = offset as usize;
        Ok((&mapping.memory, offset, (mapping.memory.size() - offset).min(length - done)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::shared_memory;
    use super::*;

    const PAGE: u64 = 4096;
    const BOTH: DmaMapFlags = DmaMapFlags::READ_WRITE;

    fn file(pages: u64) -> Option<File> {
        Some(shared_memory(pages * PAGE).unwrap())
    }

    #[test]
    fn accesses_go_through_neighbours_and_stop_at_what_is_not_mapped() {
        let mut memory = HostMemory::default();
        memory.map(BOTH, (0x10_000, PAGE), file(3), 2 * PAGE).unwrap();
        memory.map(BOTH, (0x10_000 + PAGE, PAGE), file(1), 0).unwrap();
        let bytes: Vec<u8> = (0..2 * PAGE).map(|place| (place % 251) as u8).collect();
        assert_eq!(memory.write(0x10_000, &bytes), Ok(()));
        let mut read = vec![0; bytes.len()];
        assert_eq!(memory.read(0x10_000, &mut read), Ok(()));
        assert_eq!(read, bytes);
        for (address, length) in [(0xffff, 1), (0xffff, 2), (0x12_000, 1), (0x11_fff, 2), (u64::MAX, 2), (0, 1)] {
            assert_eq!(memory.read(address, &mut vec![0; length]), Err(Refused), "{address:#x}");
            assert_eq!(memory.write(address, &vec![0; length]), Err(Refused), "{address:#x}");
        }
        memory.unmap((0x10_000, PAGE)).unwrap();
        assert_eq!(memory.read(0x10_000, &mut [0]), Err(Refused));
        assert_eq!(memory.read(0x11_000, &mut [0]), Ok(()));
        memory.clear();
        assert_eq!(memory.read(0x11_000, &mut [0]), Err(Refused));
    }

    #[test]
    fn memory_is_used_as_it_was_mapped_for() {
        let mut memory = HostMemory::default();
        memory.map(DmaMapFlags::READ, (0, PAGE), file(1), 0).unwrap();
        memory.map(DmaMapFlags::WRITE, (PAGE, PAGE), file(1), 0).unwrap();
        assert_eq!((memory.read(0, &mut [0]), memory.write(0, &[0])), (Ok(()), Err(Refused)));
        assert_eq!((memory.read(PAGE, &mut [0]), memory.write(PAGE, &[0])), (Err(Refused), Ok(())));
    }

    #[test]
    fn what_cannot_be_mapped_is_refused_with_a_reason() {
        let mut memory = HostMemory::default();
        memory.map(BOTH, (PAGE, PAGE), file(1), 0).unwrap();
        let unsealed = File::from(rustix::fs::memfd_create("test", rustix::fs::MemfdFlags::CLOEXEC).unwrap());
        unsealed.set_len(PAGE).unwrap();
        for ((address, size), file, offset, sentence) in [
            ((0, 0), file(1), 0, "0 bytes at 0x0 are no range"),
            ((u64::MAX, 2), file(1), 0, "are no range of addresses"),
            ((0, 2 * PAGE), file(2), 0, "overlap what is mapped"),
            ((2 * PAGE, PAGE), None, 0, "comes without a file"),
            ((2 * PAGE, PAGE), Some(unsealed), 0, "seal it"),
            ((2 * PAGE, PAGE), file(1), PAGE, "has 4096 bytes, less than 4096 from 4096 on"),
            ((2 * PAGE, PAGE), file(1), u64::MAX, "has 4096 bytes, less than 4096 from 18446744073709551615 on"),
            ((2 * PAGE, PAGE), file(2), 1, "cannot be mapped"),
        ] {
            let error = memory.map(BOTH, (address, size), file, offset).expect_err(sentence).to_string();
            assert!(error.contains(sentence), "{error}");
        }
        let error = memory.unmap((PAGE, 1)).expect_err("a part").to_string();
        assert!(error.contains("1 bytes at 0x1000 are no mapping"), "{error}");
    }
}
