//! Helpers that the tests of the vfio-user device share.

use std::io::{self, Read, Write};
use std::sync::mpsc::{channel, RecvTimeoutError};
use std::time::{Duration, Instant};

use incircle::pcie::PcieTransport;
use incircle::transports::parts::CardFiles;
use incircle::{Device, Error, Mesh, Options, Point};
use incircle_model::stream::{ModelCore, StreamModel};
use incircle_protocol::SMALL;
use incircle_sim::pcie::Beats;
use incircle_testbench::card::vfio::VfioCard;

/// Deadline of every wait.
pub const LIMIT: Duration = Duration::from_secs(60);

/// The model of a card, as the device makes it at the start and after each reset.
pub fn model(beat_bits: u32) -> StreamModel<ModelCore> {
    StreamModel::new(ModelCore::of(SMALL).unwrap(), beat_bits)
}

/// A served card with the model in it.
pub fn card(beat_bits: u32) -> VfioCard {
    VfioCard::new(Box::new(move || -> Box<dyn Beats> { Box::new(model(beat_bits)) })).unwrap()
}

/// The library's device on these files.
pub fn opened(files: CardFiles) -> Result<Device, Error> {
    let transport = PcieTransport::new("pcie:vfio".to_owned(), files)?;
    Ok(Device::from_transport(Box::new(transport)))
}

/// Runs a job on the device.
pub fn triangulate(device: &mut Device, points: &[Point]) -> Result<Mesh, Error> {
    let options = Options::default().timeout(LIMIT);
    device.session_within(LIMIT)?.triangulate_with(points, &options).map(|solution| solution.mesh)
}

/// Runs an action that may hang, and fails if it does.
pub fn within<T: Send + 'static>(act: impl FnOnce() -> T + Send + 'static) -> T {
    let (sender, done) = channel();
    let thread = std::thread::spawn(move || {
        let _ = sender.send(act());
    });
    match done.recv_timeout(2 * LIMIT) {
        Ok(result) => result,
        Err(RecvTimeoutError::Timeout) => panic!("it hangs"),
        Err(RecvTimeoutError::Disconnected) => match thread.join() {
            Ok(()) => panic!("the action ended without a result"),
            Err(reason) => std::panic::resume_unwind(reason),
        },
    }
}

/// Waits until the condition holds.
pub fn until(what: &str, is_so: impl Fn() -> bool) {
    let deadline = Instant::now() + LIMIT;
    while !is_so() {
        assert!(Instant::now() < deadline, "never: {what}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// An action on the card while one of its streams is in use.
pub type Meddling = Box<dyn FnOnce() + Send>;

/// A stream that runs the action after a number of bytes: before its next call, or while that call is under way.
pub struct Meddled<T> {
    stream: T,
    left: usize,
    is_during: bool,
    meddling: Option<Meddling>,
}

impl<T> Meddled<T> {
    pub fn new(stream: T, after: usize, is_during: bool, meddling: Meddling) -> Self {
        Self { stream, left: after, is_during, meddling: Some(meddling) }
    }

    fn call(&mut self, call: impl FnOnce(&mut T) -> io::Result<usize>) -> io::Result<usize> {
        let due = if self.left == 0 { self.meddling.take() } else { None };
        let stream = &mut self.stream;
        let moved = match due {
            Some(meddling) if self.is_during => std::thread::scope(|scope| {
                scope.spawn(meddling);
                call(stream)
            }),
            Some(meddling) => {
                meddling();
                call(stream)
            }
            None => call(stream),
        }?;
        self.left = self.left.saturating_sub(moved);
        Ok(moved)
    }
}

impl<T: Write> Write for Meddled<T> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.call(|stream| stream.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl<T: Read> Read for Meddled<T> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.call(|stream| stream.read(bytes))
    }
}
