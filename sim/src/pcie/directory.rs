//! A directory with the three files of a card: a file system in user space.

use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc::{channel, Receiver, Sender};
use std::sync::Arc;
use std::time::{Duration, UNIX_EPOCH};

use fuser::{
    BackgroundSession, Config, FileAttr, FileHandle, FileType, Filesystem, FopenFlags, Generation, INodeNo, LockOwner,
    MountOption, OpenFlags, ReplyAttr, ReplyData, ReplyDirectory, ReplyEmpty, ReplyEntry, ReplyOpen, ReplyWrite,
    Request, WriteFlags,
};
use rustix::mount::UnmountFlags;

use super::card::{Card, Errno};

/// Names of the files, in the order of their inodes from [`FIRST`] on.
const NAMES: [&str; 3] = ["xdma0_h2c_0", "xdma0_c2h_0", "xdma0_user"];
const FIRST: u64 = 2;
const COMMANDS: u64 = FIRST;
const ANSWERS: u64 = FIRST + 1;
const REGISTERS: u64 = FIRST + 2;
/// The time for which the system may cache names and attributes, which never change.
const TIME_TO_LIVE: Duration = Duration::from_secs(1);
/// Largest error number that FUSE carries.
const MOST_ERRNO: i32 = 511;
/// Error number of the system for a directory whose file system has died.
const NOT_CONNECTED: i32 = 107;
/// The device through which the system opens file systems in user space.
const FUSE_DEVICE: &str = "/dev/fuse";
/// Number of bytes of a register.
const WORD: u32 = 4;

