//! Commands and their answers over a transport. Identity, headers and lengths are checked here, counts in [`crate::session`],
//! records in [`crate::assemble`], which also says what is left to the validator.

use std::time::{Duration, Instant};

use incircle_protocol::{
    answer_opcode, answer_status, clear_word, command_word, Identity, InsertReport, Opcode, Status, COUNTER_WORDS,
    IDENTITY_WORDS, INSERT_REPORT_WORDS, LATENCY_BUCKETS, MAGIC, MAX_COORD_BITS, MAX_MODEL_POINTS, MIN_CONTEXTS,
    MIN_COORD_BITS, MIN_POINTS, PROTOCOL_VERSION,
};

use crate::counters::Counters;
use crate::error::Error;
use crate::fault::{DeviceFault, MAX_DEVICE_CONTEXTS};
use crate::transport::{Pace, Transport, TransportError};

/// Until when a job may run, and how long that was at its start.
#[derive(Clone, Copy)]
pub(crate) struct Limit {
    deadline: Instant,
    timeout: Duration,
}

impl Limit {
    /// From now on for `timeout`, or for a year if that is longer: no clock overflows.
    pub(crate) fn of(timeout: Duration) -> Self {
        const YEAR: Duration = Duration::from_secs(365 * 24 * 3600);
        let timeout = timeout.min(YEAR);
        Self { deadline: Instant::now() + timeout, timeout }
    }

    /// Until when.
    pub(crate) fn deadline(self) -> Instant {
        self.deadline
    }

    /// How long that was at the start.
    pub(crate) fn timeout(self) -> Duration {
        self.timeout
    }

    /// For so much longer.
    pub(crate) fn longer(self, time: Duration) -> Self {
        let more = Self::of(time).timeout;
        Self { deadline: self.deadline + more, timeout: self.timeout + more }
    }

    /// An error once the deadline has passed.
    pub(crate) fn check(&self, device: &str, during: &'static str) -> Result<(), Error> {
        if Instant::now() <= self.deadline {
            return Ok(());
        }
        Err(Error::Timeout { device: device.to_owned(), during, timeout: self.timeout })
    }
}

/// A transport with the commands of the protocol.
pub(crate) struct Link {
    transport: Box<dyn Transport>,
    out_of_step: bool,
}

impl Link {
    pub(crate) fn new(transport: Box<dyn Transport>) -> Self {
        Self { transport, out_of_step: false }
    }

    pub(crate) fn name(&self) -> String {
        self.transport.name()
    }

    pub(crate) fn pace(&self) -> Pace {
        self.transport.pace()
    }

    pub(crate) fn packs_records(&self) -> bool {
        self.transport.packs_records()
    }

    pub(crate) fn takes_ahead(&self) -> bool {
        self.transport.takes_ahead()
    }

    pub(crate) fn clocks(&self) -> Option<u64> {
        self.transport.clocks()
    }

    pub(crate) fn answer_clock(&self) -> Option<u64> {
        self.transport.answer_clock()
    }

    /// Asks who the device is, and believes only what a sound device can be.
    pub(crate) fn hello(&mut self, limit: Limit) -> Result<Identity, Error> {
        let mut words = [0; IDENTITY_WORDS];
        self.ask(Opcode::Hello, &[command_word(Opcode::Hello)], &mut words, limit)?;
        let identity = Identity::from_words(words);
        check_identity(&identity).map_err(|fault| self.distrust(Opcode::Hello, fault))?;
        Ok(identity)
    }

    /// Makes the device forget everything, and work with this many contexts from now on.
    pub(crate) fn clear(&mut self, contexts: u32, limit: Limit) -> Result<(), Error> {
        self.ask(Opcode::Clear, &[clear_word(contexts)], &mut [], limit)
    }

    /// Sends `words`, a whole `Insert` command, and returns the totals.
    pub(crate) fn insert(&mut self, words: &[u32], limit: Limit) -> Result<InsertReport, Error> {
        let mut report = [0; INSERT_REPORT_WORDS];
        self.ask(Opcode::Insert, words, &mut report, limit)?;
        Ok(InsertReport::from_words(report))
    }

