//! A card as a transport.

use std::sync::mpsc::{channel, RecvTimeoutError};
use std::time::{Duration, Instant};

use incircle_protocol::{
    answer_opcode, answer_status, Command, Identity, Layout, Status, StreamRegister, ANSWER_HEAD_WORDS, IDENTITY_WORDS,
    STREAM_STATUS_BUSY,
};

use super::address::CardAddress;
use super::buffer::PageBuffer;
use super::fault::{CardFault, PcieFault};
use super::files::{open, CardFiles};
use super::left_behind::note_call;
use super::registers::{CardRegisters, Registers};
use super::streams::{Streams, MOST_MOVED, WORD};
use crate::error::{Error, TransportError};
use crate::transports::transport::{receive_in_pieces, AnswerHead, Capabilities, Transport};

/// Time for opening the files, and for a reset.
const OPEN: Duration = Duration::from_secs(5);
/// Bytes of commands that may wait for the card.
const MOST_QUEUED: usize = 2 * MOST_MOVED;
/// Time without news after which the registers are asked whether the card is still at work.
const LOOK: Duration = Duration::from_millis(200);
/// Looks in a row that find it at rest, though an answer is due, until it counts as having forgotten.
const IDLE_LOOKS: u32 = 2;
/// Time for a stream to come to rest after a reset, until it is reset again or woken.
const SETTLE: Duration = Duration::from_millis(5);
/// Time for calls that are under way when the transport is dropped.
const GOODBYE: Duration = Duration::from_millis(300);
/// What reads as all ones is gone.
const ALL_ONES: u32 = u32::MAX;

/// A device in a PCIe slot.
///
/// Commands are written while answers are read: `submit` returns when its commands wait for the card, so the next may
/// be sent before the answer to the last is taken. The card is reset when it is opened.
pub struct PcieTransport {
    name: String,
    registers: Registers,
    streams: Streams,
    identity: Identity,
    /// Bytes of a beat.
    beat: usize,
    layout: Layout,
    /// Words that came and were not taken, and bytes of them that were.
    piece: Option<PageBuffer>,
    taken: usize,
    fault: Option<PcieFault>,
}

impl PcieTransport {
    /// Opens a card of this system, locks it, looks at its registers and resets it.
    ///
    /// # Errors
    /// [`Error::Open`] where the system refuses, with what to do about it, and the errors of [`PcieTransport::new`].
    pub fn open(address: &CardAddress) -> Result<Self, Error> {
        let (sender, opened) = channel();
        let of = address.clone();
        // Opening may hang as any call.
        std::thread::spawn(move || sender.send(open(&of)));
        let opened = opened.recv_timeout(OPEN).unwrap_or_else(|error| {
            if error == RecvTimeoutError::Timeout {
                note_call();
            }
            Err(CardFault::Hangs { within: OPEN })
        });
        let files = opened.map_err(|fault| Error::Open { device: address.to_string(), source: fault.into() })?;
        Self::new(address.to_string(), files)
    }

    /// A card made of these files.
    ///
    /// # Errors
    /// [`Error::Link`] where the registers are not those of a sound card, or its reset does not end.
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

    /// What the registers say.
    ///
    /// # Errors
    /// [`Error::Link`] where they do not answer, or not as a sound card.
    pub fn registers(&mut self) -> Result<CardRegisters, Error> {
        let failed = |fault: PcieFault| Error::Link {
            device: self.name.clone(),
            during: "the reading of registers",
            source: fault.into(),
        };
        self.registers.all().map_err(failed)
    }

    /// Keeps a fault: there is nothing but a reset after it. One of a call may mean that the card is gone.
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

    /// After a time without news: is the card there, and at work?
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

    /// Waits until `ready` has something. While nothing happens, looks at the card.
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

    /// Commands in whole beats: padding fills the last.
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

    /// Copies words that came; says how many.
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

