//! One direction of a serial line, with faults. `FaultyLine` sits between a sender of bytes and a receiver of bits:
//! bytes go in, and symbols come out changed, late, twice or never.

use std::collections::VecDeque;

use incircle_protocol::{FRAME_END, MAX_PAYLOAD};

use super::random::Random;
use super::spec::{Chances, FaultSpec};
use super::Direction;
use crate::serial::{Symbol, SYMBOL_BITS};

/// Largest number of bytes that wait for the end of their frame. Longer runs are passed on in pieces, since noise may
/// never contain the end of a frame.
const LONGEST: usize = 2 * MAX_PAYLOAD;
/// Largest number of bytes of noise before a frame.
const BABBLE: u32 = 64;

/// An element of the queue of a line.
#[derive(Clone, Copy, Debug)]
enum Item {
    Byte(u8),
    /// An idle line for this many nanoseconds.
    Pause(u64),
}

/// One direction of a line with faults. All times are nanoseconds of the board.
#[derive(Debug)]
pub struct FaultyLine {
    spec: FaultSpec,
    random: Random,
    /// Bytes of the frame that has not ended yet.
    frame: Vec<u8>,
    /// A frame that the next one overtakes.
    overtaken: Option<Vec<u8>>,
    /// A byte that the next one overtakes.
    held: Option<u8>,
    items: VecDeque<Item>,
    /// Time at which the current pause ends.
    paused_until: u64,
    /// Number of bits that pass unchanged before the next flipped bit.
    sound_bits: u64,
    /// Number of bytes that were sent so far.
    bytes: u64,
    /// Time at which the silence began.
    silent_since: Option<u64>,
    /// Number of faults so far.
    faults: u64,
}

impl FaultyLine {
    /// A line with those faults of `spec` that concern this direction.
    pub fn new(spec: &FaultSpec, direction: Direction) -> Self {
        let spec = spec.of(direction);
        let mut random = Random::new(spec.seed);
        let sound_bits = random.wait(spec.ber);
        Self {
            spec,
            random,
            frame: Vec::new(),
            overtaken: None,
            held: None,
            items: VecDeque::new(),
            paused_until: 0,
            sound_bits,
            bytes: 0,
            silent_since: None,
            faults: 0,
        }
    }

    /// Number of faults so far.
    pub fn faults(&self) -> u64 {
        self.faults
    }

    /// Whether no symbol waits in the line.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// Loses everything that waits in the line.
    pub fn clear(&mut self) {
        self.items.clear();
        self.frame.clear();
        (self.held, self.overtaken) = (None, None);
    }

    /// Sends a byte into the line.
    pub fn carry(&mut self, byte: u8, now: u64) {
        self.bytes += 1;
        if self.is_silent(now) {
            self.faults += 1;
            return;
        }
        if !self.spec.holds_frames() {
            return self.carry_byte(byte);
        }
        self.frame.push(byte);
        if byte == FRAME_END || self.frame.len() == LONGEST {
            let frame = std::mem::take(&mut self.frame);
            self.carry_frame(frame);
        }
    }

    fn is_silent(&mut self, now: u64) -> bool {
        let Some((after, length)) = self.spec.silence else {
            return false;
        };
        if self.bytes <= after {
            return false;
        }
        let since = *self.silent_since.get_or_insert(now);
        let ends = length.map(|ms| since + ms * 1_000_000);
        ends.is_none_or(|end| now < end)
    }

    fn carry_frame(&mut self, mut frame: Vec<u8>) {
        // A zero that follows a zero ends no frame, so there is nothing to stall, to precede by noise or to truncate.
        if frame.len() > 1 {
            if self.happens(self.spec.stall.0) {
                self.items.push_back(Item::Pause(self.spec.stall.1 * 1_000_000));
            }
            if self.happens(self.spec.babble) {
                for _ in 0..=self.random.below(BABBLE) {
                    let noise = self.random.bits() as u8;
                    self.carry_byte(noise);
                }
            }
            if self.happens(self.spec.truncate) {
                frame.truncate(self.random.below(frame.len() as u32) as usize);
            }
        }
        let overtaken = self.overtaken.take();
        match self.fate(self.spec.frames) {
            Fate::Lost => {}
            Fate::Late => self.overtaken = Some(frame),
            Fate::Whole(times) => {
                for _ in 0..times {
                    frame.iter().for_each(|&byte| self.carry_byte(byte));
                }
            }
        }
        overtaken.into_iter().flatten().for_each(|byte| self.carry_byte(byte));
    }

    fn carry_byte(&mut self, byte: u8) {
        let held = self.held.take();
        match self.fate(self.spec.bytes) {
            Fate::Lost => {}
            Fate::Late => self.held = Some(byte),
            Fate::Whole(times) => self.items.extend(std::iter::repeat_n(Item::Byte(byte), times)),
        }
        self.items.extend(held.map(Item::Byte));
    }

