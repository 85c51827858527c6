//! The back end `sim`: the core's Verilog, run by Verilator.

use std::time::Instant;

use incircle::{Device, Transport, TransportError};
use incircle_protocol::Config;
use incircle_sim::SimDevice;

use crate::failure::{Exit, Failure};

/// Words carried between two looks at the clock on the wall.
const PIECE: usize = 1024;
/// Core clocks that a piece may take: more than any core needs to insert all its points, some ten seconds at most.
const PIECE_CLOCKS: u64 = 20_000_000;

/// A freshly made core of this configuration.
pub fn open(config: Config) -> Result<Device, Failure> {
    let device = SimDevice::new(config).map_err(|error| {
        let name = config.name;
        Failure::new(
            Exit::NoDevice,
            format!("the simulated core '{name}' cannot be made: {error}"),
        )
    })?;
    Ok(Device::from_transport(Box::new(SimTransport {
        device,
        name: config.name,
    })))
}

/// A simulated core as a transport.
struct SimTransport {
    device: SimDevice,
    name: &'static str,
}

impl Transport for SimTransport {
    fn send(&mut self, words: &[u32], deadline: Instant) -> Result<(), TransportError> {
        let wanted = words.len();
        for (index, piece) in words.chunks(PIECE).enumerate() {
            check(deadline, index * PIECE, wanted)?;
            let sent = self.device.send(piece, PIECE_CLOCKS);
            sent.map_err(|error| TransportError::Other(error.to_string()))?;
        }
        Ok(())
    }

    fn receive(&mut self, words: &mut [u32], deadline: Instant) -> Result<(), TransportError> {
        let wanted = words.len();
        for (index, piece) in words.chunks_mut(PIECE).enumerate() {
            check(deadline, index * PIECE, wanted)?;
            let received = self.device.receive(piece, PIECE_CLOCKS);
            received.map_err(|error| TransportError::Other(error.to_string()))?;
        }
        Ok(())
    }

    fn name(&self) -> String {
        format!("sim:{}", self.name)
    }
}

fn check(deadline: Instant, done: usize, wanted: usize) -> Result<(), TransportError> {
    if Instant::now() >= deadline {
        return Err(TransportError::Timeout { done, wanted });
    }
    Ok(())
}
