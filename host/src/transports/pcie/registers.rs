//! The registers of a card. A thread makes the calls, so that a call that does not return cannot keep the caller.

use std::fmt;
use std::sync::mpsc::{channel, Receiver, Sender};
use std::time::{Duration, Instant};

use incircle_protocol::{Identity, StreamRegister, MAGIC, STREAM_VERSION};

use super::fault::PcieFault;
use super::files::RegisterFile;
use super::left_behind::record_abandoned_call;
use crate::transports::identity::check_identity;

/// Value of every register of a card that is gone.
const ALL_ONES: u32 = u32::MAX;
/// Time limit for an access. A real access takes a microsecond.
const ACCESS: Duration = Duration::from_secs(2);
/// Most beats of a FIFO that a sound card may claim.
const MAX_FIFO_BEATS: u32 = 1 << 20;

/// A register to be read, or to be written with a value.
type Access = (StreamRegister, Option<u32>);

/// The registers of a card, behind the thread that makes the calls.
#[derive(Debug)]
pub(super) struct Registers {
    accesses: Sender<Access>,
    values: Receiver<Result<u32, PcieFault>>,
    /// Whether an access has not returned. The thread is stuck then, so no more accesses are tried.
    hangs: bool,
}

impl Registers {
    /// Starts the thread for the registers of this file.
    pub fn new(mut file: Box<dyn RegisterFile>) -> Self {
        let (accesses, wanted) = channel::<Access>();
        let (said, values) = channel();
        std::thread::spawn(move || {
            while let Ok((register, value)) = wanted.recv() {
                let result = match value {
                    None => file.read(register.offset()),
                    Some(value) => file.write(register.offset(), value).map(|()| 0),
                };
                let call = if value.is_none() { "the reading of a register" } else { "the writing of a register" };
                let result = result.map_err(|error| PcieFault::Call { call, reason: error.to_string() });
                if said.send(result).is_err() {
                    return;
                }
            }
        });
        Self { accesses, values, hangs: false }
    }

    /// Reads a register of the card.
    pub fn read(&mut self, register: StreamRegister) -> Result<u32, PcieFault> {
        self.access((register, None))
    }

    /// Writes a register of the card.
    pub fn write(&mut self, register: StreamRegister, value: u32) -> Result<(), PcieFault> {
        self.access((register, Some(value))).map(|_| ())
    }

    fn access(&mut self, access: Access) -> Result<u32, PcieFault> {
        let hangs = PcieFault::Hangs { call: "an access to a register", within: ACCESS };
        if self.hangs || self.accesses.send(access).is_err() {
            return Err(hangs);
        }
        self.values.recv_timeout(ACCESS).unwrap_or_else(|_| {
            self.hangs = true;
            record_abandoned_call();
            Err(hangs)
        })
    }

    /// Fails if the card is gone, or is no incircle card.
    pub fn check_presence(&mut self) -> Result<(), PcieFault> {
        match self.read(StreamRegister::Magic)? {
            ALL_ONES => Err(PcieFault::Gone),
            MAGIC => Ok(()),
            found => Err(PcieFault::Magic { found }),
        }
    }

    /// Resets the core and the FIFOs, and waits until the core runs.
    pub fn reset(&mut self, deadline: Instant) -> Result<(), PcieFault> {
        use incircle_protocol::{CONTROL_RESET, STREAM_STATUS_RESETTING, STREAM_STATUS_RUNS};
        let begun = Instant::now();
        self.write(StreamRegister::Control, CONTROL_RESET)?;
        loop {
            let status = self.read(StreamRegister::Status)?;
            if status == ALL_ONES {
                return Err(PcieFault::Gone);
            }
            if status & (STREAM_STATUS_RUNS | STREAM_STATUS_RESETTING) == STREAM_STATUS_RUNS {
                return Ok(());
            }
            if Instant::now() >= deadline {
                return Err(PcieFault::Reset { within: begun.elapsed(), status });
            }
            std::thread::sleep(Duration::from_micros(100));
        }
    }

