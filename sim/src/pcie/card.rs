//! The behaviour behind the files of a card: streams that block as those of the driver XDMA do, registers, and faults.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use incircle_protocol::{StreamRegister, CONTROL_RESET};

use super::beats::Beats;
use super::faults::{CardFaultSpec, Strike};
use super::liar::Liar;
use crate::faults::Random;

/// Value that every register of a vanished card reads as.
const ALL_ONES: u32 = u32::MAX;
/// Longest sleep of a call that waits.
const NAP: Duration = Duration::from_millis(100);
/// Time for which a call that makes progress leaves the card to others that wait for it.
const TURN: Duration = Duration::from_micros(50);
/// Number of extra beats behind an answer that hides its end.
const EXTRA_BEATS: usize = 4;
const EXTRA_BYTE: u8 = 0x5a;

/// An error number of the operating system, as the driver returns it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Errno(pub i32);

impl Errno {
    /// Input or output failed.
    pub const IO: Self = Self(5);
    /// The device does not exist.
    pub const NO_DEVICE: Self = Self(19);
    /// The call is invalid: a write to a read-only register.
    pub const INVALID: Self = Self(22);
    /// The kernel-internal code 512, which XDMA returns when a transfer has timed out.
    pub const RESTART: Self = Self(512);
}

/// The figures of a card.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CardFigures {
    /// Number of bytes of commands.
    pub to_card: u64,
    /// Number of bytes of answers.
    pub to_host: u64,
    /// Number of faults so far.
    pub faults: u64,
}

/// A card behind its driver.
pub struct Card {
    inside: Mutex<Inside>,
    /// Number of calls that wait for the mutex or for progress. The mutex is not fair: a call that lets go of it and
    /// takes it again at once would leave them outside.
    waiting: AtomicUsize,
    changed: Condvar,
    timeout: Duration,
}

struct Inside {
    device: Box<dyn Beats>,
    spec: CardFaultSpec,
    random: Random,
    liar: Liar,
    /// Number of bytes still to be sent that only follow an answer because it hides its end.
    extra: usize,
    /// The next fault that strikes after a number of bytes, with that number, and how many times one still strikes.
    strike: Option<(Strike, u64)>,
    times: u64,
    figures: CardFigures,
    is_gone: bool,
    is_closed: bool,
}

impl Inside {
    fn moved(&self) -> u64 {
        self.figures.to_card + self.figures.to_host
    }

    /// Number of bytes, in whole beats, until the next fault; 0 if it is due.
    fn until_strike(&self) -> usize {
        let Some((_, after)) = self.strike else {
            return usize::MAX;
        };
        let left = after.saturating_sub(self.moved());
        usize::try_from(left).unwrap_or(usize::MAX / 2).next_multiple_of(self.device.beat_bytes())
    }

    /// Applies the fault that is due, if any. Sets `stands` if the transfer stops making progress.
    fn strike(&mut self, stands: &mut Option<Strike>) -> Result<(), Errno> {
        let Some((strike, after)) = self.strike.filter(|strike| self.moved() >= strike.1) else {
            return Ok(());
        };
        self.times = self.times.saturating_sub(1);
        let again = self.spec.strike.filter(|_| self.times > 0);
        self.strike = again.map(|(strike, every)| (strike, after + every.max(1)));
        self.figures.faults += 1;
        match strike {
            Strike::Eio => return Err(Errno::IO),
            Strike::Errno512 => return Err(Errno::RESTART),
            Strike::Timeout | Strike::Hang => *stands = Some(strike),
            Strike::Vanish => {
                self.is_gone = true;
                return Err(Errno::NO_DEVICE);
            }
            Strike::Reset => self.reset(),
        }
        Ok(())
    }

    /// The size of a transfer of `bytes`: by chance, only a part of it.
    fn shorten(&mut self, bytes: usize, chance: f64) -> usize {
        let beat = self.device.beat_bytes();
        let beats = u32::try_from(bytes / beat).unwrap_or(u32::MAX);
        if beats < 2 || !self.random.happens(chance) {
            return bytes;
        }
        self.figures.faults += 1;
        (1 + self.random.below(beats - 1) as usize) * beat
    }

    fn reset(&mut self) {
        // Every device has this register, so the write cannot fail.
        let _ = self.device.write(StreamRegister::Control.offset(), CONTROL_RESET);
        self.liar.reset();
        self.extra = 0;
    }

    fn take(&mut self, bytes: &[u8]) -> usize {
        let bytes = &bytes[..bytes.len().min(self.until_strike())];
        let taken = self.device.take(bytes);
        self.figures.to_card += taken as u64;
        taken
    }

