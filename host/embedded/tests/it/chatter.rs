//! Devices that say frames without an end when the driver waits for the last word: the job ends all the same.

use std::collections::VecDeque;
use std::convert::Infallible;

use embedded_io::{ErrorType, Read, ReadReady, Write};
use incircle_embedded::{records_needed, Buffers, Device, Error};
use incircle_model::serial::{FromDevice, Instantly};
use incircle_protocol::{DeviceFrame, FIRST_RATE};

use crate::rig::{by_cpu, fast, random_points, small, Board, End};

/// Nanoseconds that a byte takes on the line.
const BYTE: u64 = 87_000;

/// A port on which sound frames that mean nothing follow one another from some moment on.
struct Chatter {
    end: End<Instantly>,
    has_begun: fn(&Board<Instantly>, u64) -> bool,
    /// What decides the moment.
    mark: u64,
    bytes: VecDeque<u8>,
}

impl Chatter {
    /// What the board has said comes first.
    fn is_talking(&mut self) -> bool {
        if !self.bytes.is_empty() {
            return true;
        }
        let Ok(false) = self.end.read_ready() else { return false };
        (self.has_begun)(&self.end.0.borrow(), self.mark)
    }

    fn set_rate(&mut self, rate: u32) {
        self.end.set_rate(rate);
        self.mark += 1;
    }
}

impl ErrorType for Chatter {
    type Error = Infallible;
}

impl Read for Chatter {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Infallible> {
        if !self.is_talking() {
            return self.end.read(buffer);
        }
        if self.bytes.is_empty() {
            let frame = FromDevice {
                session: 9,
                kind: DeviceFrame::Ack,
                expected: 0,
                answers: 0,
                free: 0,
                status: 0,
                body: vec![],
            };
            self.bytes.extend(frame.to_line());
        }
        self.end.0.borrow_mut().nanoseconds += BYTE;
        buffer[0] = self.bytes.pop_front().unwrap();
        Ok(1)
    }
}

impl ReadReady for Chatter {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(self.is_talking() || self.end.read_ready()?)
    }
}

impl Write for Chatter {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        self.end.write(bytes)
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        self.end.flush()
    }
}

#[test]
fn a_device_that_talks_when_the_session_is_closed_has_given_the_mesh() {
    let points = random_points(60, 1 << 16, 4);
    let quiet = small();
    crate::rig::run(&quiet, &points).unwrap();
    // The last frame of a job says that the session is closed.
    let closed = FromDevice {
        session: 1,
        kind: DeviceFrame::Closed,
        expected: 0,
        answers: 0,
        free: 4096,
        status: 0,
        body: vec![],
    };
    let mark = quiet.borrow().bytes[1] - closed.to_line().len() as u64;
    let board = small();
    let port = Chatter {
        end: End(board.clone()),
        has_begun: |board, mark| board.bytes[1] >= mark,
        mark,
        bytes: VecDeque::new(),
    };
    let mut device = Device::new(port, End(board.clone()));
    let (mut order, mut records) = (vec![0; 60], vec![[0; 3]; records_needed(60)]);
    let since = board.borrow().nanoseconds;
    let mesh = device.triangulate(&points, Buffers { order: &mut order, records: &mut records }, 20_000).unwrap();
    assert_eq!(mesh.triangles(), by_cpu(&points).triangles);
    assert!(board.borrow().nanoseconds - since < 2_000_000_000);
}

#[test]
fn a_device_that_talks_after_a_rate_that_failed_ends_in_an_error() {
    let points = random_points(60, 1 << 16, 4);
    let board = fast();
    board.borrow_mut().usable = FIRST_RATE;
    // The mark counts changes of the rate: the second one is back to the first rate.
    let port = Chatter {
        end: End(board.clone()),
        has_begun: |board, mark| mark == 2 && board.rate == FIRST_RATE,
        mark: 0,
        bytes: VecDeque::new(),
    };
    let mut device = Device::new(port, End(board.clone())).with_rate(1_000_000, Chatter::set_rate);
    let (mut order, mut records) = (vec![0; 60], vec![[0; 3]; records_needed(60)]);
    let buffers = Buffers { order: &mut order, records: &mut records };
    let since = board.borrow().nanoseconds;
    let found = device.triangulate(&points, buffers, 20_000).map(|_| ());
    assert!(matches!(found, Err(Error::Lost { .. } | Error::Timeout { .. })), "{found:?}");
    assert!(board.borrow().nanoseconds - since < 25_000_000_000);
}
