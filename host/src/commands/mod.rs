//! Commands and their answers over a transport.
//!
//! Identity, headers and lengths of answers are checked here; counts and records are checked in [`crate::job`], which
//! also says what is left to the validator.

mod awaited;

use std::time::Instant;

use incircle_protocol::{
    answer_engine, answer_head, answer_opcode, answer_status, answer_tag, signed_header, Command, Identity, Layout,
    Opcode, Status, IDENTITY_WORDS,
};

use crate::error::{DeviceFault, Error, TransportError};
use crate::limit::Limit;
use crate::transports::identity::check_identity;
use crate::transports::{is_begun_as, AnswerHead, Capabilities, DeviceClocks, Transport};
use awaited::Awaited;

/// The version of the protocol from which on a `Clear` gives its job a tag.
const FIRST_VERSION_WITH_TAGS: u32 = 2 << 16;

/// The commands of the protocol over a [`Transport`].
pub(crate) struct CommandChannel {
    transport: Box<dyn Transport>,
    /// Layout of points and records in words. The identity of the device decides it, so it is a guess before `Hello`.
    layout: Layout,
    /// Number of engines of the device, valid after [`hello`](Self::hello).
    engines: u32,
    /// Whether headers of answers repeat the tag of their job, valid after [`hello`](Self::hello).
    has_tags: bool,
    /// The tags that were given, and, on a device of several engines, the answers that are still to come.
    awaited: Awaited,
    is_out_of_step: bool,
}

/// The outcome of receiving an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Came {
    /// The device did what the command asked.
    Whole,
    /// The engine of this number is stuck, but others may do the job. All other answers to the job are dropped.
    Stuck(u32),
}

impl CommandChannel {
    pub(crate) fn new(transport: Box<dyn Transport>) -> Self {
        let layout = Layout { point_words: 1, record_words: 3 };
        Self { transport, layout, engines: 1, has_tags: false, awaited: Awaited::default(), is_out_of_step: false }
    }

    pub(crate) fn name(&self) -> String {
        self.transport.name()
    }

    pub(crate) fn capabilities(&self) -> Capabilities {
        self.transport.capabilities()
    }

    /// Number of commands that the transport has sent again.
    pub(crate) fn repeats(&self) -> u64 {
        self.transport.repeats()
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
        // With one engine the answer is taken in order, and its tag, that of the last job, is not looked at.
        self.engines = 1;
        self.submit(0, &[Command::Hello], limit)?;
        self.check_step()?;
        let result = self.take_answer(None, &Command::<()>::Hello, &mut words, limit);
        self.is_out_of_step = result.is_err();
        result?;
        let words: [u32; IDENTITY_WORDS] = std::array::from_fn(|place| words.get(place).copied().unwrap_or(0));
        let identity = Identity::from_words(words);
        check_identity(&identity).map_err(|fault| self.distrust(Opcode::Hello, fault))?;
        self.layout = Layout::of(identity.coord_bits, identity.capacity);
        self.engines = identity.engines;
        self.has_tags = identity.protocol_version >= FIRST_VERSION_WITH_TAGS;
        Ok(identity)
    }

    /// Whether the answers to several jobs may be outstanding at a time, and come in any order.
    pub(crate) fn takes_any_order(&self) -> bool {
        self.engines > 1 && self.capabilities().any_order
    }

    /// The tag for the next job, another one than that of the job before it. For a device without tags it is 0.
    pub(crate) fn new_tag(&mut self) -> u8 {
        if self.has_tags {
            self.awaited.new_tag()
        } else {
            0
        }
    }

    /// Hands over commands of the job with this tag, whose answers are received later and in the same order. After any
    /// error the channel is out of step.
    pub(crate) fn submit(&mut self, tag: u8, commands: &[Command<&[u32]>], limit: Limit) -> Result<(), Error> {
        self.check_step()?;
        if self.takes_any_order() {
            for command in commands {
                let words = u32::try_from(command.payload_words(self.layout)).unwrap_or(u32::MAX);
                self.awaited.add(tag, command.opcode(), words);
            }
        }
        let result = self.transport.submit(commands, limit.deadline());
        // An error names one command: of several the insertion, since it takes the time.
        let opcodes = commands.iter().map(Command::opcode);
        let opcode = opcodes.max_by_key(|opcode| *opcode == Opcode::Insert).unwrap_or(Opcode::Hello);
        let result = result.map_err(|source| self.failed(opcode, source, limit));
        self.is_out_of_step = result.is_err();
        result
    }

    /// Receives the answer to `command` of the job with this tag into `payload`, which gets the length of the answer.
    /// `command` must be the oldest one of its job whose answer is outstanding; where answers come in order, the oldest
    /// of all. After any error the channel is out of step.
    pub(crate) fn receive<P>(
        &mut self,
        tag: u8,
        command: &Command<P>,
        payload: &mut Vec<u32>,
        limit: Limit,
    ) -> Result<Came, Error> {
        self.check_step()?;
        let result = if self.takes_any_order() {
            self.take_by_tag(tag, command, payload, limit)
        } else {
            self.take_answer(Some(tag), command, payload, limit).map(|()| Came::Whole)
        };
        self.is_out_of_step = result.is_err();
        result
    }