/// The reason why there is no directory with a card.
#[derive(Debug, thiserror::Error)]
pub enum DirectoryError {
    /// The system has no FUSE.
    #[error(
        "there is no {FUSE_DEVICE}: load the kernel module 'fuse' (for a container, pass the device in), and \
         install fuse3"
    )]
    NoFuse,
    /// The path is not an empty directory.
    #[error("{path} cannot be used: {source}: name an empty directory", path = .path.display())]
    Directory {
        /// The path that was asked for.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// The directory cannot be mounted.
    #[error("{path} cannot be mounted: {source}: run as root, or install fuse3", path = .path.display())]
    Mount {
        /// The path that was asked for.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
}

/// A card whose files are in a mounted directory until this value is dropped.
pub struct CardDirectory {
    path: PathBuf,
    card: Arc<Card>,
    session: Option<BackgroundSession>,
}

impl CardDirectory {
    /// Mounts the card at a directory, which is made if it does not exist. A mount that a killed service
    /// left behind is replaced.
    ///
    /// # Errors
    /// The system has no FUSE, or the directory cannot be used.
    pub fn mount(path: &Path, card: Arc<Card>) -> Result<Self, DirectoryError> {
        if !Path::new(FUSE_DEVICE).exists() {
            return Err(DirectoryError::NoFuse);
        }
        if std::fs::metadata(path).is_err_and(|error| error.raw_os_error() == Some(NOT_CONNECTED)) {
            unmount(path);
        }
        let unusable = |source| DirectoryError::Directory { path: path.to_owned(), source };
        std::fs::create_dir_all(path).map_err(unusable)?;
        let is_empty = std::fs::read_dir(path).map_err(unusable)?.next().is_none();
        if !is_empty {
            return Err(unusable(io::Error::new(io::ErrorKind::DirectoryNotEmpty, "it is not empty")));
        }
        let mut config = Config::default();
        config.mount_options = vec![MountOption::FSName("incircle".to_owned()), MountOption::NoExec];
        let session = fuser::spawn_mount(Files::new(Arc::clone(&card)), path, &config)
            .map_err(|source| DirectoryError::Mount { path: path.to_owned(), source })?;
        Ok(Self { path: path.to_owned(), card, session: Some(session) })
    }
}

impl Drop for CardDirectory {
    /// Ends all calls, then unmounts, even if a driver still has files open.
    fn drop(&mut self) {
        self.card.close();
        unmount(&self.path);
        drop(self.session.take());
    }
}

/// Takes the file system out of the tree. The file system itself ends with the last open file.
fn unmount(path: &Path) {
    if rustix::mount::unmount(path, UnmountFlags::DETACH).is_ok() {
        return;
    }
    // Only root may unmount directly; others may through this program. If it fails too, there is nothing left to try.
    let mut command = Command::new("fusermount3");
    command.args(["-u", "-z", "--"]).arg(path).stdout(Stdio::null()).stderr(Stdio::null());
    let _ = command.status();
}

/// A transfer that a call waits for: the bytes or the size, and the place for the reply.
type Writing = (Vec<u8>, ReplyWrite);
type Reading = (usize, ReplyData);

/// The file system. The streams block, so each has a thread of its own.
struct Files {
    card: Arc<Card>,
    writings: Sender<Writing>,
    readings: Sender<Reading>,
    owner: (u32, u32),
}

impl Files {
    fn new(card: Arc<Card>) -> Self {
        let (writings, to_write) = channel();
        let (readings, to_read) = channel();
        let (writer, reader) = (Arc::clone(&card), Arc::clone(&card));
        std::thread::spawn(move || write_all(&writer, &to_write));
        std::thread::spawn(move || read_all(&reader, &to_read));
        let owner = (rustix::process::getuid().as_raw(), rustix::process::getgid().as_raw());
        Self { card, writings, readings, owner }
    }

    fn attributes(&self, inode: u64) -> Option<FileAttr> {
        let (kind, perm) = match inode {
            1 => (FileType::Directory, 0o700),
            COMMANDS => (FileType::RegularFile, 0o200),
            ANSWERS => (FileType::RegularFile, 0o400),
            REGISTERS => (FileType::RegularFile, 0o600),
            _ => return None,
        };
        Some(FileAttr {
            ino: INodeNo(inode),
            size: 0,
            blocks: 0,
            atime: UNIX_EPOCH,
            mtime: UNIX_EPOCH,
            ctime: UNIX_EPOCH,
            crtime: UNIX_EPOCH,
            kind,
            perm,
            nlink: 1,
            uid: self.owner.0,
            gid: self.owner.1,
            rdev: 0,
            blksize: 4096,
            flags: 0,
        })
    }
}

fn write_all(card: &Card, writings: &Receiver<Writing>) {
    while let Ok((bytes, reply)) = writings.recv() {
        match card.write(&bytes) {
            Ok(written) => reply.written(u32::try_from(written).unwrap_or(u32::MAX)),
            Err(errno) => reply.error(passing(errno)),
        }
    }
}

fn read_all(card: &Card, readings: &Receiver<Reading>) {
    let mut bytes = Vec::new();
    while let Ok((size, reply)) = readings.recv() {
        bytes.resize(size, 0);
        match card.read(&mut bytes) {
            Ok(read) => reply.data(&bytes[..read]),
            Err(errno) => reply.error(passing(errno)),
        }
    }
}

/// An error as FUSE can carry it.
fn passing(errno: Errno) -> fuser::Errno {
    fuser::Errno::from_i32(if errno.0 > MOST_ERRNO { Errno::IO.0 } else { errno.0 })
}

impl Filesystem for Files {
    fn lookup(&self, _: &Request, parent: INodeNo, name: &OsStr, reply: ReplyEntry) {
        let place = NAMES.iter().position(|known| name == *known).filter(|_| parent == INodeNo::ROOT);
        match place.and_then(|place| self.attributes(FIRST + place as u64)) {
            Some(attributes) => reply.entry(&TIME_TO_LIVE, &attributes, Generation(0)),
            None => reply.error(fuser::Errno::ENOENT),
        }
    }

    fn getattr(&self, _: &Request, inode: INodeNo, _: Option<FileHandle>, reply: ReplyAttr) {
        match self.attributes(inode.0) {
            Some(attributes) => reply.attr(&TIME_TO_LIVE, &attributes),
            None => reply.error(fuser::Errno::ENOENT),
        }
    }

    fn readdir(&self, _: &Request, _: INodeNo, _: FileHandle, offset: u64, mut reply: ReplyDirectory) {
        let files = NAMES.iter().enumerate().map(|(place, name)| (FIRST + place as u64, FileType::RegularFile, *name));
        let all = [(1, FileType::Directory, "."), (1, FileType::Directory, "..")].into_iter().chain(files);
        for (place, (inode, kind, name)) in (1..).zip(all).skip(usize::try_from(offset).unwrap_or(usize::MAX)) {
            if reply.add(INodeNo(inode), place, kind, name) {
                break;
            }
        }
        reply.ok();
    }

    fn open(&self, _: &Request, _: INodeNo, _: OpenFlags, reply: ReplyOpen) {
        // With direct input and output every call of a program reaches the card unchanged. Without a flush, closing
        // waits for nothing, since a program that serves its own files may end meanwhile.
        reply.opened(FileHandle(0), FopenFlags::FOPEN_DIRECT_IO | FopenFlags::FOPEN_NOFLUSH);
    }

    fn read(
        &self,
        _: &Request,
        inode: INodeNo,
        _: FileHandle,
        offset: u64,
        size: u32,
        _: OpenFlags,
        _: Option<LockOwner>,
        reply: ReplyData,
    ) {
        match inode.0 {
            // Sending fails only if the thread has ended, and then the card is gone as well.
            ANSWERS => drop(self.readings.send((size as usize, reply))),
            REGISTERS if size == WORD => match u32::try_from(offset).map_err(|_| Errno::INVALID) {
                Ok(offset) => match self.card.read_register(offset) {
                    Ok(value) => reply.data(&value.to_le_bytes()),
                    Err(errno) => reply.error(passing(errno)),
                },
                Err(errno) => reply.error(passing(errno)),
            },
            _ => reply.error(fuser::Errno::EINVAL),
        }
    }

    fn write(
        &self,
        _: &Request,
        inode: INodeNo,
        _: FileHandle,
        offset: u64,
        data: &[u8],
        _: WriteFlags,
        _: OpenFlags,
        _: Option<LockOwner>,
        reply: ReplyWrite,
    ) {
        let register = (u32::try_from(offset).ok(), data.try_into().ok().map(u32::from_le_bytes));
        match (inode.0, register) {
            (COMMANDS, _) => drop(self.writings.send((data.to_vec(), reply))),
            (REGISTERS, (Some(offset), Some(value))) => match self.card.write_register(offset, value) {
                Ok(()) => reply.written(WORD),
                Err(errno) => reply.error(passing(errno)),
            },
            _ => reply.error(fuser::Errno::EINVAL),
        }
    }

    fn flush(&self, _: &Request, _: INodeNo, _: FileHandle, _: LockOwner, reply: ReplyEmpty) {
        reply.ok();
    }
}
