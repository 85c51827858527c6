//! The bits on a serial line: one start bit, eight data bits with the lowest first, one stop bit.

/// Number of bits of a symbol.
pub const SYMBOL_BITS: u32 = 10;
/// Times on the line are in clocks with this many fractional bits.
const FRACTION: u32 = 16;

/// The bits that the line carries for a byte: ten, with the first in the lowest place. A sound symbol has a low start
/// bit and a high stop bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Symbol(u16);

impl Symbol {
    /// The sound symbol of a byte.
    pub fn of(byte: u8) -> Self {
        Self(u16::from(byte) << 1 | 1 << (SYMBOL_BITS - 1))
    }

    /// The eight data bits, whatever the start and stop bits are.
    pub fn data(self) -> u8 {
        (self.0 >> 1) as u8
    }

    /// Whether the start bit is low and the stop bit is high.
    pub fn is_sound(self) -> bool {
        self.0 & (1 | 1 << (SYMBOL_BITS - 1)) == 1 << (SYMBOL_BITS - 1)
    }

    /// The byte, or `None` if there is no start bit: a receiver would not have noticed such a symbol.
    pub fn byte(self) -> Option<u8> {
        (self.0 & 1 == 0).then_some(self.data())
    }

    /// The symbol with one bit flipped.
    pub fn flip(self, bit: u32) -> Self {
        Self(self.0 ^ 1 << bit)
    }

    fn bit(self, index: u32) -> bool {
        self.0 >> index & 1 == 1
    }
}

/// Length of a bit in clocks, with [`FRACTION`] fractional bits.
pub(super) fn bit_length(clock_hz: u32, rate: u32) -> u64 {
    (u64::from(clock_hz) << FRACTION) / u64::from(rate.max(1))
}

/// Length of a bit in clocks for a step of the device's baud generator, with [`FRACTION`] fractional bits.
pub(super) fn bit_length_of_step(step: u32) -> u64 {
    (1 << (incircle_protocol::PHASE_BITS + FRACTION)) / u64::from(step.max(1))
}

/// Number of clocks of a symbol with bits of this length, rounded up.
pub(super) fn symbol_clocks(bit: u64) -> u64 {
    (bit * u64::from(SYMBOL_BITS)).div_ceil(1 << FRACTION)
}

/// Drives a line, bit by bit.
#[derive(Clone, Debug, Default)]
pub(super) struct UartSender {
    /// The symbol on the line, the number of the next bit, and the time at which that bit begins.
    sending: Option<(Symbol, u32, u64)>,
    /// Time at which the last symbol ends; the next one begins no earlier.
    free_at: u64,
}

impl UartSender {
    /// Whether no symbol is on the line at this clock, so that one may begin.
    pub(super) fn is_free(&self, clock: u64) -> bool {
        self.sending.is_none() && self.free_at <= clock << FRACTION
    }

    /// Begins a symbol at this clock, or, if the last symbol ended since the clock before, exactly where that ended. So
    /// consecutive symbols take exactly ten bits each, and no rounding adds up.
    pub(super) fn begin(&mut self, symbol: Symbol, clock: u64) {
        let now = clock << FRACTION;
        let start = if self.free_at + (1 << FRACTION) > now { self.free_at } else { now };
        self.sending = Some((symbol, 0, start));
    }

    /// The level that the line takes at this clock, if it changes now; high after the last bit.
    pub(super) fn level(&mut self, clock: u64, bit_length: u64) -> Option<bool> {
        let (symbol, bit, at) = self.sending?;
        if at > clock << FRACTION {
            return None;
        }
        let next = at + bit_length;
        self.sending = (bit + 1 < SYMBOL_BITS).then_some((symbol, bit + 1, next));
        self.free_at = next;
        Some(symbol.bit(bit))
    }
}

/// Samples a line in the middle of each bit.
#[derive(Clone, Debug)]
pub(super) struct UartReceiver {
    /// The bits so far, their number, and the time of the next sample.
    sampling: Option<(u16, u32, u64)>,
    was_high: bool,
}

impl Default for UartReceiver {
    fn default() -> Self {
        Self { sampling: None, was_high: true }
    }
}

