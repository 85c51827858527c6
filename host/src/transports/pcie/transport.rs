//! A card in a PCIe slot as a transport.

use std::sync::mpsc::{channel, RecvTimeoutError};
use std::time::{Duration, Instant};

use incircle_protocol::{
    answer_engine, answer_opcode, answer_status, answer_tag, triangle_capacity, Command, Identity, Layout, RecordRange,
    Status, StreamRegister, ANSWER_HEAD_WORDS, IDENTITY_WORDS, LATENCY_BUCKETS, STREAM_STATUS_BUSY,
};

use super::address::CardAddress;
use super::buffer::PageBuffer;
use super::fault::{CardFault, PcieFault};
use super::files::{open, CardFiles};
use super::left_behind::record_abandoned_call;
use super::registers::{CardRegisters, Registers};
use super::streams::{Streams, MOST_MOVED, WORD};
use crate::error::{Error, TransportError};
use crate::transports::transport::{receive_in_pieces, receive_next_in_pieces, AnswerHead, Capabilities, Transport};

/// Time limit for opening the files, and for a reset.
const OPEN: Duration = Duration::from_secs(5);
/// Most bytes of commands that may wait for the card.
const MOST_QUEUED: usize = 2 * MOST_MOVED;
/// Time without progress after which the status register is read, to see whether the card is still at work.
const LOOK: Duration = Duration::from_millis(200);
/// Looks in a row that find the card at rest although an answer is due, after which the card has forgotten the command.
const IDLE_LOOKS: u32 = 2;
/// Time for a stream to come to rest after a reset, before the card is reset again or the stream is woken.
const SETTLE: Duration = Duration::from_millis(5);
/// Time limit for calls that are under way when the transport is dropped.
const GOODBYE: Duration = Duration::from_millis(300);
/// Value of every register of a card that is gone.
const ALL_ONES: u32 = u32::MAX;

/// The transport to a card in a PCIe slot.
///
/// Commands are written while answers are read. `submit` returns as soon as its commands wait for the card, so further
/// commands may be sent before an answer is taken. Opening a card resets it.
pub struct PcieTransport {
    name: String,
    registers: Registers,
    streams: Streams,
    identity: Identity,
    /// Bytes of a beat.
    beat: usize,
    layout: Layout,
    /// Piece of an answer that has been taken in part.
    piece: Option<PageBuffer>,
    /// Bytes of `piece` that have been taken.
    taken: usize,
    fault: Option<PcieFault>,
}

impl PcieTransport {
    /// Opens a card of this system: locks it, checks its registers and resets it.
    ///
    /// # Errors
    /// [`Error::Open`] with a [`CardFault`] if the system refuses, and the errors of [`PcieTransport::new`].
    pub fn open(address: &CardAddress) -> Result<Self, Error> {
        let (sender, opened) = channel();
        let of = address.clone();
        // Even opening a file may hang, so a thread of its own does it.
        std::thread::spawn(move || sender.send(open(&of)));
        let opened = opened.recv_timeout(OPEN).unwrap_or_else(|error| {
            if error == RecvTimeoutError::Timeout {
                record_abandoned_call();
            }
            Err(CardFault::Hangs { within: OPEN })
        });
        let files = opened.map_err(|fault| Error::Open { device: address.to_string(), source: fault.into() })?;
        Self::new(address.to_string(), files)
    }

    /// Makes a transport of the three files of a card: checks the registers and resets the card.
    ///
    /// # Errors
    /// [`Error::Link`] if the registers are not those of a sound card, or if the reset does not end.
    pub fn new(name: String, files: CardFiles) -> Result<Self, Error> {
        let CardFiles { commands, answers, registers } = files;
        let mut registers = Registers::new(registers);
        let greeted = registers.identify().and_then(|found| {
            registers.reset(Instant::now() + OPEN)?;
            Ok(found)
        });
        let (identity, beat) = greeted.map_err(|fault| Error::Link {
            device: name.clone(),
            during: "the opening",
            source: fault.into(),
        })?;
        Ok(Self {
            name,
            registers,
            streams: Streams::new(commands, answers, beat),
            identity,
            beat,
            layout: Layout::of(identity.coord_bits, identity.capacity),
            piece: None,
            taken: 0,
            fault: None,
        })
    }

