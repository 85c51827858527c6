//! A card in memory: the software model of the stream device behind three files like those of its driver.

use std::io::{self, Read, Write};
use std::sync::{Arc, Condvar, Mutex};
use std::time::{Duration, Instant};

use incircle::pcie::PcieTransport;
use incircle::transports::parts::{CardFiles, RegisterFile};
use incircle::Device;
use incircle_model::stream::{ModelCore, StreamModel};
use incircle_protocol::{Config, StreamRegister, SMALL};

/// Time after which the driver aborts a transfer. With XDMA it is 10 seconds.
const ENGINE: Duration = Duration::from_millis(400);
/// Error that the driver then returns.
const ERESTARTSYS: i32 = 512;

/// A device for 512 points with five contexts, behind a card with these faults.
pub fn card(beat_bits: u32, mischief: Mischief) -> Device {
    watched_card(beat_bits, mischief).0
}

/// The device of [`card`], and its card.
pub fn watched_card(beat_bits: u32, mischief: Mischief) -> (Device, MemoryCard) {
    let core = ModelCore::of(Config { points: 512, ..SMALL }).expect("possible").with_contexts(5);
    let card = MemoryCard::of(core, beat_bits, mischief);
    let transport = PcieTransport::new("pcie:memory".to_owned(), card.files()).expect("a sound card");
    (Device::from_transport(Box::new(transport)), card)
}

/// Faults that a test puts into the card. Reads and writes are numbered from 0.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mischief {
    /// The read of this number fails with this errno.
    pub bad_read: Option<(u32, i32)>,
    /// The write of this number fails with this errno.
    pub bad_write: Option<(u32, i32)>,
    /// The card is reset before the read of this number.
    pub reset: Option<u32>,
    /// The card is reset when this many bytes of commands have come.
    pub reset_after: Option<usize>,
    /// The card is gone from the read of this number on.
    pub gone: Option<u32>,
    /// Most bytes that a read brings.
    pub short: Option<usize>,
    /// This register reads as this value.
    pub register: Option<(StreamRegister, u32)>,
    /// Reads from this number on bring these bytes, again and again, in place of answers.
    pub babble: Option<(u32, [u8; 16])>,
    /// Nothing comes from the read of this number on, not even an error.
    pub silent: Option<u32>,
    /// The driver aborts a transfer after this time in place of the usual one.
    pub patience: Option<Duration>,
}

struct Inside {
    device: StreamModel<ModelCore>,
    mischief: Mischief,
    reads: u32,
    writes: u32,
    /// Bytes of commands that have come.
    taken: usize,
    gone: bool,
}

impl Inside {
    /// Takes bytes of commands, and returns the number of bytes that the device took.
    fn take(&mut self, bytes: &[u8]) -> usize {
        let until = self.mischief.reset_after.and_then(|after| after.checked_sub(self.taken)).unwrap_or(usize::MAX);
        let taken = self.device.take(&bytes[..bytes.len().min(until)]);
        self.taken += taken;
        if self.mischief.reset_after == Some(self.taken) {
            self.mischief.reset_after = None;
            self.device.reset();
        }
        taken
    }
}

/// A card in memory.
#[derive(Clone)]
pub struct MemoryCard {
    inside: Arc<(Mutex<Inside>, Condvar)>,
}

impl MemoryCard {
    pub fn new(config: Config, beat_bits: u32, mischief: Mischief) -> Self {
        Self::of(ModelCore::of(config).unwrap(), beat_bits, mischief)
    }

    /// A card with this core behind its beats.
    pub fn of(core: ModelCore, beat_bits: u32, mischief: Mischief) -> Self {
        let device = StreamModel::new(core, beat_bits);
        let inside = Inside { device, mischief, reads: 0, writes: 0, taken: 0, gone: false };
        Self { inside: Arc::new((Mutex::new(inside), Condvar::new())) }
    }

    /// Number of reads and of writes that were begun.
    pub fn transfers(&self) -> (u32, u32) {
        let inside = self.inside.0.lock().unwrap();
        (inside.reads, inside.writes)
    }

    pub fn files(&self) -> CardFiles {
        CardFiles {
            commands: Box::new(self.clone()),
            answers: Box::new(self.clone()),
            registers: Box::new(self.clone()),
        }
    }

    /// Repeats `step` until it gives a result, or until the driver's time is over.
    fn until<T>(&self, mut step: impl FnMut(&mut Inside) -> Option<io::Result<T>>) -> io::Result<T> {
        let (mutex, changed) = &*self.inside;
        let mut inside = mutex.lock().unwrap();
        let deadline = Instant::now() + inside.mischief.patience.unwrap_or(ENGINE);
        loop {
            if inside.gone {
                return Err(io::Error::from_raw_os_error(19));
            }
            if let Some(result) = step(&mut inside) {
                changed.notify_all();
                return result;
            }
            changed.notify_all();
            let left = deadline.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Err(io::Error::from_raw_os_error(ERESTARTSYS));
            }
            inside = changed.wait_timeout(inside, left).unwrap().0;
        }
    }
}

impl Write for MemoryCard {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut done = 0;
        let mut is_new = true;
        self.until(|inside| {
            if std::mem::take(&mut is_new) {
                inside.writes += 1;
                if let Some((_, errno)) = inside.mischief.bad_write.filter(|bad| bad.0 + 1 == inside.writes) {
                    return Some(Err(io::Error::from_raw_os_error(errno)));
                }
            }
            done += inside.take(&bytes[done..]);
            (done == bytes.len()).then_some(Ok(done))
        })
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Read for MemoryCard {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let most = self.inside.0.lock().unwrap().mischief.short.unwrap_or(usize::MAX);
        let length = bytes.len().min(most);
        let bytes = &mut bytes[..length];
        let mut done = 0;
        let mut is_new = true;
        let mut number = 0;
        let result = self.until(|inside| {
            if std::mem::take(&mut is_new) {
                number = inside.reads;
                inside.reads += 1;
                if let Some((_, errno)) = inside.mischief.bad_read.filter(|bad| bad.0 == number) {
                    return Some(Err(io::Error::from_raw_os_error(errno)));
                }
                if inside.mischief.reset == Some(number) {
                    inside.device.reset();
                }
                inside.gone = inside.mischief.gone == Some(number);
            }
            if let Some((_, noise)) = inside.mischief.babble.filter(|babble| number >= babble.0) {
                bytes.iter_mut().zip(noise.into_iter().cycle()).for_each(|(place, byte)| *place = byte);
                return Some(Ok(bytes.len()));
            }
            if inside.mischief.silent.is_some_and(|silent| number >= silent) {
                return None;
            }
            let given = inside.device.give(&mut bytes[done..]);
            done += given.bytes;
            (done == bytes.len() || given.is_end).then_some(Ok(done))
        });
        result
    }
}

impl RegisterFile for MemoryCard {
    fn read(&mut self, offset: u32) -> io::Result<u32> {
        let mut inside = self.inside.0.lock().unwrap();
        if inside.gone {
            return Ok(u32::MAX);
        }
        if let Some((_, value)) = inside.mischief.register.filter(|register| register.0.offset() == offset) {
            return Ok(value);
        }
        inside.device.read(offset).map_err(|_| io::Error::from_raw_os_error(5))
    }

    fn write(&mut self, offset: u32, value: u32) -> io::Result<()> {
        let (mutex, changed) = &*self.inside;
        let mut inside = mutex.lock().unwrap();
        changed.notify_all();
        inside.device.write(offset, value).map_err(|_| io::Error::from_raw_os_error(5))
    }
}
