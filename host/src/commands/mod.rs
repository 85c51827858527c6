//! Commands and their answers over a transport.
//!
//! Identity, headers and lengths of answers are checked here; counts and records are checked in [`crate::job`], which
//! also says what is left to the validator.

use std::time::Instant;

use incircle_protocol::{
    answer_head, answer_opcode, answer_status, Command, Identity, Layout, Opcode, Status, IDENTITY_WORDS,
};

use crate::error::{DeviceFault, Error, TransportError};
use crate::limit::Limit;
use crate::transports::identity::check_identity;
use crate::transports::{AnswerHead, Capabilities, DeviceClocks, Transport};

/// The commands of the protocol over a [`Transport`].
pub(crate) struct CommandChannel {
    transport: Box<dyn Transport>,
    /// Layout of points and records in words. The identity of the device decides it, so it is a guess before `Hello`.
    layout: Layout,
    is_out_of_step: bool,
}

impl CommandChannel {
    pub(crate) fn new(transport: Box<dyn Transport>) -> Self {
        Self { transport, layout: Layout { point_words: 1, record_words: 3 }, is_out_of_step: false }
    }

    pub(crate) fn name(&self) -> String {
        self.transport.name()
    }

    pub(crate) fn capabilities(&self) -> Capabilities {
        self.transport.capabilities()
    }

    pub(crate) fn clocks(&self) -> Option<DeviceClocks> {
        self.transport.clocks()
    }

    /// Layout of points and records in words, valid after [`hello`](Self::hello).
    pub(crate) fn layout(&self) -> Layout {
        self.layout
    }

    /// Asks the device for its identity and refuses one that no sound device has.
    pub(crate) fn hello(&mut self, limit: Limit) -> Result<Identity, Error> {
        let mut words = Vec::new();
        self.submit(&[Command::Hello], limit)?;
        self.receive(&Command::<()>::Hello, &mut words, limit)?;
        let words: [u32; IDENTITY_WORDS] = std::array::from_fn(|place| words.get(place).copied().unwrap_or(0));
        let identity = Identity::from_words(words);
        check_identity(&identity).map_err(|fault| self.distrust(Opcode::Hello, fault))?;
        self.layout = Layout::of(identity.coord_bits, identity.capacity);
        Ok(identity)
    }

    /// Hands over commands, whose answers are received later and in the same order. After any error the channel
    /// is out of step.
    pub(crate) fn submit(&mut self, commands: &[Command<&[u32]>], limit: Limit) -> Result<(), Error> {
        self.check_step()?;
        let result = self.transport.submit(commands, limit.deadline());
        // An error names one command: of several the insertion, since it takes the time.
        let opcodes = commands.iter().map(Command::opcode);
        let opcode = opcodes.max_by_key(|opcode| *opcode == Opcode::Insert).unwrap_or(Opcode::Hello);
        let result = result.map_err(|source| self.failed(opcode, source, limit));
        self.is_out_of_step = result.is_err();
        result
    }

    /// Receives the answer to `command` into `payload`, which gets the length of the answer. `command` must be the
    /// oldest one whose answer is outstanding. After any error the channel is out of step.
    pub(crate) fn receive<P>(
        &mut self,
        command: &Command<P>,
        payload: &mut Vec<u32>,
        limit: Limit,
    ) -> Result<(), Error> {
        self.check_step()?;
        let result = self.take_answer(command, payload, limit);
        self.is_out_of_step = result.is_err();
        result
    }

    fn take_answer<P>(&mut self, command: &Command<P>, payload: &mut Vec<u32>, limit: Limit) -> Result<(), Error> {
        let opcode = command.opcode();
        let words = u32::try_from(command.payload_words(self.layout)).unwrap_or(u32::MAX);
        payload.resize(words as usize, 0);
        let awaited = answer_head(opcode, words);
        let came = self.transport.receive(awaited, payload, limit.deadline());
        let came = came.map_err(|source| self.failed(opcode, source, limit))?;
        if came != awaited {
            return Err(self.distrust(opcode, fault_of(came, opcode, words)));
        }
        if Instant::now() > limit.deadline() {
            return Err(self.late(opcode, limit));
        }
        Ok(())
    }

    /// Tries to bring the device back after this error. `true` means that it is as after its reset, so the job may be
    /// sent once more; `false` means that the error stands.
    pub(crate) fn recover(&mut self, error: &Error, limit: Limit) -> Result<bool, Error> {
        if !matches!(error, Error::Link { .. }) {
            return Ok(false);
        }
        let during = "the restart";
        let is_back = self.transport.recover(limit.deadline()).map_err(|source| match source {
            TransportError::Timeout { .. } => Error::Timeout { device: self.name(), during, timeout: limit.timeout() },
            source => Error::Link { device: self.name(), during, source },
        })?;
        self.is_out_of_step &= !is_back;
        Ok(is_back)
    }

    /// Turns a fault of the device into an error and puts the channel out of step, so that nothing more is asked of a
    /// device that cannot be trusted.
    pub(crate) fn distrust(&mut self, opcode: Opcode, fault: DeviceFault) -> Error {
        self.is_out_of_step = true;
        Error::Device { device: self.name(), during: opcode_name(opcode), fault }
    }

    fn check_step(&self) -> Result<(), Error> {
        if self.is_out_of_step {
            return Err(Error::OutOfStep { device: self.name() });
        }
        Ok(())
    }

    fn failed(&self, opcode: Opcode, source: TransportError, limit: Limit) -> Error {
        match source {
            TransportError::Timeout { .. } => self.late(opcode, limit),
            source => Error::Link { device: self.name(), during: opcode_name(opcode), source },
        }
    }

    fn late(&self, opcode: Opcode, limit: Limit) -> Error {
        Error::Timeout { device: self.name(), during: opcode_name(opcode), timeout: limit.timeout() }
    }
}

/// The fault of an answer to `opcode` that does not begin with the header and the length of `words` words.
fn fault_of(came: AnswerHead, opcode: Opcode, words: u32) -> DeviceFault {
    let [header, length] = came;
    let status = answer_status(header);
    match Status::from_u8(status) {
        _ if answer_opcode(header) != opcode as u8 || header & 0xffff != 0 => {}
        None => {}
        Some(Status::Ok) => return DeviceFault::PayloadLength { found: length, expected: words },
        Some(other) => return DeviceFault::Status { status, meaning: status_meaning(other) },
    }
    DeviceFault::Header { found: header, opcode: opcode as u8 }
}

/// Noun for a command, for the place "failed during ..." of a message.
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

/// Words for a status in messages.
const fn status_meaning(status: Status) -> &'static str {
    match status {
        Status::Ok => "done",
        Status::UnknownOpcode => "unknown opcode",
        Status::BadRange => "the range goes beyond the last record",
        Status::Collinear => "the first three points lie on one line",
        Status::Full => "the memory is full",
        Status::BadContexts => "more contexts were asked for than it has",
        Status::Stuck => "insertions have stopped making progress",
    }
}
