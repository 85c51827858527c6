//! The errors of a socket that mean no more than a lost datagram.

use std::io::{self, ErrorKind};

/// Whether an error of a UDP socket stands for one datagram that is lost on its way, so that the socket can be used as
/// before: the network is away for a moment, or the system has no room for the datagram.
///
/// Both ends of the link may ask this of an error that sending or receiving reports.
pub fn is_lost_on_the_way(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::HostUnreachable | ErrorKind::NetworkUnreachable | ErrorKind::NetworkDown)
        // No room: ENOBUFS of Linux and of macOS, and its number on Windows.
        || matches!(error.raw_os_error(), Some(105 | 55 | 10_055))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_network_that_is_away_or_full_loses_a_datagram() {
        let kinds = [ErrorKind::HostUnreachable, ErrorKind::NetworkUnreachable, ErrorKind::NetworkDown];
        let numbers = [105, 55, 10_055].map(io::Error::from_raw_os_error);
        for error in kinds.map(io::Error::from).into_iter().chain(numbers) {
            assert!(is_lost_on_the_way(&error), "{error}");
        }
        for kind in [ErrorKind::InvalidInput, ErrorKind::ConnectionRefused, ErrorKind::WouldBlock] {
            assert!(!is_lost_on_the_way(&kind.into()), "{kind}");
        }
    }
}