    /// Reads the registers of the card, for a diagnosis.
    ///
    /// # Errors
    /// [`Error::Link`] if the registers do not answer, or not as those of a sound card.
    pub fn registers(&mut self) -> Result<CardRegisters, Error> {
        let failed = |fault: PcieFault| Error::Link {
            device: self.name.clone(),
            during: "the reading of registers",
            source: fault.into(),
        };
        self.registers.all().map_err(failed)
    }

    /// Keeps a fault, after which only a reset helps, and turns it into an error. The fault of a call may mean that the
    /// card is gone, so its presence is checked.
    fn fail(&mut self, fault: PcieFault) -> TransportError {
        let fault = match fault {
            PcieFault::EngineTimedOut { .. } | PcieFault::Call { .. } | PcieFault::Ended { .. } => {
                self.registers.check_presence().err().unwrap_or(fault)
            }
            fault => fault,
        };
        self.fault = Some(fault.clone());
        fault.into()
    }

    /// Checks, after a time without progress, that the card is there and at work. `idle` counts the looks in a row that
    /// find it at rest.
    fn look(&mut self, idle: &mut u32) -> Result<(), PcieFault> {
        let is_all_written = self.streams.lock().is_all_written();
        let status = self.registers.read(StreamRegister::Status)?;
        if status == ALL_ONES {
            return Err(PcieFault::Gone);
        }
        if is_all_written && status & STREAM_STATUS_BUSY == 0 {
            *idle += 1;
            if *idle >= IDLE_LOOKS {
                return Err(PcieFault::Forgotten);
            }
        } else {
            *idle = 0;
        }
        Ok(())
    }

