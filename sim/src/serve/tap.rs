//! A TAP device of Linux: a network interface whose cable ends in this program. What the kernel sends through the
//! interface is read here as Ethernet frames, and frames that are written here come to the kernel.

use std::io;
use std::os::fd::{AsFd, OwnedFd};
use std::time::Duration;

use rustix::event::{poll, PollFd, PollFlags, Timespec};
use rustix::fs::{open, Mode, OFlags};
use rustix::io::Errno;
use rustix::ioctl::{ioctl, opcode, Opcode, Updater};

/// File that makes or opens TAP devices.
const FILE: &str = "/dev/net/tun";
/// The call that attaches an open [`FILE`] to an interface.
const TUNSETIFF: Opcode = opcode::write::<i32>(b'T', 202);
/// Flags of that call: an interface of Ethernet frames, without words in front of them.
const IFF_TAP: u16 = 0x0002;
const IFF_NO_PI: u16 = 0x1000;
/// Bytes of an interface's name in the call, with a final 0; and of the whole argument, `struct ifreq`.
const NAME_BYTES: usize = 16;
const REQUEST_BYTES: usize = 40;
/// Bytes of the longest frame that is read; the kernel cuts longer ones.
const LONGEST: usize = 2048;

/// An open TAP device.
#[derive(Debug)]
pub(super) struct Tap {
    file: OwnedFd,
}

impl Tap {
    /// Opens the TAP device of this name. The kernel makes it if there is none and the program may make it.
    pub(super) fn open(name: &str) -> io::Result<Self> {
        if name.is_empty() || name.len() >= NAME_BYTES {
            return Err(io::Error::other(format!("a name has 1 to {} letters", NAME_BYTES - 1)));
        }
        let file = open(FILE, OFlags::RDWR | OFlags::NONBLOCK | OFlags::CLOEXEC, Mode::empty())?;
        let mut request = [0; REQUEST_BYTES];
        request[..name.len()].copy_from_slice(name.as_bytes());
        request[NAME_BYTES..NAME_BYTES + 2].copy_from_slice(&(IFF_TAP | IFF_NO_PI).to_ne_bytes());
        attach(&file, &mut request)?;
        Ok(Self { file })
    }

    /// Reads the next frame that the kernel has sent, without check sum; `None` if there is none.
    pub(super) fn read(&self) -> io::Result<Option<Vec<u8>>> {
        let mut frame = vec![0; LONGEST];
        match rustix::io::read(&self.file, &mut frame[..]) {
            Ok(length) => {
                frame.truncate(length);
                Ok(Some(frame))
            }
            Err(Errno::AGAIN | Errno::INTR) => Ok(None),
            Err(error) => Err(error.into()),
        }
    }

    /// Gives the kernel a frame. It is lost if the interface is down or its queue is full, as on a cable.
    pub(super) fn write(&self, frame: &[u8]) -> io::Result<()> {
        match rustix::io::write(&self.file, frame) {
            Ok(_) | Err(Errno::AGAIN | Errno::INTR | Errno::IO) => Ok(()),
            Err(error) => Err(error.into()),
        }
    }

    /// Sleeps until the kernel sends a frame, but no longer than `time`.
    pub(super) fn wait(&self, time: Duration) -> io::Result<()> {
        let mut ends = [PollFd::from_borrowed_fd(self.file.as_fd(), PollFlags::IN)];
        let timeout = Timespec { tv_sec: time.as_secs() as i64, tv_nsec: i64::from(time.subsec_nanos()) };
        match poll(&mut ends, Some(&timeout)) {
            Ok(_) | Err(Errno::INTR) => Ok(()),
            Err(error) => Err(error.into()),
        }
    }
}

#[allow(unsafe_code)] // a system call that no safe library offers
fn attach(file: &OwnedFd, request: &mut [u8; REQUEST_BYTES]) -> io::Result<()> {
    // SAFETY: the kernel reads and writes one `struct ifreq` at the address, which has at most as many bytes as
    // `request` on every system, and keeps no pointer to it.
    unsafe { ioctl(file, Updater::<TUNSETIFF, _>::new(request)) }?;
    Ok(())
}
