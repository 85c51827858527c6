//! The two streams of a card. Calls on both block, so each stream has a thread.

use std::collections::VecDeque;
use std::io::{self, ErrorKind, Read, Write};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use incircle_protocol::ANSWER_HEAD_WORDS;

use super::buffer::{PageBuffer, Pool};
use super::fault::PcieFault;

/// Most bytes of one transfer.
pub(super) const MOST_MOVED: usize = 1 << 20;
/// Bytes of a word of the protocol.
pub(super) const WORD: usize = 4;
/// Nouns for the call under way, for messages.
const WRITING: &str = "the writing of commands";
const READING: &str = "the reading of answers";

/// Error of XDMA after its timeout. The code is internal to the kernel and should not get out, but does.
const ERESTARTSYS: i32 = 512;
/// Errors of `errno.h` for a DMA engine after its timeout (`EIO`) and for a card that is gone.
const EIO: i32 = 5;
const ENXIO: i32 = 6;
const ENODEV: i32 = 19;

/// The state that the two threads and the caller share.
#[derive(Debug, Default)]
pub(super) struct State {
    /// Commands that are not written yet, in whole beats.
    commands: VecDeque<PageBuffer>,
    /// Bytes of `commands` and of the commands being written.
    queued: usize,
    /// Upper bound, in words, on each answer that is to come.
    due: VecDeque<u64>,
    /// Answers that came and have not been taken.
    pieces: VecDeque<PageBuffer>,
    pool: Pool,
    fault: Option<PcieFault>,
    /// Whether the writer is at a command.
    is_writing: bool,
    /// Whether the reader is at an answer.
    is_reading: bool,
    /// Number of restarts. The outcome of a call that began in an earlier epoch is dropped.
    epoch: u64,
    /// Number of transfers, and of their ends.
    progress: u64,
    /// Whether the threads shall end.
    ends: bool,
}

impl State {
    /// Whether all commands are with the card.
    pub fn is_all_written(&self) -> bool {
        self.commands.is_empty() && !self.is_writing
    }

    /// Whether no answer is to come.
    pub fn is_all_read(&self) -> bool {
        self.due.is_empty() && !self.is_reading
    }

    /// Whether a piece of an answer is there.
    pub fn has_piece(&self) -> bool {
        !self.pieces.is_empty()
    }

    /// Whether a fault has stopped the streams.
    pub fn has_fault(&self) -> bool {
        self.fault.is_some()
    }

    /// Takes the next piece of an answer.
    pub fn piece(&mut self) -> Option<PageBuffer> {
        self.pieces.pop_front()
    }

    /// Takes back the buffer of a piece that was read.
    pub fn give_back(&mut self, piece: PageBuffer) {
        self.pool.give(piece);
    }

    /// Noun for the call that has not returned.
    pub fn call(&self) -> &'static str {
        if self.is_writing {
            WRITING
        } else {
            READING
        }
    }
}

