//! The back end `sim`: the core's Verilog, run by Verilator.

use std::path::Path;
use std::time::Instant;

use incircle::{Device, Transport, TransportError};
use incircle_protocol::Config;
use incircle_sim::{SimDevice, SimError};

use crate::failure::{printable, Exit, Failure};
use crate::interrupt;

/// Clocks simulated between two looks at the deadline: about a tenth of a second.
const SLICE: u64 = 100_000;

/// A freshly made core of this configuration. With `trace` a waveform of all its signals goes to that file; dropping the
/// device completes it.
pub fn open(config: Config, trace: Option<&Path>) -> Result<Device, Failure> {
    let mut device = SimDevice::new(config).map_err(|error| Failure::new(Exit::NoDevice, error.to_string()))?;
    if let Some(path) = trace {
        device.trace_to(path).map_err(|error| Failure::input(printable(&error.to_string())))?;
    }
    Ok(Device::from_transport(Box::new(SimTransport { device, name: config.name })))
}

/// A simulated core as a transport. A slice of clocks that did not suffice is followed by the next, until the deadline.
struct SimTransport {
    device: SimDevice,
    name: &'static str,
}

impl Transport for SimTransport {
    fn send(&mut self, words: &[u32], deadline: Instant) -> Result<(), TransportError> {
        let wanted = words.len();
        let mut sent = 0;
        loop {
            let rest = words.get(sent..).unwrap_or_default();
            match self.device.send(rest, SLICE) {
                Ok(()) => return Ok(()),
                Err(SimError::Timeout { done, .. }) => sent += done,
                Err(error) => return Err(TransportError::Other(error.to_string())),
            }
            go_on(deadline, sent, wanted)?;
        }
    }

    fn receive(&mut self, words: &mut [u32], deadline: Instant) -> Result<(), TransportError> {
        let wanted = words.len();
        loop {
            match self.device.receive(words, SLICE) {
                Ok(()) => return Ok(()),
                // What has come is kept by the device for the next call.
                Err(SimError::Timeout { done, .. }) => go_on(deadline, done, wanted)?,
                Err(error) => return Err(TransportError::Other(error.to_string())),
            }
        }
    }

    fn answer_clock(&self) -> Option<u64> {
        self.device.answer_clock()
    }

    fn clocks(&self) -> Option<u64> {
        Some(self.device.clocks())
    }

    fn takes_ahead(&self) -> bool {
        true
    }

    fn name(&self) -> String {
        format!("sim:{}", self.name)
    }
}

/// Ends the call at the deadline, and when the user interrupts.
fn go_on(deadline: Instant, done: usize, wanted: usize) -> Result<(), TransportError> {
    if interrupt::raised() {
        return Err(TransportError::Other("interrupted".to_owned()));
    }
    if Instant::now() >= deadline {
        return Err(TransportError::Timeout { done, wanted });
    }
    Ok(())
}