    /// Reads `count` records from number `first` on, or their vertices, into `words`, which is as long as they are.
    pub(crate) fn read(
        &mut self,
        opcode: Opcode,
        [first, count]: [u32; 2],
        words: &mut [u32],
        limit: Limit,
    ) -> Result<(), Error> {
        self.ask(opcode, &[command_word(opcode), first, count], words, limit)
    }

    /// Reads the counters.
    pub(crate) fn counters(&mut self, limit: Limit) -> Result<Counters, Error> {
        let mut words = [0; COUNTER_WORDS];
        self.ask(Opcode::Counters, &[command_word(Opcode::Counters)], &mut words, limit)?;
        Ok(Counters::from_words(&words))
    }

    /// Reads the histogram of latencies.
    pub(crate) fn latencies(&mut self, limit: Limit) -> Result<[u32; LATENCY_BUCKETS], Error> {
        let mut buckets = [0; LATENCY_BUCKETS];
        self.ask(Opcode::Latencies, &[command_word(Opcode::Latencies)], &mut buckets, limit)?;
        Ok(buckets)
    }

    /// Whether the device is back after this error, as after its reset: then the job may be tried once more.
    pub(crate) fn recover(&mut self, error: &Error, limit: Limit) -> Result<bool, Error> {
        if !matches!(error, Error::Link { .. }) {
            return Ok(false);
        }
        let during = "a new start";
        let is_back = self.transport.recover(limit.deadline).map_err(|source| match source {
            TransportError::Timeout { .. } => Error::Timeout { device: self.name(), during, timeout: limit.timeout },
            source => Error::Link { device: self.name(), during, source },
        })?;
        self.out_of_step &= !is_back;
        Ok(is_back)
    }

    /// The error for a fault; the device is not asked again.
    pub(crate) fn distrust(&mut self, opcode: Opcode, fault: DeviceFault) -> Error {
        self.out_of_step = true;
        Error::Device { device: self.name(), during: opcode_name(opcode), fault }
    }

    /// Sends whole commands whose answers are received later, in their order. After any error the streams count as out of step.
    pub(crate) fn send_ahead(&mut self, opcode: Opcode, words: &[u32], limit: Limit) -> Result<(), Error> {
        if self.out_of_step {
            return Err(Error::OutOfStep { device: self.name() });
        }
        let sent = self.transport.send(words, limit.deadline).map_err(|source| self.failed(opcode, source, limit));
        self.out_of_step = sent.is_err();
        sent
    }

    /// The whole answer to the first command sent whose answer has not been received. After any error the streams count as out of step.
    pub(crate) fn receive_answer(&mut self, opcode: Opcode, payload: &mut [u32], limit: Limit) -> Result<(), Error> {
        if self.out_of_step {
            return Err(Error::OutOfStep { device: self.name() });
        }
        let result = self.take_answer(opcode, payload, limit);
        self.out_of_step = result.is_err();
        result
    }

    /// One command with its whole answer. After any error the streams count as out of step.
    fn ask(&mut self, opcode: Opcode, command: &[u32], payload: &mut [u32], limit: Limit) -> Result<(), Error> {
        if self.out_of_step {
            return Err(Error::OutOfStep { device: self.name() });
        }
        let result = self.exchange(opcode, command, payload, limit);
        self.out_of_step = result.is_err();
        result
    }

    fn exchange(&mut self, opcode: Opcode, command: &[u32], payload: &mut [u32], limit: Limit) -> Result<(), Error> {
        let Limit { deadline, .. } = limit;
        self.transport.send(command, deadline).map_err(|source| self.failed(opcode, source, limit))?;
        self.take_answer(opcode, payload, limit)
    }

    fn take_answer(&mut self, opcode: Opcode, payload: &mut [u32], limit: Limit) -> Result<(), Error> {
        let Limit { deadline, .. } = limit;
        let mut header = [0; 2];
        self.transport.receive(&mut header, deadline).map_err(|source| self.failed(opcode, source, limit))?;
        if let Err(fault) = check_header(header, opcode, payload.len()) {
            return Err(self.refuse(opcode, header[0], fault, limit));
        }
        if !payload.is_empty() {
            self.transport.receive(payload, deadline).map_err(|source| self.failed(opcode, source, limit))?;
        }
        if Instant::now() > deadline {
            return Err(self.late(opcode, limit));
        }
        Ok(())
    }

