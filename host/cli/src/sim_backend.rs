//! The back end `sim`: the core's Verilog, run by Verilator.

use std::path::Path;
use std::time::Instant;

use incircle::transports::{receive_in_pieces, receive_next_in_pieces, AnswerHead, Capabilities, DeviceClocks};
use incircle::{Device, ErrorKind, Transport, TransportError};
use incircle_protocol::{Command, Config};
use incircle_sim::{SimDevice, SimError};

use crate::failure::{printable, Exit, Failure};
use crate::interrupt;

/// Clocks simulated between two looks at the deadline: about a tenth of a second.
const SLICE: u64 = 100_000;

/// Makes a core of this configuration. With `trace` a waveform of all its signals goes to that file, which is complete
/// once the device is dropped.
pub fn open(config: Config, trace: Option<&Path>) -> Result<Device, Failure> {
    let mut device = SimDevice::new(config).map_err(|error| Failure::new(Exit::NoDevice, error.to_string()))?;
    if let Some(path) = trace {
        device.trace_to(path).map_err(|error| Failure::input(printable(&error.to_string())))?;
    }
    Ok(Device::from_transport(Box::new(SimTransport { device, name: config.name })))
}

/// The transport to a simulated core. The simulation runs in slices of clocks until the answer is there or
/// the deadline has passed.
struct SimTransport {
    device: SimDevice,
    name: &'static str,
}

impl SimTransport {
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
            go_on(deadline, sent, wanted)?;
        }
    }

    /// Fills all of `words` with the next words of the core.
    fn fill(&mut self, words: &mut [u32], deadline: Instant) -> Result<(), TransportError> {
        let wanted = words.len();
        loop {
            match self.device.receive(words, SLICE) {
                Ok(()) => return Ok(()),
                // The device keeps the words that have come for the next call.
                Err(SimError::Timeout { done, .. }) => go_on(deadline, done, wanted)?,
                Err(error) => return Err(TransportError::other(ErrorKind::Link, error)),
            }
        }
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
        Capabilities { takes_ahead: true, any_order: true, ..Capabilities::default() }
    }

    fn clocks(&self) -> Option<DeviceClocks> {
        Some(DeviceClocks { now: self.device.clocks(), answer: self.device.answer_clock() })
    }
}

/// Refuses to go on after the deadline, or when the user has interrupted.
fn go_on(deadline: Instant, done: usize, wanted: usize) -> Result<(), TransportError> {
    if interrupt::raised() {
        return Err(TransportError::other(ErrorKind::Link, "interrupted"));
    }
    if Instant::now() >= deadline {
        return Err(TransportError::Timeout { done, wanted });
    }
    Ok(())
}