    /// Waits until `ready` gives a result, and looks at the card while nothing happens. `None` if the deadline passes.
    fn wait<T>(
        &mut self,
        deadline: Instant,
        mut ready: impl FnMut(&mut Self) -> Option<T>,
    ) -> Result<Option<T>, TransportError> {
        let mut idle = 0;
        loop {
            let seen = self.streams.progress();
            if let Some(result) = ready(self) {
                return Ok(Some(result));
            }
            if let Some(fault) = self.streams.fault() {
                return Err(self.fail(fault));
            }
            let left = deadline.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Ok(None);
            }
            if self.streams.wait(seen, left.min(LOOK)) {
                idle = 0;
            } else if let Err(fault) = self.look(&mut idle) {
                return Err(self.fail(fault));
            }
        }
    }

    /// The words of these commands in whole beats. Padding fills the last beat.
    fn beats(&self, commands: &[Command<&[u32]>], words: usize) -> PageBuffer {
        let mut buffer = self.streams.buffer((words * WORD).next_multiple_of(self.beat));
        let mut rest = buffer.bytes_mut();
        for command in commands {
            let (head, count) = command.head();
            for words in [&head[..count], command.points()] {
                let (here, after) = rest.split_at_mut(words.len() * WORD);
                fill(here, words);
                rest = after;
            }
        }
        rest.fill(0);
        buffer
    }

    /// Copies words of answers that came, and returns their number.
    fn copy(&mut self, words: &mut [u32]) -> usize {
        let mut done = 0;
        while done < words.len() {
            let Some(piece) = self.piece.take().or_else(|| self.streams.lock().piece()) else {
                break;
            };
            let bytes = piece.bytes().get(self.taken..).unwrap_or_default();
            let here = (bytes.len() / WORD).min(words.len() - done);
            for (word, bytes) in words[done..done + here].iter_mut().zip(bytes.chunks_exact(WORD)) {
                *word = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
            }
            (done, self.taken) = (done + here, self.taken + here * WORD);
            if piece.bytes().len() - self.taken >= WORD {
                self.piece = Some(piece);
            } else {
                self.taken = 0;
                self.streams.lock().give_back(piece);
            }
        }
        done
    }

    /// Resets the card, gets both streams out of their calls, and begins again as after opening.
    fn restart(&mut self, deadline: Instant) -> Result<(), PcieFault> {
        let begun = Instant::now();
        (self.piece, self.taken) = (None, 0);
        if !self.still(deadline)? {
            return Err(PcieFault::Hangs { call: self.streams.lock().call(), within: begun.elapsed() });
        }
        self.streams.forget();
        self.reset(deadline)?;
        if self.registers.identify()? != (self.identity, self.beat) {
            let (name, found) = ("identity", self.registers.read(StreamRegister::CoreVersion)?);
            return Err(PcieFault::Register { name, found, wanted: "only the values before the reset" });
        }
        self.fault = None;
        Ok(())
    }

    fn reset(&mut self, deadline: Instant) -> Result<(), PcieFault> {
        self.registers.reset(deadline.min(Instant::now() + OPEN))
    }

    /// Brings both streams to rest. Returns false if one is in a call that does not return before the deadline.
    fn still(&mut self, deadline: Instant) -> Result<bool, PcieFault> {
        self.streams.forget();
        // After a reset the core takes the rest of a command for new commands, so it is reset until all is written.
        loop {
            self.reset(deadline)?;
            if self.streams.wait_until(Instant::now() + SETTLE, |state| state.is_all_written()) {
                break;
            }
            if Instant::now() >= deadline {
                return Ok(false);
            }
        }
        // A read may wait for an answer that the reset has removed. The answer to another command ends the call.
        while !self.streams.wait_until(Instant::now() + SETTLE, |state| state.is_all_read()) {
            if Instant::now() >= deadline {
                return Ok(false);
            }
            // The command that was to wake the reader may itself have failed, so each try begins with a reset.
            self.streams.forget();
            self.reset(deadline)?;
            if self.streams.lock().is_all_written() {
                self.wake();
            }
        }
        Ok(true)
    }

    /// Sends a `Hello`, whose answer wakes a reader that waits in a call.
    fn wake(&mut self) {
        let mut buffer = self.streams.buffer(self.beat);
        let bytes = buffer.bytes_mut();
        bytes.fill(0);
        let (hello, count) = Command::<()>::Hello.head();
        fill(&mut bytes[..WORD], &hello[..count]);
        self.streams.queue(Some(buffer), []);
    }
}

/// Writes words as bytes, low byte first.
fn fill(bytes: &mut [u8], words: &[u32]) {
    for (place, word) in bytes.chunks_exact_mut(WORD).zip(words) {
        place.copy_from_slice(&word.to_le_bytes());
    }
}

/// Whether an answer shows that the card was reset. After a reset the card has lost whole jobs, or takes the rest of a
/// command for new commands.
///
/// The signs are an answer to another command from engine 0, which takes all words before the first `Clear`; the tag of
/// another job; and `BadRange`: the host never asks for records beyond the number that the card reported, so the card
/// must have lost them.
fn is_out_of_step(awaited: AnswerHead, came: AnswerHead) -> bool {
    let ([awaited, _], [came, _]) = (awaited, came);
    match Status::from_u8(answer_status(came)) {
        Some(status) if answer_opcode(came) == answer_opcode(awaited) => {
            status == Status::BadRange || answer_tag(awaited) != 0 && answer_tag(came) != answer_tag(awaited)
        }
        Some(_) => answer_engine(came) == 0,
        None => false,
    }
}

impl PcieTransport {
    /// Words of the longest payload that an answer of this card may have.
    fn longest_payload(&self) -> u64 {
        let all = RecordRange { first: 0, count: triangle_capacity(self.identity.capacity) };
        Command::<()>::Read(all).payload_words(self.layout).max(LATENCY_BUCKETS as u64)
    }