    /// Reads the identity of the card and the bytes of a beat, and refuses values that no sound card has.
    pub fn identify(&mut self) -> Result<(Identity, usize), PcieFault> {
        use StreamRegister as Of;
        self.check_presence()?;
        let found = self.read(Of::StreamVersion)?;
        if found >> 16 != STREAM_VERSION >> 16 || found < STREAM_VERSION {
            return Err(PcieFault::Version { found });
        }
        let identity = Identity::from_words([
            MAGIC,
            self.read(Of::ProtocolVersion)?,
            self.read(Of::CoreVersion)?,
            self.read(Of::CoordBits)?,
            self.read(Of::Capacity)?,
            self.read(Of::Contexts)?,
            self.read(Of::Ring)?,
        ]);
        check_identity(&identity).map_err(PcieFault::Identity)?;
        let bits = self.read(Of::BeatBits)?;
        if !matches!(bits, 64 | 128) {
            return Err(PcieFault::Register { name: "bits of a beat", found: bits, wanted: "64 and 128" });
        }
        let depth = self.read(Of::FifoBeats)?;
        if !(1..=MAX_FIFO_BEATS).contains(&depth) {
            return Err(PcieFault::Register { name: "beats of a FIFO", found: depth, wanted: "1 to 1048576" });
        }
        Ok((identity, bits as usize / 8))
    }

    /// Reads all registers but the control register.
    pub fn all(&mut self) -> Result<CardRegisters, PcieFault> {
        let (identity, beat_bytes) = self.identify()?;
        let low = self.read(StreamRegister::ClocksLow)?;
        let high = self.read(StreamRegister::ClocksHigh)?;
        Ok(CardRegisters {
            stream_version: self.read(StreamRegister::StreamVersion)?,
            identity,
            beat_bits: 8 * beat_bytes as u32,
            fifo_beats: self.read(StreamRegister::FifoBeats)?,
            status: self.read(StreamRegister::Status)?,
            errors: self.read(StreamRegister::Errors)?,
            fault: self.read(StreamRegister::Fault)?,
            clocks: u64::from(high) << 32 | u64::from(low),
            command_beats: self.read(StreamRegister::CommandBeats)?,
            answer_beats: self.read(StreamRegister::AnswerBeats)?,
            answers: self.read(StreamRegister::Answers)?,
            command_waits: self.read(StreamRegister::CommandWaits)?,
            answer_waits: self.read(StreamRegister::AnswerWaits)?,
        })
    }
}

/// The values of the registers of a card, for a diagnosis. The page `protocol/STREAM.md` defines them all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CardRegisters {
    /// Version of the stream device, `major << 16 | minor`.
    pub stream_version: u32,
    /// Identity of the core on the card.
    pub identity: Identity,
    /// Bits of a beat, 64 or 128.
    pub beat_bits: u32,
    /// Beats for which each FIFO has room.
    pub fifo_beats: u32,
    /// Status bits of the stream link.
    pub status: u32,
    /// Error bits of the stream link.
    pub errors: u32,
    /// Header of the last answer with a status other than `Ok`.
    pub fault: u32,
    /// Clocks of the bus since the reset.
    pub clocks: u64,
    /// Beats of commands that the card has taken.
    pub command_beats: u32,
    /// Beats of answers that the card has given.
    pub answer_beats: u32,
    /// Answers that the card has given.
    pub answers: u32,
    /// Clocks in which a beat of commands waited.
    pub command_waits: u32,
    /// Clocks in which a beat of answers waited.
    pub answer_waits: u32,
}

impl fmt::Display for CardRegisters {
    /// Writes the values, a line for each group of registers.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "stream device {}.{}", self.stream_version >> 16, self.stream_version & 0xffff)?;
        writeln!(f, "beats of {} bits, FIFOs of {} beats", self.beat_bits, self.fifo_beats)?;
        writeln!(f, "status {:#x}, errors {:#x}, fault {:#010x}", self.status, self.errors, self.fault)?;
        writeln!(f, "{} clocks of the bus", self.clocks)?;
        writeln!(f, "{} command beats, waited for {} clocks", self.command_beats, self.command_waits)?;
        writeln!(f, "{} answer beats, waited for {} clocks", self.answer_beats, self.answer_waits)?;
        writeln!(f, "{} answers", self.answers)
    }
}