    /// Gives beats: their bytes, and whether an answer ends with them.
    fn give(&mut self, bytes: &mut [u8]) -> (usize, bool) {
        let room = bytes.len().min(self.until_strike());
        let bytes = &mut bytes[..room];
        if self.extra > 0 {
            let extra = self.extra.min(bytes.len());
            bytes[..extra].fill(EXTRA_BYTE);
            self.extra -= extra;
            return (extra, false);
        }
        let given = self.device.give(bytes);
        self.liar.change(&mut bytes[..given.bytes], given.is_end);
        if given.is_end && self.spec.lie.is_some_and(|lie| lie.hides_the_end(self.liar.opcode)) {
            self.extra = EXTRA_BEATS * self.device.beat_bytes();
        }
        self.figures.to_host += given.bytes as u64;
        (given.bytes, given.is_end)
    }
}

/// The progress of a transfer after one step.
enum Step {
    Done,
    Moved,
    Waits,
}

impl Card {
    /// A card around this device, with the faults of `spec`.
    pub fn new(device: Box<dyn Beats>, spec: &CardFaultSpec) -> Self {
        let inside = Inside {
            device,
            random: Random::new(spec.seed),
            liar: Liar::new(spec.lie),
            extra: 0,
            strike: spec.strike.filter(|_| spec.times > 0),
            times: spec.times,
            figures: CardFigures::default(),
            is_gone: false,
            is_closed: false,
            spec: spec.clone(),
        };
        let (inside, waiting, changed) = (Mutex::new(inside), AtomicUsize::new(0), Condvar::new());
        Self { inside, waiting, changed, timeout: Duration::from_millis(spec.timeout_ms) }
    }

