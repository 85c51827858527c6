//! A simulated core as a device of the library: the same calls as for a board.

use std::time::Instant;

use incircle::transports::{receive_in_pieces, receive_next_in_pieces, AnswerHead, Capabilities, DeviceClocks, Pace};
use incircle::{Device, ErrorKind, Transport, TransportError};
use incircle_protocol::{Command, Config};

use crate::device::SimDevice;
use crate::error::SimError;

/// Clocks simulated between two looks at the deadline: a fraction of a second.
const SLICE: u64 = 100_000;

/// Factor by which limits of time are longer than those for a real core. The simulation runs in the process of the
/// caller, so a deadline in wall time says little about the core: on a machine whose processors are all busy the
/// greeting alone has taken more than the 15 s that a real core gets.
const SLOW: u32 = 20;

/// A simulated core of this configuration, as a device of the library.
///
/// # Errors
/// There is no simulated core of the configuration; see [`SimDevice::new`].
///
/// # Example
/// ```
/// let mut device = incircle_sim::open(incircle_protocol::TINY)?;
/// let mesh = device.session()?.triangulate(&[(0, 0), (9, 0), (0, 9)])?.mesh;
/// assert_eq!(mesh.triangles, [[0, 1, 2]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn open(config: Config) -> Result<Device, SimError> {
    let device = SimDevice::new(config)?;
    Ok(Device::from_transport(Box::new(SimTransport::new(device, config.name))))
}

/// The transport to a simulated core. The simulation runs in slices of clocks until the answer is there or
/// the deadline has passed.
#[derive(Debug)]
pub struct SimTransport {
    device: SimDevice,
    name: String,
    is_interrupted: fn() -> bool,
}

impl SimTransport {
    /// The transport to this core. `name`, usually that of the configuration, is what errors call it.
    pub fn new(device: SimDevice, name: &str) -> Self {
        Self { device, name: name.to_owned(), is_interrupted: || false }
    }

    /// Lets a command end early: it fails once `is_interrupted` returns true, within a fraction of a second.
    pub fn interrupted_by(mut self, is_interrupted: fn() -> bool) -> Self {
        self.is_interrupted = is_interrupted;
        self
    }

    /// Sends words to the core, one after the other.
    fn send(&mut self, words: &[u32], deadline: Instant) -> Result<(), TransportError> {
        let wanted = words.len();
        let mut sent = 0;
        loop {
            let rest = words.get(sent..).unwrap_or_default();
            match self.device.send(rest, SLICE) {
                Ok(()) => return Ok(()),
                Err(SimError::Timeout { done, .. }) => sent += done,
                Err(error) => return Err(TransportError::other(ErrorKind::Link, error)),
            }
            self.go_on(deadline, sent, wanted)?;
        }
    }

    /// Fills all of `words` with the next words of the core.
    fn fill(&mut self, words: &mut [u32], deadline: Instant) -> Result<(), TransportError> {
        let wanted = words.len();
        loop {
            match self.device.receive(words, SLICE) {
                Ok(()) => return Ok(()),
                // The device keeps the words that have come for the next call.
                Err(SimError::Timeout { done, .. }) => self.go_on(deadline, done, wanted)?,
                Err(error) => return Err(TransportError::other(ErrorKind::Link, error)),
            }
        }
    }

    /// Refuses to go on after the deadline, or when the user has interrupted.
    fn go_on(&self, deadline: Instant, done: usize, wanted: usize) -> Result<(), TransportError> {
        if (self.is_interrupted)() {
            return Err(TransportError::other(ErrorKind::Link, "interrupted"));
        }
        if Instant::now() >= deadline {
            return Err(TransportError::Timeout { done, wanted });
        }
        Ok(())
    }
}

impl Transport for SimTransport {
    fn name(&self) -> String {
        format!("sim:{}", self.name)
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], deadline: Instant) -> Result<(), TransportError> {
        let mut words = Vec::with_capacity(commands.iter().map(Command::words).sum());
        commands.iter().for_each(|command| command.encode(&mut words));
        self.send(&words, deadline)
    }

    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        receive_in_pieces(head, payload, |words| self.fill(words, deadline))
    }

    fn receive_next(
        &mut self,
        words_of: &mut dyn FnMut(AnswerHead) -> Option<usize>,
        payload: &mut Vec<u32>,
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        receive_next_in_pieces(words_of, payload, |words| self.fill(words, deadline))
    }

    fn capabilities(&self) -> Capabilities {
        let pace = Pace { slow: SLOW, ..Pace::default() };
        Capabilities { takes_ahead: true, any_order: true, pace, ..Capabilities::default() }
    }

    fn clocks(&self) -> Option<DeviceClocks> {
        Some(DeviceClocks { now: self.device.clocks(), answer: self.device.answer_clock() })
    }
}