    /// Fills the whole of `words` with the next words of answers.
    fn fill(&mut self, words: &mut [u32], deadline: Instant) -> Result<(), TransportError> {
        if let Some(fault) = &self.fault {
            return Err(fault.clone().into());
        }
        let wanted = words.len();
        let mut done = 0;
        // `Some(false)` ends the wait when more words are wanted than will come.
        let ready = |card: &mut Self| {
            done += card.copy(&mut words[done..]);
            if done == wanted {
                return Some(true);
            }
            let state = card.streams.lock();
            (state.is_all_read() && !state.has_piece() && !state.has_fault()).then_some(false)
        };
        match self.wait(deadline, ready)? {
            Some(true) => Ok(()),
            Some(false) => Err(TransportError::Closed { done, wanted }),
            None => Err(TransportError::Timeout { done, wanted }),
        }
    }
}

impl Transport for PcieTransport {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], deadline: Instant) -> Result<(), TransportError> {
        if let Some(fault) = &self.fault {
            return Err(fault.clone().into());
        }
        let wanted = commands.iter().map(Command::words).sum();
        let bytes = wanted * WORD;
        let has_room = |queued: usize| queued == 0 || queued + bytes <= MOST_QUEUED;
        if self.wait(deadline, |card| has_room(card.streams.queued()).then_some(()))?.is_none() {
            return Err(TransportError::Timeout { done: 0, wanted });
        }
        let beats = (wanted > 0).then(|| self.beats(commands, wanted));
        // Several engines answer in any order, so that any answer may come in the place of another.
        let longest = (self.identity.engines > 1).then(|| self.longest_payload());
        let payload = |command: &Command<_>| longest.unwrap_or_else(|| command.payload_words(self.layout));
        let most = |command: &Command<_>| ANSWER_HEAD_WORDS as u64 + payload(command);
        self.streams.queue(beats, commands.iter().map(most));
        Ok(())
    }

    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        let came = receive_in_pieces(head, payload, |words| self.fill(words, deadline))?;
        if is_out_of_step(head, came) {
            return Err(self.fail(PcieFault::Forgotten));
        }
        Ok(came)
    }

    fn receive_next(
        &mut self,
        words_of: &mut dyn FnMut(AnswerHead) -> Option<usize>,
        payload: &mut Vec<u32>,
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        let mut is_unknown = false;
        let mut words_of_known = |head| {
            let words = words_of(head);
            is_unknown = words.is_none();
            words
        };
        let came = receive_next_in_pieces(&mut words_of_known, payload, |words| self.fill(words, deadline))?;
        // A card that was reset takes words of points for commands. It answers them with the tag 0, which no job has,
        // unless one of the words looks like a `Clear`.
        if is_unknown && answer_tag(came[0]) == 0 && Status::from_u8(answer_status(came[0])).is_some() {
            return Err(self.fail(PcieFault::Forgotten));
        }
        Ok(came)
    }

    fn capabilities(&self) -> Capabilities {
        Capabilities { takes_ahead: true, any_order: true, ..Capabilities::default() }
    }

    fn recover(&mut self, deadline: Instant) -> Result<bool, TransportError> {
        // Without a fault here the session found an answer wrong, as after a reset in the middle of an answer.
        if self.fault.as_ref().is_some_and(|fault| !fault.is_passing()) {
            return Ok(false);
        }
        self.restart(deadline).map_err(|fault| self.fail(fault))?;
        Ok(true)
    }
}

impl Drop for PcieTransport {
    /// Ends the calls that are under way, if possible, so that the next program finds the card free.
    fn drop(&mut self) {
        let is_at_rest = {
            let state = self.streams.lock();
            state.is_all_written() && state.is_all_read()
        };
        if !is_at_rest && self.restart(Instant::now() + GOODBYE).is_err() {
            record_abandoned_call();
        }
        self.streams.end();
    }
}

/// The answer to the `Hello` that wakes a reader must be longer than a beat, of 4 words at most, so that a read of one
/// beat ends. The reset that follows removes the rest of the answer.
const _: () = assert!(ANSWER_HEAD_WORDS + IDENTITY_WORDS > 4);
