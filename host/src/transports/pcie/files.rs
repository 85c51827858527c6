//! The three files of a card.

use std::io::{self, Read, Write};

/// The registers of a card, a word at a time.
pub trait RegisterFile: Send {
    /// Reads the register at this byte offset.
    ///
    /// # Errors
    /// What the system says.
    fn read(&mut self, offset: u32) -> io::Result<u32>;

    /// Writes it.
    ///
    /// # Errors
    /// What the system says.
    fn write(&mut self, offset: u32, value: u32) -> io::Result<()>;
}

/// What a card is made of, for its driver: files of the system, or anything that does as they do.
pub struct CardFiles {
    /// Takes command beats; a call returns when they are with the card.
    pub commands: Box<dyn Write + Send>,
    /// Gives answer beats; a call returns when all that was asked for has come, or the end of an answer.
    pub answers: Box<dyn Read + Send>,
    /// The registers.
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

    /// The driver answers so for a card that has left the bus, or was never there.
    const NO_CARD: [i32; 3] = [libc::ENODEV, libc::ENXIO, libc::EIO];

    /// A file of the card. The lock on the card ends with the last of them, so a call that does not return keeps others
    /// away.
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
                // An ordinary file, or one cut short: no driver does so.
                io::ErrorKind::UnexpectedEof => {
                    io::Error::new(error.kind(), "the file ends before it, so it is no card's")
                }
                _ => error,
            })?;
            Ok(u32::from_le_bytes(word))
        }

        fn write(&mut self, offset: u32, value: u32) -> io::Result<()> {
            self.0.write_all_at(&value.to_le_bytes(), u64::from(offset))
        }
    }

    /// Opens the files of a card, and locks it.
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

/// The driver is one of Linux.
#[cfg(not(unix))]
pub(super) fn open(address: &super::address::CardAddress) -> Result<CardFiles, super::fault::CardFault> {
    let path = address.registers().display().to_string();
    Err(super::fault::CardFault::Other { path, reason: "the driver XDMA is one of Linux".to_owned() })
}
