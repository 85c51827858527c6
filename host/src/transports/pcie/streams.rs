//! The two streams of a card, a thread for each: both block in the system, at the same time.

use std::collections::VecDeque;
use std::io::{self, ErrorKind, Read, Write};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use incircle_protocol::ANSWER_HEAD_WORDS;

use super::buffer::{PageBuffer, Pool};
use super::fault::PcieFault;

/// Most bytes of a transfer.
pub(super) const MOST_MOVED: usize = 1 << 20;
/// Bytes of a word.
pub(super) const WORD: usize = 4;
/// What is under way, in messages.
const WRITING: &str = "the writing of commands";
const READING: &str = "the reading of answers";

/// What XDMA returns when its time is over: a code of the kernel's own, which should not come out of it.
const ERESTARTSYS: i32 = 512;
/// Of errno.h: an engine's time is over, or the card is gone.
const EIO: i32 = 5;
const ENXIO: i32 = 6;
const ENODEV: i32 = 19;

/// What the threads and the caller share.
#[derive(Debug, Default)]
pub(super) struct State {
    /// Whole beats of commands that are not written yet, and how many bytes that is with those being written.
    commands: VecDeque<PageBuffer>,
    queued: usize,
    /// Most words of the answers to come.
    due: VecDeque<u64>,
    /// Words of answers that came.
    pieces: VecDeque<PageBuffer>,
    pool: Pool,
    fault: Option<PcieFault>,
    /// The threads are at a command, or at an answer.
    is_writing: bool,
    is_reading: bool,
    /// Counts restarts: what a thread began before one is nobody's any more.
    epoch: u64,
    /// Counts transfers.
    progress: u64,
    /// No more is to be done.
    ends: bool,
}

impl State {
    /// True if all commands are with the card.
    pub fn is_all_written(&self) -> bool {
        self.commands.is_empty() && !self.is_writing
    }

    /// True if no answer is to come.
    pub fn is_all_read(&self) -> bool {
        self.due.is_empty() && !self.is_reading
    }

    /// True if a piece of answers is there.
    pub fn has_piece(&self) -> bool {
        !self.pieces.is_empty()
    }

    /// True if a fault has stopped the streams.
    pub fn has_fault(&self) -> bool {
        self.fault.is_some()
    }

    /// The next piece of answers.
    pub fn piece(&mut self) -> Option<PageBuffer> {
        self.pieces.pop_front()
    }

    /// Takes a piece back.
    pub fn give_back(&mut self, piece: PageBuffer) {
        self.pool.give(piece);
    }

    /// The call that has not returned.
    pub fn call(&self) -> &'static str {
        if self.is_writing {
            WRITING
        } else {
            READING
        }
    }
}

/// State and signals.
#[derive(Debug, Default)]
struct Shared {
    state: Mutex<State>,
    /// For the threads: there is something to do.
    work: Condvar,
    /// For the caller: something was done.
    news: Condvar,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until there is something for a thread; none at the end.
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

    /// After a transfer: false if it is nobody's any more.
    fn moved(&self, epoch: u64) -> bool {
        let mut state = self.lock();
        state.progress += 1;
        self.news.notify_all();
        state.epoch == epoch
    }
}

/// The two streams.
#[derive(Debug)]
pub(super) struct Streams {
    shared: Arc<Shared>,
}

impl Streams {
    /// Starts the threads.
    pub fn new(commands: Box<dyn Write + Send>, answers: Box<dyn Read + Send>, beat: usize) -> Self {
        let shared = Arc::new(Shared::default());
        let writer = Writer { shared: Arc::clone(&shared), file: commands, beat };
        let reader = Reader { shared: Arc::clone(&shared), file: answers, beat };
        std::thread::spawn(move || writer.run());
        std::thread::spawn(move || reader.run());
        Self { shared }
    }

    /// What is shared, now.
    pub fn lock(&self) -> MutexGuard<'_, State> {
        self.shared.lock()
    }

    /// The fault that stopped the streams.
    pub fn fault(&self) -> Option<PcieFault> {
        self.lock().fault.clone()
    }

    /// Bytes for commands: whole beats.
    pub fn buffer(&self, bytes: usize) -> PageBuffer {
        self.lock().pool.take(bytes)
    }

    /// Queues commands, and what answers they ask for.
    pub fn queue(&self, commands: Option<PageBuffer>, answers: impl IntoIterator<Item = u64>) {
        let mut state = self.lock();
        if let Some(commands) = commands {
            state.queued += commands.bytes().len();
            state.commands.push_back(commands);
        }
        state.due.extend(answers);
        self.shared.work.notify_all();
    }

    /// Bytes that are not with the card yet.
    pub fn queued(&self) -> usize {
        self.lock().queued
    }

    /// Transfers and ends of them so far.
    pub fn progress(&self) -> u64 {
        self.lock().progress
    }

    /// Waits, for so long, until there is more progress than that; false if there is none.
    pub fn wait(&self, seen: u64, time: Duration) -> bool {
        let state = self.lock();
        let waited = self.shared.news.wait_timeout_while(state, time, |state| state.progress == seen);
        waited.unwrap_or_else(PoisonError::into_inner).0.progress != seen
    }

    /// Forgets everything. What the threads have begun goes on, and is dropped when it ends.
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

    /// Waits until this is so, or until the deadline; true if it is.
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

    /// Bytes of the beats that hold so many words.
    fn bytes_of(&self, words: u64) -> u64 {
        words.saturating_mul(WORD as u64).next_multiple_of(self.beat as u64)
    }

    /// Reads an answer of at most so many words. Its second word says how many there are.
    fn read_answer(&mut self, most: u64, epoch: u64) -> Result<(), PcieFault> {
        let mut length = None;
        let mut came = 0;
        loop {
            let end = self.bytes_of(length.unwrap_or(most));
            let size = usize::try_from(end - came).unwrap_or(MOST_MOVED).min(MOST_MOVED);
            let mut piece = self.shared.lock().pool.take(size);
            let filled = self.fill(&mut piece, most, &mut length, came)?;
            // The rest of the last beat is no word.
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

    /// Fills a piece, or what the end of the answer leaves of it. A read may be short without an end: only the length
    /// tells.
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

/// Words of the answer that begins so, once that can be told.
fn announced(bytes: &[u8]) -> Option<u64> {
    let word = bytes.get(WORD..2 * WORD)?;
    let payload = u32::from_le_bytes([word[0], word[1], word[2], word[3]]);
    Some(ANSWER_HEAD_WORDS as u64 + u64::from(payload))
}