/// The shared state with its two signals.
#[derive(Debug, Default)]
struct Shared {
    state: Mutex<State>,
    /// Signal to the threads that there is something to do.
    work: Condvar,
    /// Signal to the caller that something was done.
    news: Condvar,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until `work` finds something for a thread to do; `None` if the thread shall end.
    fn next<T>(&self, mut work: impl FnMut(&mut State) -> Option<T>) -> Option<T> {
        let mut state = self.lock();
        loop {
            if state.ends {
                return None;
            }
            if state.fault.is_none() {
                if let Some(work) = work(&mut state) {
                    return Some(work);
                }
            }
            state = self.work.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Counts a transfer. Returns false if the transfer began before a restart, so that nobody wants its outcome.
    fn moved(&self, epoch: u64) -> bool {
        let mut state = self.lock();
        state.progress += 1;
        self.news.notify_all();
        state.epoch == epoch
    }
}

/// The two streams of a card, with their threads.
#[derive(Debug)]
pub(super) struct Streams {
    shared: Arc<Shared>,
}

impl Streams {
    /// Starts the threads. `beat` is the number of bytes of a beat.
    pub fn new(commands: Box<dyn Write + Send>, answers: Box<dyn Read + Send>, beat: usize) -> Self {
        let shared = Arc::new(Shared::default());
        let writer = Writer { shared: Arc::clone(&shared), file: commands, beat };
        let reader = Reader { shared: Arc::clone(&shared), file: answers, beat };
        std::thread::spawn(move || writer.run());
        std::thread::spawn(move || reader.run());
        Self { shared }
    }

    /// Locks the shared state.
    pub fn lock(&self) -> MutexGuard<'_, State> {
        self.shared.lock()
    }

    /// The fault that stopped the streams.
    pub fn fault(&self) -> Option<PcieFault> {
        self.lock().fault.clone()
    }

    /// A buffer for commands of this many bytes, which must be whole beats.
    pub fn buffer(&self, bytes: usize) -> PageBuffer {
        self.lock().pool.take(bytes)
    }

    /// Queues commands, and for each answer that is due an upper bound on its words.
    pub fn queue(&self, commands: Option<PageBuffer>, answers: impl IntoIterator<Item = u64>) {
        let mut state = self.lock();
        if let Some(commands) = commands {
            state.queued += commands.bytes().len();
            state.commands.push_back(commands);
        }
        state.due.extend(answers);
        self.shared.work.notify_all();
    }

    /// Bytes of commands that are not with the card yet.
    pub fn queued(&self) -> usize {
        self.lock().queued
    }

    /// Number of transfers, and of their ends, so far.
    pub fn progress(&self) -> u64 {
        self.lock().progress
    }

    /// Waits, for at most `time`, until the progress differs from `seen`; false if it does not.
    pub fn wait(&self, seen: u64, time: Duration) -> bool {
        let state = self.lock();
        let waited = self.shared.news.wait_timeout_while(state, time, |state| state.progress == seen);
        waited.unwrap_or_else(PoisonError::into_inner).0.progress != seen
    }

    /// Forgets everything. Calls that the threads have begun go on, and their outcome is dropped.
    pub fn forget(&self) {
        let mut state = self.lock();
        let State { commands, pieces, due, .. } = &mut *state;
        commands.clear();
        pieces.clear();
        due.clear();
        state.queued = 0;
        state.fault = None;
        state.epoch += 1;
        self.shared.work.notify_all();
    }

    /// Waits until `is_so` holds, or until the deadline. Returns whether it holds.
    pub fn wait_until(&self, deadline: Instant, is_so: impl Fn(&State) -> bool) -> bool {
        let left = deadline.saturating_duration_since(Instant::now());
        let waited = self.shared.news.wait_timeout_while(self.lock(), left, |state| !is_so(state));
        is_so(&waited.unwrap_or_else(PoisonError::into_inner).0)
    }

    /// Ends the threads as soon as their calls return.
    pub fn end(&self) {
        self.lock().ends = true;
        self.shared.work.notify_all();
    }
}

/// The fault of a failed call.
fn fault_of(call: &'static str, error: &io::Error) -> PcieFault {
    match error.raw_os_error() {
        Some(errno @ (EIO | ERESTARTSYS)) => PcieFault::EngineTimedOut { call, errno },
        Some(ENXIO | ENODEV) => PcieFault::Gone,
        _ => PcieFault::Call { call, reason: error.to_string() },
    }
}

/// The thread that writes commands.
struct Writer {
    shared: Arc<Shared>,
    file: Box<dyn Write + Send>,
    beat: usize,
}

impl Writer {
    fn run(mut self) {
        let shared = Arc::clone(&self.shared);
        let next = |state: &mut State| {
            let commands = state.commands.pop_front()?;
            state.is_writing = true;
            Some((commands, state.epoch))
        };
        while let Some((commands, epoch)) = shared.next(next) {
            let result = self.write(commands.bytes(), epoch);
            let mut state = shared.lock();
            state.is_writing = false;
            if state.epoch == epoch {
                state.queued -= commands.bytes().len();
                state.fault = state.fault.take().or(result.err());
            }
            state.pool.give(commands);
            state.progress += 1;
            shared.news.notify_all();
        }
    }

