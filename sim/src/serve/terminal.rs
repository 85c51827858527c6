//! A pseudo-terminal behind a symbolic link.

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

/// Where terminals of the system are.
const TERMINALS: &str = "/dev/pts/";
/// Between two looks whether somebody has opened the terminal.
const LOOK: Duration = Duration::from_millis(10);

/// Why there is no terminal at the link.
#[derive(Debug, thiserror::Error)]
pub enum LinkError {
    /// Something is there that is not ours.
    #[error("{path} exists and {what}: choose another path, or remove it", path = .path.display())]
    Exists {
        /// The path.
        path: PathBuf,
        /// What it is.
        what: &'static str,
    },
    /// The link cannot be made.
    #[error("{path} cannot be made: {source}", path = .path.display())]
    Link {
        /// The path.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The system gives no terminal, or ends it.
    #[error("the pseudo-terminal does not work: {0}")]
    Terminal(#[from] io::Error),
}

/// The board's end of a pseudo-terminal. Hosts open the other end, through the link.
#[derive(Debug)]
pub(super) struct Terminal {
    /// Nothing once it is closed.
    master: Option<OwnedFd>,
    link: PathBuf,
    target: PathBuf,
}

impl Terminal {
    /// A terminal at this link. A link that a service left behind is replaced.
    pub(super) fn new(link: &Path) -> Result<Self, LinkError> {
        let failed = |error: Errno| LinkError::Terminal(error.into());
        let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC).map_err(failed)?;
        grantpt(&master).map_err(failed)?;
        unlockpt(&master).map_err(failed)?;
        let name = ptsname(&master, Vec::new()).map_err(failed)?;
        let target = PathBuf::from(name.to_string_lossy().into_owned());
        // Without this the terminal would send every byte back until a host sets it up.
        let other = open(&target, OFlags::RDWR | OFlags::NOCTTY | OFlags::CLOEXEC, Mode::empty()).map_err(failed)?;
        let mut settings = tcgetattr(&other).map_err(failed)?;
        settings.make_raw();
        settings.set_speed(incircle_protocol::FIRST_RATE).map_err(failed)?;
        tcsetattr(&other, OptionalActions::Now, &settings).map_err(failed)?;
        fcntl_setfl(&master, OFlags::NONBLOCK).map_err(failed)?;
        make_link(link, &target)?;
        Ok(Self { master: Some(master), link: link.to_owned(), target })
    }

    /// The end is closed, and hosts see it; the link goes as well.
    pub(super) fn close(&mut self) {
        if self.master.take().is_some() && fs::read_link(&self.link).is_ok_and(|target| target == self.target) {
            // If it cannot be removed it leads nowhere, which the next service understands.
            let _ = fs::remove_file(&self.link);
        }
    }

    /// Bytes of a host, if there are any.
    pub(super) fn read(&self, buffer: &mut [u8]) -> io::Result<usize> {
        let Some(master) = &self.master else {
            return Ok(0);
        };
        match rustix::io::read(master, buffer) {
            Ok(length) => Ok(length),
            // Nothing now, or nobody has it open.
            Err(Errno::AGAIN | Errno::INTR | Errno::IO) => Ok(0),
            Err(error) => Err(error.into()),
        }
    }

    /// Bytes for a host: how many are gone. If nobody has it open, all are.
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

    /// Whether a host has it open; unknown if the system does not say.
    fn is_open_elsewhere(&self, master: &OwnedFd) -> Option<bool> {
        let mut ends = [PollFd::new(master, PollFlags::IN)];
        poll(&mut ends, Some(&Timespec::default())).ok()?;
        Some(!ends[0].revents().contains(PollFlags::HUP))
    }

    /// Sleeps until a host sends something, but not longer than this.
    pub(super) fn wait(&self, time: Duration) -> io::Result<()> {
        let Some(master) = &self.master else {
            std::thread::sleep(time);
            return Ok(());
        };
        // While nobody has it open the system does not wait, so this does.
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

/// Makes the link, in the place of one that leads to a terminal that is no more.
fn make_link(link: &Path, target: &Path) -> Result<(), LinkError> {
    let exists = |what| LinkError::Exists { path: link.to_owned(), what };
    let failed = |source| LinkError::Link { path: link.to_owned(), source };
    if let Ok(found) = fs::symlink_metadata(link) {
        if !found.is_symlink() {
            return Err(exists("is no symbolic link"));
        }
        let old = fs::read_link(link).map_err(failed)?;
        if !old.starts_with(TERMINALS) {
            return Err(exists("leads elsewhere than to a pseudo-terminal"));
        }
        // The number may have been given to ours since.
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
        assert!(error.contains("leads elsewhere"), "{error}");
        fs::remove_file(&link).unwrap();
        fs::write(&link, "mine").unwrap();
        let error = Terminal::new(&link).unwrap_err().to_string();
        assert!(error.contains("is no symbolic link"), "{error}");
        assert_eq!(fs::read_to_string(&link).unwrap(), "mine");
        let error = Terminal::new(&folder.join("no/where")).unwrap_err().to_string();
        assert!(error.contains("cannot be made"), "{error}");
        fs::remove_dir_all(folder).unwrap();
    }
}
