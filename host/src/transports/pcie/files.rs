//! The three files of a card.

use std::io::{self, Read, Write};

/// The registers of a card, read and written a word at a time.
pub trait RegisterFile: Send {
    /// Reads the register at this byte offset.
    ///
    /// # Errors
    /// The error of the system.
    fn read(&mut self, offset: u32) -> io::Result<u32>;

    /// Writes the register at this byte offset.
    ///
    /// # Errors
    /// The error of the system.
    fn write(&mut self, offset: u32, value: u32) -> io::Result<()>;
}

/// The three files of a card: those of the driver, or anything that behaves as they do.
pub struct CardFiles {
    /// File for command beats. A call to write returns when the beats are with the card.
    pub commands: Box<dyn Write + Send>,
    /// File of answer beats. A call to read returns when all bytes asked for have come, or at the end of an answer.
    pub answers: Box<dyn Read + Send>,
    /// Registers of the card.
    pub registers: Box<dyn RegisterFile>,
}

#[cfg(unix)]
pub(super) use system::open;

#[cfg(unix)]
mod system {
    use std::fs::{File, OpenOptions, TryLockError};
    use std::io::{self, Read, Write};
    use std::os::unix::fs::FileExt;
    use std::path::Path;
    use std::sync::Arc;

    use crate::transports::pcie::address::{cards, CardAddress};
    use crate::transports::pcie::fault::CardFault;
    use crate::transports::pcie::files::{CardFiles, RegisterFile};

    /// Errors of the driver for a card that has left the bus, or was never there.
    const NO_CARD: [i32; 3] = [libc::ENODEV, libc::ENXIO, libc::EIO];

    /// A file of the card. The lock on the card ends with the last of its files, so a call that does not return
    /// keeps other programs away.
    struct Locked {
        file: File,
        _lock: Arc<File>,
    }

    impl Write for Locked {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.file.write(bytes)
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    impl Read for Locked {
        fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
            self.file.read(bytes)
        }
    }

    struct Registers(Arc<File>);

    impl RegisterFile for Registers {
        fn read(&mut self, offset: u32) -> io::Result<u32> {
            let mut word = [0; 4];
            self.0.read_exact_at(&mut word, u64::from(offset)).map_err(|error| match error.kind() {
                // No driver ends a file: this is an ordinary file, or one that was cut short.
                io::ErrorKind::UnexpectedEof => {
                    io::Error::new(error.kind(), "the file ends before this register, so it is not a card's")
                }
                _ => error,
            })?;
            Ok(u32::from_le_bytes(word))
        }

        fn write(&mut self, offset: u32, value: u32) -> io::Result<()> {
            self.0.write_all_at(&value.to_le_bytes(), u64::from(offset))
        }
    }

    /// Opens the three files of a card and locks the card.
    pub fn open(address: &CardAddress) -> Result<CardFiles, CardFault> {
        let mut choice = OpenOptions::new();
        let registers = open_file(address, &address.registers(), choice.read(true).write(true))?;
        registers.try_lock().map_err(|error| lock_fault(&address.registers(), error))?;
        let lock = Arc::new(registers);
        let commands = open_file(address, &address.commands(), OpenOptions::new().write(true))?;
        let answers = open_file(address, &address.answers(), OpenOptions::new().read(true))?;
        let locked = |file| Locked { file, _lock: Arc::clone(&lock) };
        Ok(CardFiles {
            commands: Box::new(locked(commands)),
            answers: Box::new(locked(answers)),
            registers: Box::new(Registers(lock)),
        })
    }

    fn open_file(address: &CardAddress, path: &Path, choice: &OpenOptions) -> Result<File, CardFault> {
        choice.open(path).map_err(|error| {
            let name = path.display().to_string();
            match (error.kind(), error.raw_os_error()) {
                (io::ErrorKind::NotFound, _) if !address.is_of_the_system() => {
                    CardFault::MissingInDirectory { path: name }
                }
                (io::ErrorKind::NotFound, _) => CardFault::Missing {
                    path: name,
                    cards: cards().into_iter().map(|card| card.address.to_string()).collect(),
                },
                (io::ErrorKind::PermissionDenied, _) => CardFault::NoPermission { path: name },
                (io::ErrorKind::ResourceBusy, _) => CardFault::Busy { path: name },
                (_, Some(errno)) if NO_CARD.contains(&errno) => {
                    CardFault::NoCard { path: name, reason: error.to_string() }
                }
                _ => CardFault::Other { path: name, reason: error.to_string() },
            }
        })
    }

    fn lock_fault(path: &Path, error: TryLockError) -> CardFault {
        let path = path.display().to_string();
        match error {
            TryLockError::WouldBlock => CardFault::Busy { path },
            TryLockError::Error(error) => CardFault::Other { path, reason: error.to_string() },
        }
    }
}

/// Refuses to open any card, since the driver only exists on Linux.
#[cfg(not(unix))]
pub(super) fn open(address: &super::address::CardAddress) -> Result<CardFiles, super::fault::CardFault> {
    let path = address.registers().display().to_string();
    Err(super::fault::CardFault::Other { path, reason: "the driver XDMA only exists on Linux".to_owned() })
}
