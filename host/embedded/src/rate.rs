//! Rates above the first one: the host asks, changes its own rate, and polls until the device answers at the new rate.

use embedded_io::{Read, ReadReady, Write};
use incircle_protocol::{DeviceFrame, HostFrame, STATUS_BAD_RATE};

use crate::clock::Clock;
use crate::error::Error;
use crate::session::Session;

/// Milliseconds for the acknowledgement of a rate.
const RATE_WAIT: u32 = 150;
/// Milliseconds for both sides to settle on a new rate.
const SETTLE: u32 = 3;
/// Milliseconds from one probe of a new rate to the next.
const PROBE_EVERY: u32 = 50;
/// Probes without an answer after which a rate is unusable.
const PROBES: u32 = 8;
/// Milliseconds beyond the silence of the device until it is back at the first rate, since clocks differ.
pub(crate) const SILENCE_SLACK: u32 = 200;
/// Times that a rate may fail before it is asked for no more.
pub(crate) const MOST_FAILURES: u8 = 2;

/// A rate that the caller wants.
#[derive(Clone, Copy)]
pub(crate) struct Rate<P> {
    pub bits_per_second: u32,
    /// Sets the port to a rate.
    pub set: fn(&mut P, u32),
    /// Times that the rate failed.
    pub failures: u8,
}

impl<P: Read + ReadReady + Write, C: Clock> Session<'_, P, C> {
    /// Brings both sides to the rate, whose step of the device's baud generator is `step`. Returns false if the device
    /// does not answer there: it may then be at either rate, until its silence is over. A device that refuses the rate
    /// stays at the first one, and so does the port.
    pub fn raise(mut self, rate: u32, step: u32, set: fn(&mut P, u32)) -> Result<bool, Error<P::Error>> {
        self.line.send(self.number, HostFrame::Rate, 0, step.to_le_bytes().into_iter())?;
        let until = self.after(RATE_WAIT);
        while let Some(header) = self.hear(until)? {
            if header.kind == DeviceFrame::Ack && header.status & STATUS_BAD_RATE != 0 {
                return Ok(true);
            }
            if header.kind == DeviceFrame::Ack {
                break;
            }
        }
        // Where the acknowledgement is lost, the device may be at the new rate all the same.
        self.line.set_rate(set, rate);
        let settled = self.after(SETTLE);
        while self.hear(settled)?.is_some() {}
        for _ in 0..PROBES {
            self.say_poll()?;
            let until = self.after(PROBE_EVERY);
            while let Some(header) = self.hear(until)? {
                if header.kind == DeviceFrame::Ack {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }
}
