//! Waiting for a datagram, also for less than a tick of the system's clock.
//!
//! Linux rounds the timeout of a reading socket up to its ticks, so that a wait of 50 microseconds takes 4 to 8
//! milliseconds. `ppoll` waits as long as it is told.

use std::io;
use std::net::UdpSocket;
use std::time::Duration;

/// Waits until a datagram or an error of the socket can be read, or until the time is over. The socket does not block,
/// before and after.
///
/// # Errors
/// The system refuses to wait.
#[cfg(target_os = "linux")]
#[allow(unsafe_code)] // a system call that the standard library does not offer
pub(super) fn wait_readable(socket: &UdpSocket, wait: Duration) -> io::Result<()> {
    use std::os::fd::AsRawFd;

    let mut asked = libc::pollfd { fd: socket.as_raw_fd(), events: libc::POLLIN, revents: 0 };
    let seconds = libc::time_t::try_from(wait.as_secs()).unwrap_or(libc::time_t::MAX);
    // Below 10^9, so it fits a `c_long` of 32 bits, too.
    let nanoseconds = wait.subsec_nanos() as libc::c_long;
    let limit = libc::timespec { tv_sec: seconds, tv_nsec: nanoseconds };
    // SAFETY: both structures live until the call returns, the list has one entry, and no mask of signals is given.
    let result = unsafe { libc::ppoll(&raw mut asked, 1, &raw const limit, std::ptr::null()) };
    match io::Error::last_os_error() {
        error if result < 0 && error.kind() != io::ErrorKind::Interrupted => Err(error),
        _ => Ok(()),
    }
}

/// Waits until a datagram or an error of the socket can be read, or until the time is over. The socket does not block,
/// before and after.
///
/// # Errors
/// The system refuses to wait.
#[cfg(not(target_os = "linux"))]
pub(super) fn wait_readable(socket: &UdpSocket, wait: Duration) -> io::Result<()> {
    // A timeout of 0 would mean none.
    socket.set_read_timeout(Some(wait.max(Duration::from_micros(1))))?;
    socket.set_nonblocking(false)?;
    // What this finds, an error included, is found again by the call that reads it.
    let _ = socket.peek(&mut [0]);
    socket.set_nonblocking(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wait_ends_with_a_datagram_or_with_its_time_and_leaves_the_socket_as_it_was() {
        let socket = UdpSocket::bind("127.0.0.1:0").expect("a socket");
        socket.set_nonblocking(true).expect("a socket that does not block");
        wait_readable(&socket, Duration::from_micros(50)).expect("a wait");
        assert_eq!(socket.recv(&mut [0]).expect_err("nothing has come").kind(), io::ErrorKind::WouldBlock);
        socket.send_to(&[7], socket.local_addr().expect("an address")).expect("a datagram on its way");
        // An hour, so that only the datagram can end this wait.
        wait_readable(&socket, Duration::from_secs(3600)).expect("a wait");
        assert_eq!(socket.recv(&mut [0]).expect("the datagram"), 1);
    }
}