    fn lock(&self) -> MutexGuard<'_, Inside> {
        self.waiting.fetch_add(1, Ordering::Relaxed);
        let inside = self.inside.lock().unwrap_or_else(PoisonError::into_inner);
        self.waiting.fetch_sub(1, Ordering::Relaxed);
        inside
    }

    /// Writes commands, and returns when the card has all of them.
    ///
    /// # Errors
    /// The error number that the driver would return.
    pub fn write(&self, bytes: &[u8]) -> Result<usize, Errno> {
        let mut inside = self.lock();
        let chance = inside.spec.short_write;
        let wanted = inside.shorten(bytes.len(), chance);
        let mut done = 0;
        self.transfer(inside, |inside| {
            let taken = inside.take(&bytes[done..wanted]);
            done += taken;
            match (done == wanted, taken) {
                (true, _) => Step::Done,
                (_, 0) => Step::Waits,
                _ => Step::Moved,
            }
        })?;
        Ok(done)
    }

    /// Reads answers, and returns when all that was asked for has come, or at the end of an answer.
    ///
    /// # Errors
    /// The error number that the driver would return.
    pub fn read(&self, bytes: &mut [u8]) -> Result<usize, Errno> {
        let mut inside = self.lock();
        let chance = inside.spec.short_read;
        // The driver transfers whole beats only.
        let whole = bytes.len() / inside.device.beat_bytes() * inside.device.beat_bytes();
        let wanted = inside.shorten(whole, chance);
        let mut done = 0;
        self.transfer(inside, |inside| {
            let (given, is_end) = inside.give(&mut bytes[done..wanted]);
            done += given;
            match (done == wanted || is_end, given) {
                (true, _) => Step::Done,
                (_, 0) => Step::Waits,
                _ => Step::Moved,
            }
        })?;
        Ok(done)
    }

    /// Repeats a step until the transfer is done, has timed out, or is ended by a fault.
    fn transfer<'c>(
        &'c self,
        mut inside: MutexGuard<'c, Inside>,
        mut step: impl FnMut(&mut Inside) -> Step,
    ) -> Result<(), Errno> {
        inside = self.stall(inside);
        let deadline = Instant::now() + self.timeout;
        let mut stands = None;
        loop {
            if inside.is_gone || inside.is_closed {
                return Err(Errno::NO_DEVICE);
            }
            inside.strike(&mut stands)?;
            let left = deadline.saturating_duration_since(Instant::now());
            if left.is_zero() && stands != Some(Strike::Hang) {
                return Err(Errno::RESTART);
            }
            let goes_on = stands.is_none()
                && match step(&mut inside) {
                    Step::Done => {
                        self.changed.notify_all();
                        return Ok(());
                    }
                    Step::Moved => true,
                    Step::Waits => inside.device.run(),
                };
            if goes_on {
                // Another call may be waiting for this progress.
                self.changed.notify_all();
                drop(inside);
                match self.waiting.load(Ordering::Relaxed) {
                    0 => std::thread::yield_now(),
                    _ => std::thread::sleep(TURN),
                }
                inside = self.lock();
            } else {
                let nap = if left.is_zero() { NAP } else { left.min(NAP) };
                self.waiting.fetch_add(1, Ordering::Relaxed);
                inside = self.changed.wait_timeout(inside, nap).unwrap_or_else(PoisonError::into_inner).0;
                self.waiting.fetch_sub(1, Ordering::Relaxed);
            }
        }
    }

    /// Waits, by chance, before a transfer begins.
    fn stall<'c>(&'c self, mut inside: MutexGuard<'c, Inside>) -> MutexGuard<'c, Inside> {
        let (chance, milliseconds) = inside.spec.stall;
        if !inside.random.happens(chance) {
            return inside;
        }
        inside.figures.faults += 1;
        drop(inside);
        std::thread::sleep(Duration::from_millis(milliseconds));
        self.lock()
    }

    /// Reads the register at this byte offset.
    ///
    /// # Errors
    /// The error number that the driver would return.
    pub fn read_register(&self, offset: u32) -> Result<u32, Errno> {
        let mut inside = self.lock();
        if inside.is_closed {
            return Err(Errno::NO_DEVICE);
        }
        if inside.is_gone {
            return Ok(ALL_ONES);
        }
        let value = inside.device.read(offset).map_err(|_| Errno::IO)?;
        Ok(inside.spec.lie.map_or(value, |lie| lie.register(offset, value)))
    }

    /// Writes the register at this byte offset.
    ///
    /// # Errors
    /// The error number that the driver would return.
    pub fn write_register(&self, offset: u32, value: u32) -> Result<(), Errno> {
        let mut inside = self.lock();
        if inside.is_closed {
            return Err(Errno::NO_DEVICE);
        }
        if inside.is_gone {
            // A bus reports no error for a write to a card that has vanished.
            return Ok(());
        }
        if offset == StreamRegister::Control.offset() && value & CONTROL_RESET != 0 {
            inside.reset();
        } else {
            inside.device.write(offset, value).map_err(|_| Errno::INVALID)?;
        }
        self.changed.notify_all();
        Ok(())
    }

    /// Ends every call that waits, and every call to come.
    pub fn close(&self) {
        self.lock().is_closed = true;
        self.changed.notify_all();
    }

    /// The figures so far.
    pub fn figures(&self) -> CardFigures {
        self.lock().figures
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicBool;
    use std::sync::Arc;

    use incircle_model::stream::{BusError, Given};

    use super::*;

    /// A device that is always at work and never has an answer. It counts the slices of its time.
    struct Busy {
        slices: Arc<AtomicUsize>,
    }

    impl Beats for Busy {
        fn take(&mut self, bytes: &[u8]) -> usize {
            bytes.len()
        }

        fn give(&mut self, _: &mut [u8]) -> Given {
            Given::default()
        }

        fn read(&mut self, _: u32) -> Result<u32, BusError> {
            Ok(7)
        }

        fn write(&mut self, _: u32, _: u32) -> Result<(), BusError> {
            Ok(())
        }

        fn beat_bytes(&self) -> usize {
            8
        }

        fn run(&mut self) -> bool {
            self.slices.fetch_add(1, Ordering::Relaxed);
            std::thread::sleep(Duration::from_millis(1));
            true
        }
    }

    /// Between two accesses to a register a transfer that is under way may get a few slices, and not thousands.
    #[test]
    fn a_transfer_leaves_the_card_to_registers() {
        let slices = Arc::new(AtomicUsize::new(0));
        let device = Busy { slices: Arc::clone(&slices) };
        let card = Arc::new(Card::new(Box::new(device), &CardFaultSpec::default()));
        let has_begun = Arc::new(AtomicBool::new(false));
        let reader = {
            let (card, has_begun) = (Arc::clone(&card), Arc::clone(&has_begun));
            std::thread::spawn(move || {
                has_begun.store(true, Ordering::Relaxed);
                card.read(&mut [0; 8])
            })
        };
        while !has_begun.load(Ordering::Relaxed) || slices.load(Ordering::Relaxed) == 0 {
            std::thread::yield_now();
        }
        let before = slices.load(Ordering::Relaxed);
        for _ in 0..100 {
            assert_eq!(card.read_register(0), Ok(7));
        }
        let between = slices.load(Ordering::Relaxed) - before;
        card.close();
        assert_eq!(reader.join().expect("the reader ends"), Err(Errno::NO_DEVICE));
        assert!(between < 2_000, "{between} slices passed during 100 accesses");
    }
}
