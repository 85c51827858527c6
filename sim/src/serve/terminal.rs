//! A pseudo-terminal behind a symbolic link: the serial port that a host opens.

use std::fs;
use std::io;
use std::os::fd::{AsFd, OwnedFd};
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::time::Duration;

use rustix::event::{poll, PollFd, PollFlags, Timespec};
use rustix::fs::{fcntl_setfl, open, Mode, OFlags};
use rustix::io::Errno;
use rustix::pty::{grantpt, openpt, ptsname, unlockpt, OpenptFlags};
use rustix::termios::{tcgetattr, tcsetattr, OptionalActions};

/// Folder of the system's pseudo-terminals.
const TERMINALS: &str = "/dev/pts/";
/// Time between two checks whether a host has opened the terminal.
const LOOK: Duration = Duration::from_millis(10);

/// The reason why there is no terminal at the link.
#[derive(Debug, thiserror::Error)]
pub enum LinkError {
    /// The path exists and does not belong to a service.
    #[error("{path} exists and {what}: choose another path, or remove it", path = .path.display())]
    Exists {
        /// The path that was asked for.
        path: PathBuf,
        /// Description of the obstacle.
        what: &'static str,
    },
    /// The symbolic link cannot be created.
    #[error("cannot make the symbolic link {path}: {source}", path = .path.display())]
    Link {
        /// The path that was asked for.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// The system refuses a terminal, or closes it.
    #[error("the pseudo-terminal failed: {0}")]
    Terminal(#[from] io::Error),
}

/// The board's end of a pseudo-terminal. Hosts open the other end, through the link.
#[derive(Debug)]
pub(super) struct Terminal {
    /// The open end; `None` after `close`.
    master: Option<OwnedFd>,
    link: PathBuf,
    target: PathBuf,
}

impl Terminal {
    /// Opens a terminal and makes the link to it. A link that an earlier service left behind is replaced.
    pub(super) fn new(link: &Path) -> Result<Self, LinkError> {
        let failed = |error: Errno| LinkError::Terminal(error.into());
        let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC).map_err(failed)?;
        grantpt(&master).map_err(failed)?;
        unlockpt(&master).map_err(failed)?;
        let name = ptsname(&master, Vec::new()).map_err(failed)?;
        let target = PathBuf::from(name.to_string_lossy().into_owned());
        // In its first settings a terminal echoes every byte until a host changes that.
        let other = open(&target, OFlags::RDWR | OFlags::NOCTTY | OFlags::CLOEXEC, Mode::empty()).map_err(failed)?;
        let mut settings = tcgetattr(&other).map_err(failed)?;
        settings.make_raw();
        settings.set_speed(incircle_protocol::FIRST_RATE).map_err(failed)?;
        tcsetattr(&other, OptionalActions::Now, &settings).map_err(failed)?;
        fcntl_setfl(&master, OFlags::NONBLOCK).map_err(failed)?;
        make_link(link, &target)?;
        Ok(Self { master: Some(master), link: link.to_owned(), target })
    }

    /// Closes the board's end, which hosts notice, and removes the link.
    pub(super) fn close(&mut self) {
        if self.master.take().is_some() && fs::read_link(&self.link).is_ok_and(|target| target == self.target) {
            // A link that cannot be removed leads nowhere. The next service recognises such a link and replaces it.
            let _ = fs::remove_file(&self.link);
        }
    }

    /// Reads bytes of a host, and returns their number.
    pub(super) fn read(&self, buffer: &mut [u8]) -> io::Result<usize> {
        let Some(master) = &self.master else {
            return Ok(0);
        };
        match rustix::io::read(master, buffer) {
            Ok(length) => Ok(length),
            // No byte is there, or no host has the terminal open.
            Err(Errno::AGAIN | Errno::INTR | Errno::IO) => Ok(0),
            Err(error) => Err(error.into()),
        }
    }

    /// Writes bytes for a host, and returns how many the caller may forget. All bytes are lost if no host
    /// has the terminal open.
    pub(super) fn write(&self, bytes: &[u8]) -> io::Result<usize> {
        let Some(master) = &self.master else {
            return Ok(bytes.len());
        };
        if self.is_open_elsewhere(master) == Some(false) {
            return Ok(bytes.len());
        }
        match rustix::io::write(master, bytes) {
            Ok(length) => Ok(length),
            Err(Errno::AGAIN | Errno::INTR) => Ok(0),
            Err(Errno::IO) => Ok(bytes.len()),
            Err(error) => Err(error.into()),
        }
    }

    /// Bits per second that the host has set.
    pub(super) fn rate(&self) -> io::Result<u32> {
        match &self.master {
            Some(master) => Ok(tcgetattr(master)?.output_speed()),
            None => Ok(incircle_protocol::FIRST_RATE),
        }
    }

    /// Whether a host has the terminal open; `None` if the system does not say.
    fn is_open_elsewhere(&self, master: &OwnedFd) -> Option<bool> {
        let mut ends = [PollFd::new(master, PollFlags::IN)];
        poll(&mut ends, Some(&Timespec::default())).ok()?;
        Some(!ends[0].revents().contains(PollFlags::HUP))
    }

    /// Sleeps until a host sends something, but no longer than `time`.
    pub(super) fn wait(&self, time: Duration) -> io::Result<()> {
        let Some(master) = &self.master else {
            std::thread::sleep(time);
            return Ok(());
        };
        // While no host has the terminal open, `poll` returns at once, so the wait is a sleep.
        if self.is_open_elsewhere(master) == Some(false) {
            std::thread::sleep(time.min(LOOK));
            return Ok(());
        }
        let mut ends = [PollFd::from_borrowed_fd(master.as_fd(), PollFlags::IN)];
        let timeout = Timespec { tv_sec: time.as_secs() as i64, tv_nsec: i64::from(time.subsec_nanos()) };
        match poll(&mut ends, Some(&timeout)) {
            Ok(_) | Err(Errno::INTR) => Ok(()),
            Err(error) => Err(error.into()),
        }
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        self.close();
    }
}

/// Makes the link. A link to a terminal that no longer exists is replaced.
fn make_link(link: &Path, target: &Path) -> Result<(), LinkError> {
    let exists = |what| LinkError::Exists { path: link.to_owned(), what };
    let failed = |source| LinkError::Link { path: link.to_owned(), source };
    if let Ok(found) = fs::symlink_metadata(link) {
        if !found.is_symlink() {
            return Err(exists("is not a symbolic link"));
        }
        let old = fs::read_link(link).map_err(failed)?;
        if !old.starts_with(TERMINALS) {
            return Err(exists("does not lead to a pseudo-terminal"));
        }
        // The system may have given the number of the old terminal to the new one.
        if old.exists() && old != target {
            return Err(exists("leads to a pseudo-terminal that is in use"));
        }
        fs::remove_file(link).map_err(failed)?;
    }
    symlink(target, link).map_err(failed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Read, Write};

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("incircle-terminal-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn bytes_pass_as_they_are_and_the_rate_is_seen() {
        let folder = folder("bytes");
        let link = folder.join("board");
        let terminal = Terminal::new(&link).unwrap();
        let mut buffer = [0; 300];
        assert_eq!(terminal.read(&mut buffer).unwrap(), 0);
        assert_eq!(terminal.write(&[1, 2, 3]).unwrap(), 3);
        let all: Vec<u8> = (0..=255).collect();
        let mut host = fs::OpenOptions::new().read(true).write(true).open(&link).unwrap();
        host.write_all(&all).unwrap();
        terminal.wait(Duration::from_secs(5)).unwrap();
        assert_eq!(terminal.read(&mut buffer).unwrap(), 256);
        assert_eq!(buffer[..256], all);
        assert_eq!(terminal.write(&all).unwrap(), 256);
        let mut came = [0; 256];
        host.read_exact(&mut came).unwrap();
        assert_eq!(came.to_vec(), all);
        for rate in [115_200, 3_000_000, 12_000_000, 123_456] {
            let mut settings = tcgetattr(&host).unwrap();
            settings.set_speed(rate).unwrap();
            tcsetattr(&host, OptionalActions::Now, &settings).unwrap();
            assert_eq!(terminal.rate().unwrap(), rate);
        }
        drop(host);
        assert_eq!(terminal.write(&all).unwrap(), 256);
        assert_eq!(terminal.read(&mut buffer).unwrap(), 0);
        drop(terminal);
        assert!(fs::symlink_metadata(&link).is_err());
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_pulled_cable_is_seen_by_the_host() {
        let folder = folder("cable");
        let link = folder.join("board");
        let mut terminal = Terminal::new(&link).unwrap();
        let mut host = fs::OpenOptions::new().read(true).write(true).open(&link).unwrap();
        terminal.close();
        assert!(!matches!(host.read(&mut [0; 4]), Ok(1..)));
        assert!(host.write(&[1]).is_err());
        assert!(fs::symlink_metadata(&link).is_err());
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn only_a_stale_link_is_replaced() {
        let folder = folder("links");
        let link = folder.join("board");
        let terminal = Terminal::new(&link).unwrap();
        let error = Terminal::new(&link).unwrap_err().to_string();
        assert!(error.contains("leads to a pseudo-terminal that is in use"), "{error}");
        drop(terminal);
        symlink("/dev/pts/987654", &link).unwrap();
        drop(Terminal::new(&link).unwrap());
        symlink("/etc/hostname", &link).unwrap();
        let error = Terminal::new(&link).unwrap_err().to_string();
        assert!(error.contains("does not lead to a pseudo-terminal"), "{error}");
        fs::remove_file(&link).unwrap();
        fs::write(&link, "mine").unwrap();
        let error = Terminal::new(&link).unwrap_err().to_string();
        assert!(error.contains("is not a symbolic link"), "{error}");
        assert_eq!(fs::read_to_string(&link).unwrap(), "mine");
        let error = Terminal::new(&folder.join("no/where")).unwrap_err().to_string();
        assert!(error.contains("cannot make the symbolic link"), "{error}");
        fs::remove_dir_all(folder).unwrap();
    }
}
