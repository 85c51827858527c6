//! The serial port and the clock of the caller: frames go out, and the next frame comes in.

use embedded_io::{Read, ReadReady, Write};
use incircle_protocol::{HostFrame, FRAME_END};

use crate::clock::{has_come, Clock};
use crate::error::Error;
use crate::frame::{FrameReader, FrameWriter, Header};

/// Most bytes taken from the port between two bytes that are written. More than one, so that the port's memory empties.
const READ_AHEAD: usize = 4;

/// The line to the device.
pub(crate) struct Line<P, C> {
    port: P,
    clock: C,
    reader: FrameReader,
    /// Bytes received, at most `u32::MAX`, whatever they were.
    received: u32,
}

impl<P: Read + ReadReady + Write, C: Clock> Line<P, C> {
    pub const fn new(port: P, clock: C) -> Self {
        Self { port, clock, reader: FrameReader::new(), received: 0 }
    }

    pub fn now(&mut self) -> u32 {
        self.clock.milliseconds()
    }

    pub const fn received(&self) -> u32 {
        self.received
    }

    pub fn into_parts(self) -> (P, C) {
        (self.port, self.clock)
    }

    /// Lets the caller set the port to this rate. Bytes that came at the rate before are forgotten.
    pub fn set_rate(&mut self, set: fn(&mut P, u32), rate: u32) {
        set(&mut self.port, rate);
        self.reader.clear();
    }

    /// Sends a frame with these bytes of payload.
    pub fn send(
        &mut self,
        session: u8,
        kind: HostFrame,
        number: u8,
        payload: impl ExactSizeIterator<Item = u8>,
    ) -> Result<(), Error<P::Error>> {
        let mut writer = FrameWriter::new();
        let mut sink = |byte| self.write(byte);
        // Zeros end an unfinished frame that noise may have left in the device.
        sink(FRAME_END)?;
        let [low, high] = (payload.len() as u16).to_le_bytes();
        for byte in [session, kind as u8, number, low, high].into_iter().chain(payload) {
            writer.add(byte, &mut sink)?;
        }
        writer.end(&mut sink)?;
        self.port.flush().map_err(Error::Port)
    }

    /// Sends a frame without payload.
    pub fn say(&mut self, session: u8, kind: HostFrame) -> Result<(), Error<P::Error>> {
        self.send(session, kind, 0, [0; 0].into_iter())
    }

    fn write(&mut self, byte: u8) -> Result<(), Error<P::Error>> {
        for _ in 0..READ_AHEAD {
            if !self.take_byte()? {
                break;
            }
        }
        match self.port.write(&[byte]) {
            Ok(0) => Err(Error::Closed),
            Ok(_) => Ok(()),
            Err(error) => Err(Error::Port(error)),
        }
    }

    /// Takes a byte from the port if there is one and no frame waits.
    fn take_byte(&mut self) -> Result<bool, Error<P::Error>> {
        if self.reader.has_frame() || !self.port.read_ready().map_err(Error::Port)? {
            return Ok(false);
        }
        let mut byte = [0];
        if self.port.read(&mut byte).map_err(Error::Port)? == 0 {
            return Err(Error::Closed);
        }
        self.received = self.received.saturating_add(1);
        self.reader.take(byte[0]);
        Ok(true)
    }

    /// Waits for the next frame whose check sum holds; `None` if there is none by this moment.
    pub fn hear(&mut self, until: u32) -> Result<Option<Header>, Error<P::Error>> {
        loop {
            let has_byte = self.take_byte()?;
            if let Some(header) = self.reader.look() {
                return Ok(Some(header));
            }
            if has_come(until, self.clock.milliseconds()) {
                return Ok(None);
            }
            if !has_byte {
                self.clock.idle();
            }
        }
    }

    /// Lets the last frame be heard once more.
    pub fn hear_again(&mut self) {
        self.reader.look_again();
    }

    /// The body of the last frame.
    pub fn body(&self) -> &[u8] {
        self.reader.body()
    }
}