    /// The error for a header that is not the awaited one.
    fn refuse(&mut self, opcode: Opcode, header: u32, fault: DeviceFault, limit: Limit) -> Error {
        let is_foreign = answer_opcode(header) != opcode as u8
            && header & 0xffff == 0
            && Status::from_u8(answer_status(header)).is_some();
        // Of records that it has told of nothing is asked beyond: it has forgotten them.
        let is_forgotten = answer_opcode(header) == opcode as u8 && answer_status(header) == Status::BadRange as u8;
        match (is_foreign || is_forgotten).then(|| self.transport.lost_step()).flatten() {
            Some(source) => self.failed(opcode, source, limit),
            None => self.distrust(opcode, fault),
        }
    }

    fn failed(&self, opcode: Opcode, source: TransportError, limit: Limit) -> Error {
        match source {
            TransportError::Timeout { .. } => self.late(opcode, limit),
            source => Error::Link { device: self.name(), during: opcode_name(opcode), source },
        }
    }

    fn late(&self, opcode: Opcode, limit: Limit) -> Error {
        Error::Timeout { device: self.name(), during: opcode_name(opcode), timeout: limit.timeout }
    }
}

/// Header and announced length of an answer must be what the command asks for.
fn check_header(header: [u32; 2], opcode: Opcode, payload: usize) -> Result<(), DeviceFault> {
    let [header, length] = header;
    let malformed = DeviceFault::Header { found: header, opcode: opcode as u8 };
    let status = answer_status(header);
    match Status::from_u8(status) {
        _ if answer_opcode(header) != opcode as u8 || header & 0xffff != 0 => return Err(malformed),
        None => return Err(malformed),
        Some(Status::Ok) => {}
        Some(other) => return Err(DeviceFault::Status { status, meaning: status_meaning(other) }),
    }
    if length as usize != payload {
        return Err(DeviceFault::PayloadLength { found: length, expected: u32::try_from(payload).unwrap_or(u32::MAX) });
    }
    Ok(())
}

/// Identity words are hostile until they pass here.
pub(crate) fn check_identity(identity: &Identity) -> Result<(), DeviceFault> {
    if identity.magic != MAGIC {
        return Err(DeviceFault::Magic { found: identity.magic, expected: MAGIC });
    }
    let (found, expected) = (identity.protocol_version, PROTOCOL_VERSION);
    // An older minor version lacks commands that are sent, and counters that are awaited.
    if found >> 16 != expected >> 16 || found < expected {
        return Err(DeviceFault::ProtocolVersion { found, expected });
    }
    if !(MIN_COORD_BITS..=MAX_COORD_BITS).contains(&identity.coord_bits) {
        return Err(DeviceFault::CoordBits(identity.coord_bits));
    }
    if !(MIN_POINTS..=MAX_MODEL_POINTS).contains(&identity.capacity) {
        return Err(DeviceFault::Capacity(identity.capacity));
    }
    if !(MIN_CONTEXTS..=MAX_DEVICE_CONTEXTS).contains(&identity.contexts) {
        return Err(DeviceFault::Contexts(identity.contexts));
    }
    Ok(())
}

/// The command in messages.
const fn opcode_name(opcode: Opcode) -> &'static str {
    match opcode {
        Opcode::Hello => "the greeting",
        Opcode::Clear => "the clearing",
        Opcode::Insert => "the insertion",
        Opcode::Read | Opcode::Triangles => "the read-out",
        Opcode::Counters => "the reading of counters",
        Opcode::Latencies => "the reading of latencies",
    }
}

/// A status in messages.
const fn status_meaning(status: Status) -> &'static str {
    match status {
        Status::Ok => "done",
        Status::UnknownOpcode => "unknown opcode",
        Status::BadRange => "the range passes the last record",
        Status::Collinear => "the first three points lie on one line",
        Status::Full => "the memory is full",
        Status::BadContexts => "more contexts were asked for than it has",
        Status::Stuck => "no insertion ends any more",
    }
}