    fn write(&mut self, bytes: &[u8], epoch: u64) -> Result<(), PcieFault> {
        let mut rest = bytes;
        while !rest.is_empty() {
            let written = match self.file.write(&rest[..rest.len().min(MOST_MOVED)]) {
                Ok(0) => return Err(PcieFault::Ended { call: WRITING }),
                Ok(written) => written,
                Err(error) if error.kind() == ErrorKind::Interrupted => continue,
                Err(error) => return Err(fault_of(WRITING, &error)),
            };
            if written % self.beat != 0 || written > rest.len() {
                let reason = format!("{written} bytes were taken, which are no whole beats of {} bytes", self.beat);
                return Err(PcieFault::Call { call: WRITING, reason });
            }
            rest = &rest[written..];
            if !self.shared.moved(epoch) {
                break;
            }
        }
        Ok(())
    }
}

/// The thread that reads answers.
struct Reader {
    shared: Arc<Shared>,
    file: Box<dyn Read + Send>,
    beat: usize,
}

impl Reader {
    fn run(mut self) {
        let shared = Arc::clone(&self.shared);
        let next = |state: &mut State| {
            let words = state.due.pop_front()?;
            state.is_reading = true;
            Some((words, state.epoch))
        };
        while let Some((words, epoch)) = shared.next(next) {
            let result = self.read_answer(words, epoch);
            let mut state = shared.lock();
            state.is_reading = false;
            if state.epoch == epoch {
                state.fault = state.fault.take().or(result.err());
            }
            state.progress += 1;
            shared.news.notify_all();
        }
    }

    /// Bytes of the whole beats that hold this many words.
    fn bytes_of(&self, words: u64) -> u64 {
        words.saturating_mul(WORD as u64).next_multiple_of(self.beat as u64)
    }

    /// Reads an answer of at most `most` words. The second word of an answer gives its length.
    fn read_answer(&mut self, most: u64, epoch: u64) -> Result<(), PcieFault> {
        let mut length = None;
        let mut came = 0;
        loop {
            let end = self.bytes_of(length.unwrap_or(most));
            let size = usize::try_from(end - came).unwrap_or(MOST_MOVED).min(MOST_MOVED);
            let mut piece = self.shared.lock().pool.take(size);
            let filled = self.fill(&mut piece, most, &mut length, came)?;
            // The rest of the last beat is padding.
            let words = length.map_or(filled, |length| filled.min((length * WORD as u64 - came) as usize));
            piece.truncate(words);
            came += filled as u64;
            let mut state = self.shared.lock();
            if state.epoch != epoch {
                return Ok(());
            }
            state.pieces.push_back(piece);
            state.progress += 1;
            self.shared.news.notify_all();
            if length.is_some_and(|length| came >= self.bytes_of(length)) {
                return Ok(());
            }
        }
    }

    /// Fills a piece, up to the end of the answer. A read may be short before the end, so only the length tells where
    /// the answer ends. Returns the number of bytes filled.
    fn fill(
        &mut self,
        piece: &mut PageBuffer,
        most: u64,
        length: &mut Option<u64>,
        before: u64,
    ) -> Result<usize, PcieFault> {
        let size = piece.bytes().len();
        let mut filled = 0;
        while filled < size {
            filled += match self.file.read(&mut piece.bytes_mut()[filled..]) {
                Ok(0) => return Err(PcieFault::Ended { call: READING }),
                Ok(read) => read.min(size - filled),
                Err(error) if error.kind() == ErrorKind::Interrupted => continue,
                Err(error) => return Err(fault_of(READING, &error)),
            };
            if length.is_none() {
                *length = announced(piece.bytes().get(..filled).unwrap_or_default()).map(|words| words.min(most));
            }
            let Some(words) = *length else {
                continue;
            };
            let (came, end) = (before + filled as u64, self.bytes_of(words));
            if came > end {
                return Err(PcieFault::Endless { announced: words, came: came / WORD as u64 });
            }
            if came == end {
                break;
            }
        }
        Ok(filled)
    }
}

/// Words of the answer that begins with these bytes, once the word with its length is there.
fn announced(bytes: &[u8]) -> Option<u64> {
    let word = bytes.get(WORD..2 * WORD)?;
    let payload = u32::from_le_bytes([word[0], word[1], word[2], word[3]]);
    Some(ANSWER_HEAD_WORDS as u64 + u64::from(payload))
}