    fn happens(&mut self, chance: f64) -> bool {
        let happens = self.random.happens(chance);
        self.faults += u64::from(happens);
        happens
    }

    fn fate(&mut self, chances: Chances) -> Fate {
        if self.happens(chances.drop) {
            Fate::Lost
        } else if self.happens(chances.swap) {
            Fate::Late
        } else {
            Fate::Whole(1 + usize::from(self.happens(chances.double)))
        }
    }

    /// The next symbol, or `None` while the line is empty or stands still. Every bit of the symbol is flipped with the
    /// chance of a bit error.
    pub fn next(&mut self, now: u64) -> Option<Symbol> {
        loop {
            if now < self.paused_until {
                return None;
            }
            match self.items.pop_front()? {
                Item::Pause(length) => self.paused_until = now + length,
                Item::Byte(byte) => return Some(self.noisy(Symbol::of(byte))),
            }
        }
    }

    fn noisy(&mut self, symbol: Symbol) -> Symbol {
        let bits = u64::from(SYMBOL_BITS);
        let mut symbol = symbol;
        let mut bit = 0;
        while self.sound_bits < bits - bit {
            bit += self.sound_bits;
            symbol = symbol.flip(bit as u32);
            bit += 1;
            self.faults += 1;
            self.sound_bits = self.random.wait(self.spec.ber);
        }
        self.sound_bits = self.sound_bits.saturating_sub(bits - bit);
        symbol
    }
}

/// The fate of a byte or a frame.
enum Fate {
    Lost,
    Late,
    Whole(usize),
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(spec: &str) -> FaultyLine {
        FaultyLine::new(&spec.parse().unwrap(), Direction::ToDevice)
    }

    /// All bytes that arrive at the far end. The line must not stand still for ever.
    fn through(line: &mut FaultyLine, bytes: &[u8]) -> Vec<u8> {
        bytes.iter().for_each(|&byte| line.carry(byte, 0));
        let mut now = 0;
        let mut came = Vec::new();
        while !line.is_empty() {
            now += 1_000_000;
            while let Some(symbol) = line.next(now) {
                came.extend(symbol.byte());
            }
        }
        came
    }

    const FRAMES: [u8; 12] = [1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0];

    #[test]
    fn a_sound_line_changes_nothing() {
        for spec in ["", "stall=1", "ber=0", "ber=1,direction=to-host"] {
            let mut line = line(spec);
            assert_eq!(through(&mut line, &FRAMES), FRAMES, "{spec}");
        }
    }

    #[test]
    fn each_fault_is_what_it_is_called() {
        assert_eq!(through(&mut line("drop=1"), &FRAMES), []);
        assert_eq!(through(&mut line("double=1"), &[1, 2]), [1, 1, 2, 2]);
        assert_eq!(through(&mut line("drop-frame=1"), &FRAMES), []);
        assert_eq!(through(&mut line("double-frame=1"), &FRAMES[..4]), [1, 2, 3, 0, 1, 2, 3, 0]);
        assert!(through(&mut line("truncate=1"), &FRAMES[..4]).len() < 4);
        assert!(through(&mut line("babble=1"), &FRAMES).len() > FRAMES.len());
        assert_eq!(through(&mut line("silence-after=5"), &FRAMES), FRAMES[..5]);
        let swapped = through(&mut line("swap=0.5"), &FRAMES);
        assert_ne!(swapped, FRAMES);
        let swapped = through(&mut line("swap-frame=0.5,seed=5"), &FRAMES);
        assert!(swapped != FRAMES && swapped.len() >= 8, "{swapped:?}");
    }

    #[test]
    fn bits_are_turned_as_often_as_asked() {
        let mut line = line("ber=1e-3,seed=9");
        let bytes = vec![0x55; 100_000];
        through(&mut line, &bytes);
        assert!((900..1100).contains(&line.faults()), "{}", line.faults());
        let mut all = FaultyLine::new(&"ber=1".parse().unwrap(), Direction::ToHost);
        all.carry(0x0f, 0);
        let symbol = all.next(0).unwrap();
        assert_eq!((symbol.data(), symbol.byte(), symbol.is_sound()), (0xf0, None, false));
    }

    #[test]
    fn a_stall_holds_the_line_and_a_silence_ends() {
        let mut slow = line("stall=1,stall-ms=3");
        [1, 0].into_iter().for_each(|byte| slow.carry(byte, 0));
        assert_eq!(slow.next(0), None);
        assert_eq!(slow.next(2_999_999), None);
        assert_eq!(slow.next(3_000_000), Some(Symbol::of(1)));
        let mut mute = line("silence-after=1,silence-ms=2");
        for (byte, now) in [(1, 0), (2, 10), (3, 2_000_009), (4, 2_000_010)] {
            mute.carry(byte, now);
        }
        assert_eq!([mute.next(0), mute.next(0), mute.next(0)], [Some(Symbol::of(1)), Some(Symbol::of(4)), None]);
    }
}
