//! A board at a TAP device: the kernel of this machine, with its own ARP, ICMP and UDP, is the other end of its cable.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::tap::Tap;
use crate::error::SimError;
use crate::network::NetworkBoard;

/// Most frames that are taken before the board runs.
const BURST: u64 = 64;
/// Nanoseconds of the board's time between two looks at the kernel: about as long as a long frame takes on the wire.
const SLICE_NS: u64 = 16_000;
/// Longest sleep. A signal to end may have to wait this long.
const NAP: Duration = Duration::from_millis(50);

/// The figures of a service that has ended.
#[derive(Clone, Copy, Debug, Default)]
pub struct TapFigures {
    /// Number of frames from the kernel to the board.
    pub to_device: u64,
    /// Number of frames from the board to the kernel.
    pub to_host: u64,
}

/// The reason why a board cannot be served at a TAP device.
#[derive(Debug, thiserror::Error)]
pub enum TapError {
    /// The system refuses the TAP device.
    #[error(
        "the system refuses the TAP device \"{name}\" ({source}): make it with `ip tuntap add dev NAME mode tap`, \
         which needs root, with `user NAME` behind it for another user, and end other programs that use it"
    )]
    Open {
        /// Name of the interface.
        name: String,
        /// Error of the system.
        source: io::Error,
    },
    /// The TAP device fails while it is open.
    #[error("the TAP device fails: {0}")]
    Io(#[from] io::Error),
    /// The board cannot be simulated.
    #[error("{0}")]
    Board(#[from] SimError),
}

/// Serves a board at the TAP device `name` until `stops` is set, and calls `ready` as soon as the board takes frames.
/// `board` makes the board once the TAP device is open. While nothing passes the cable and no session is open, the
/// simulation stands still.
///
/// # Errors
/// [`TapError`]: the system refuses the TAP device or takes it away, or the board is not part of this build.
pub fn serve_tap(
    name: &str,
    board: impl FnOnce() -> Result<NetworkBoard, SimError>,
    stops: &AtomicBool,
    ready: impl FnOnce(),
) -> Result<TapFigures, TapError> {
    let tap = Tap::open(name).map_err(|source| TapError::Open { name: name.to_owned(), source })?;
    let mut board = board()?;
    let mut figures = TapFigures::default();
    ready();
    while !stops.load(Ordering::Relaxed) {
        figures.to_device += fill(&mut board, || tap.read())?;
        if board.is_at_rest() {
            tap.wait(NAP)?;
            continue;
        }
        board.run(SLICE_NS);
        while let Some(frame) = board.receive_frame() {
            figures.to_host += 1;
            tap.write(&frame)?;
        }
    }
    Ok(figures)
}

/// Puts frames on the cable of the board, as many as there are and as it has room for, and returns their number. The
/// others wait in the kernel, which drops those that its queue cannot hold.
fn fill(board: &mut NetworkBoard, mut read: impl FnMut() -> io::Result<Option<Vec<u8>>>) -> io::Result<u64> {
    let mut taken = 0;
    while taken < BURST && board.has_room() {
        let Some(frame) = read()? else { break };
        board.send_sound_frame(&frame);
        taken += 1;
    }
    Ok(taken)
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_protocol::SMALL;

    #[test]
    fn a_flood_of_frames_does_not_fill_the_memory() {
        let mut board = NetworkBoard::new(SMALL).expect("a board");
        for _ in 0..10 {
            fill(&mut board, || Ok(Some(vec![0; 1514]))).expect("frames");
            assert!(board.waiting() < 70_000, "{} clocks wait", board.waiting());
            board.run(SLICE_NS);
        }
        while !board.has_room() {
            board.run(SLICE_NS);
        }
        assert_ne!(fill(&mut board, || Ok(Some(vec![0; 60]))).expect("frames"), 0);
    }
}