    /// Receives answers, and keeps those of other jobs, until the next answer to the job with this tag is there.
    fn take_by_tag<P>(
        &mut self,
        tag: u8,
        command: &Command<P>,
        payload: &mut Vec<u32>,
        limit: Limit,
    ) -> Result<Came, Error> {
        let opcode = command.opcode();
        loop {
            if let Some((head, words)) = self.awaited.take(tag) {
                *payload = words;
                return self.judge(tag, command, head);
            }
            let mut words = Vec::new();
            let (awaited, engines) = (&self.awaited, self.engines);
            let mut words_of = |head| awaited.words_of(head, engines);
            let came = self.transport.receive_next(&mut words_of, &mut words, limit.deadline());
            let came = came.map_err(|source| self.failed(opcode, source, limit))?;
            if self.awaited.words_of(came, self.engines) != Some(words.len()) {
                let words = u32::try_from(command.payload_words(self.layout)).unwrap_or(u32::MAX);
                return Err(self.distrust(opcode, fault_of(came, opcode, words)));
            }
            if Instant::now() > limit.deadline() {
                return Err(self.late(opcode, limit));
            }
            self.awaited.keep(came, words);
        }
    }

    /// Judges the status of an answer that has the right opcode and length.
    fn judge<P>(&mut self, tag: u8, command: &Command<P>, head: AnswerHead) -> Result<Came, Error> {
        let opcode = command.opcode();
        let words = u32::try_from(command.payload_words(self.layout)).unwrap_or(u32::MAX);
        match Status::from_u8(answer_status(head[0])) {
            Some(Status::Ok) => Ok(Came::Whole),
            Some(Status::Stuck) => {
                self.awaited.drop_rest(tag);
                Ok(Came::Stuck(answer_engine(head[0]).into()))
            }
            _ => Err(self.distrust(opcode, fault_of(head, opcode, words))),
        }
    }

    /// Receives an answer that must be the next one, with this tag unless the tag is not known.
    fn take_answer<P>(
        &mut self,
        tag: Option<u8>,
        command: &Command<P>,
        payload: &mut Vec<u32>,
        limit: Limit,
    ) -> Result<(), Error> {
        let opcode = command.opcode();
        let words = u32::try_from(command.payload_words(self.layout)).unwrap_or(u32::MAX);
        payload.resize(words as usize, 0);
        let [header, length] = answer_head(opcode, words);
        let awaited = [signed_header(header, 0, tag.unwrap_or(0)), length];
        let came = self.transport.receive(awaited, payload, limit.deadline());
        let came = came.map_err(|source| self.failed(opcode, source, limit))?;
        let is_from_here =
            tag.is_none_or(|tag| answer_tag(came[0]) == tag && u32::from(answer_engine(came[0])) < self.engines);
        if !is_begun_as(came, awaited) || !is_from_here {
            return Err(self.distrust(opcode, fault_of(came, opcode, words)));
        }
        if Instant::now() > limit.deadline() {
            return Err(self.late(opcode, limit));
        }
        Ok(())
    }

    /// Tries to bring the device back after this error. `true` means that it is as after its reset, so the job may be
    /// sent once more; `false` means that the error stands.
    ///
    /// A wrong answer may be the trace of a reset that cut an answer short, so that the words of the next one came in
    /// the place of its rest.
    pub(crate) fn recover(&mut self, error: &Error, limit: Limit) -> Result<bool, Error> {
        let may_be_reset = match error {
            Error::Link { .. } => true,
            Error::Device { fault, .. } => !matches!(fault, DeviceFault::AllStuck { .. }),
            _ => false,
        };
        if !may_be_reset {
            return Ok(false);
        }
        let during = "the restart";
        let is_back = self.transport.recover(limit.deadline()).map_err(|source| match source {
            TransportError::Timeout { .. } => limit.missed(self.name(), during),
            source => Error::Link { device: self.name(), during, source },
        })?;
        self.is_out_of_step &= !is_back;
        if is_back {
            self.awaited.clear();
        }
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
        limit.missed(self.name(), opcode_name(opcode))
    }
}

/// The fault of an answer to `opcode` that does not begin with the header and the length of `words` words.
fn fault_of(came: AnswerHead, opcode: Opcode, words: u32) -> DeviceFault {
    let [header, length] = came;
    let status = answer_status(header);
    match Status::from_u8(status) {
        _ if answer_opcode(header) != opcode as u8 => {}
        None => {}
        Some(Status::Ok) if length == words => {}
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
        Opcode::Locate | Opcode::Interpolate | Opcode::Nearest => "the questions about places",
        Opcode::InsertAs | Opcode::Delete | Opcode::Move => "the changes of vertices",
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
        Status::BadContexts => "the contexts that were asked for are more than it has, or the jobs do not divide them",
        Status::Stuck => "insertions have stopped making progress",
        Status::NoMesh => "there is no mesh to ask or change",
    }
}