impl UartReceiver {
    /// Whether no symbol has begun.
    #[cfg(test)]
    pub(super) fn is_idle(&self) -> bool {
        self.sampling.is_none() && self.was_high
    }

    /// Takes the level at this clock, and returns a symbol when its stop bit is sampled. A start bit that is high in
    /// its middle was noise.
    #[inline]
    pub(super) fn sample(&mut self, level: bool, clock: u64, bit_length: u64) -> Option<Symbol> {
        let has_fallen = self.was_high && !level;
        self.was_high = level;
        match &mut self.sampling {
            None => {
                if has_fallen {
                    self.sampling = Some((0, 0, (clock << FRACTION) + bit_length / 2));
                }
                None
            }
            Some((bits, count, at)) => {
                if *at > clock << FRACTION {
                    return None;
                }
                *bits |= u16::from(level) << *count;
                *count += 1;
                *at += bit_length;
                if *count == SYMBOL_BITS || *bits & 1 == 1 {
                    let symbol = Symbol(*bits);
                    self.sampling = None;
                    return (!symbol.bit(0)).then_some(symbol);
                }
                None
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The symbols that arrive if the two ends of a line have these rates.
    fn carry(bytes: &[u8], clock_hz: u32, sender_rate: u32, receiver_rate: u32) -> Vec<Symbol> {
        let (mut sender, mut receiver) = (UartSender::default(), UartReceiver::default());
        let (from, to) = (bit_length(clock_hz, sender_rate), bit_length(clock_hz, receiver_rate));
        let mut rest = bytes.iter();
        let (mut level, mut symbols) = (true, Vec::new());
        let clocks = symbol_clocks(from) * (bytes.len() as u64 + 3);
        for clock in 5..clocks {
            if sender.is_free(clock) {
                if let Some(&byte) = rest.next() {
                    sender.begin(Symbol::of(byte), clock);
                }
            }
            level = sender.level(clock, from).unwrap_or(level);
            symbols.extend(receiver.sample(level, clock, to));
        }
        assert!(receiver.is_idle());
        symbols
    }

    #[test]
    fn bytes_pass_at_any_rate_and_a_little_beside_it() {
        let bytes: Vec<u8> = (0..=255).collect();
        let expected: Vec<_> = bytes.iter().map(|&byte| Symbol::of(byte)).collect();
        for rate in [115_200, 921_600, 3_000_000, 12_000_000] {
            assert_eq!(carry(&bytes, 125_000_000, rate, rate), expected, "{rate}");
        }
        for rate in [980_000, 1_020_000] {
            assert_eq!(carry(&bytes, 125_000_000, 1_000_000, rate), expected, "{rate}");
        }
    }

    #[test]
    fn a_symbol_after_the_other_takes_ten_bits() {
        let bit = bit_length(125_000_000, 12_000_000);
        let mut sender = UartSender::default();
        let mut begun = 0;
        for clock in 0..104_167 {
            if sender.is_free(clock) {
                sender.begin(Symbol::of(0x55), clock);
                begun += 1;
            }
            sender.level(clock, bit);
        }
        // A symbol takes 104.17 clocks, and rounding must not add up.
        assert!((1000..=1001).contains(&begun), "{begun}");
    }

    #[test]
    fn other_rates_are_sampled_wrongly() {
        let bytes: Vec<u8> = (0..=255).collect();
        let sound = |symbols: Vec<Symbol>| symbols.iter().filter_map(|symbol| symbol.byte()).collect::<Vec<_>>();
        for rate in [115_200, 2_000_000] {
            assert_ne!(sound(carry(&bytes, 125_000_000, 3_000_000, rate)), bytes, "{rate}");
        }
    }

    #[test]
    fn symbols_know_what_they_are() {
        for byte in 0..=255 {
            let symbol = Symbol::of(byte);
            assert!(symbol.is_sound());
            assert_eq!(symbol.byte(), Some(byte));
            assert_eq!(symbol.flip(1).byte(), Some(byte ^ 1));
            assert_eq!(symbol.flip(8).byte(), Some(byte ^ 0x80));
            assert_eq!(symbol.flip(0).byte(), None);
            assert!(!symbol.flip(9).is_sound());
        }
    }
}