    /// Resets the card, gets both streams out of their calls, and begins anew.
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
            return Err(PcieFault::Register { name, found, wanted: "the values of before the reset" });
        }
        self.fault = None;
        Ok(())
    }

    fn reset(&mut self, deadline: Instant) -> Result<(), PcieFault> {
        self.registers.reset(deadline.min(Instant::now() + OPEN))
    }

    /// Brings both streams to rest; false if one is in a call that does not return.
    fn still(&mut self, deadline: Instant) -> Result<bool, PcieFault> {
        self.streams.forget();
        // The rest of a command goes to the core as if it were others, until all is written.
        loop {
            self.reset(deadline)?;
            if self.streams.wait_until(Instant::now() + SETTLE, |state| state.is_all_written()) {
                break;
            }
            if Instant::now() >= deadline {
                return Ok(false);
            }
        }
        // A read that waits for an answer that will never come is given another one.
        while !self.streams.wait_until(Instant::now() + SETTLE, |state| state.is_all_read()) {
            if Instant::now() >= deadline {
                return Ok(false);
            }
            // What woke it before may have failed.
            self.streams.forget();
            self.reset(deadline)?;
            if self.streams.lock().is_all_written() {
                self.wake();
            }
        }
        Ok(true)
    }

    /// Sends a `Hello` for whoever waits in a read.
    fn wake(&mut self) {
        let mut buffer = self.streams.buffer(self.beat);
        let bytes = buffer.bytes_mut();
        bytes.fill(0);
        let (hello, count) = Command::<()>::Hello.head();
        fill(&mut bytes[..WORD], &hello[..count]);
        self.streams.queue(Some(buffer), []);
    }
}

/// Words as bytes, low byte first.
fn fill(bytes: &mut [u8], words: &[u32]) {
    for (place, word) in bytes.chunks_exact_mut(WORD).zip(words) {
        place.copy_from_slice(&word.to_le_bytes());
    }
}

/// An answer to another command, or one that says that records which were there are not: the card has been reset, and
/// the rest of a command was taken for others. A host asks for no records that the card has not told of.
fn is_out_of_step(awaited: AnswerHead, came: AnswerHead) -> bool {
    let ([awaited, _], [came, _]) = (awaited, came);
    match Status::from_u8(answer_status(came)) {
        Some(status) if answer_opcode(came) == answer_opcode(awaited) => status == Status::BadRange,
        Some(_) => came & 0xffff == 0,
        None => false,
    }
}

impl PcieTransport {
    /// Fills the whole of `words` with the next words of answers.
    fn fill(&mut self, words: &mut [u32], deadline: Instant) -> Result<(), TransportError> {
        if let Some(fault) = &self.fault {
            return Err(fault.clone().into());
        }
        let wanted = words.len();
        let mut done = 0;
        // None: more is wanted than will come.
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
        let most = |command: &Command<_>| ANSWER_HEAD_WORDS as u64 + command.payload_words(self.layout);
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

    fn capabilities(&self) -> Capabilities {
        Capabilities { takes_ahead: true, ..Capabilities::default() }
    }

    fn recover(&mut self, deadline: Instant) -> Result<bool, TransportError> {
        if !self.fault.as_ref().is_some_and(PcieFault::is_passing) {
            return Ok(false);
        }
        self.restart(deadline).map_err(|fault| self.fail(fault))?;
        Ok(true)
    }
}

impl Drop for PcieTransport {
    /// Leaves no call behind, if that can be helped: who comes next finds the card free.
    fn drop(&mut self) {
        let is_at_rest = {
            let state = self.streams.lock();
            state.is_all_written() && state.is_all_read()
        };
        if !is_at_rest && self.restart(Instant::now() + GOODBYE).is_err() {
            note_call();
        }
        self.streams.end();
    }
}

/// A sound card's answer to the `Hello` that wakes a read is longer than a beat; the rest goes with the reset that
/// follows.
const _: () = assert!(ANSWER_HEAD_WORDS + IDENTITY_WORDS > 4);
