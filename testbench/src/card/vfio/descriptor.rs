//! A descriptor of the bridge: 32 bytes in the host's memory that say what to move, and the 8 bytes that the
//! bridge writes back for an answer.

/// Upper half of a descriptor's first word.
const MAGIC: u32 = 0xad4b;
/// Upper half of the first word that is written back.
const WRITTEN_MAGIC: u32 = 0x52b4;
/// Flags in a descriptor's first word.
const STOP: u32 = 1;
const COMPLETED: u32 = 1 << 1;
const END: u32 = 1 << 4;
/// Mask of a descriptor's length.
const LENGTH: u32 = (1 << 28) - 1;

/// One piece of memory to move.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Descriptor {
    /// The run ends with this descriptor.
    pub stops: bool,
    /// The end of this descriptor sets a bit of the status.
    pub completes: bool,
    /// A packet to the card ends with this descriptor. Commands are not divided into packets,
    /// so the flag has no effect.
    pub ends: bool,
    /// Number of bytes, less than 2^28.
    pub length: u32,
    /// Address of the commands to send; for an answer, the address at which the bridge reports what came.
    pub source: u64,
    /// Address at which the answer is stored.
    pub destination: u64,
    /// Address of the next descriptor.
    pub next: u64,
}

impl Descriptor {
    /// Bytes of a descriptor in memory.
    pub const BYTES: usize = 32;

    /// Encodes the descriptor as the bridge finds it in memory.
    pub fn to_bytes(self) -> [u8; Self::BYTES] {
        let flags = [(self.stops, STOP), (self.completes, COMPLETED), (self.ends, END)];
        let flags = flags.iter().filter(|flag| flag.0).fold(0, |bits, flag| bits | flag.1);
        let words = [MAGIC << 16 | flags, self.length & LENGTH].into_iter();
        let addresses = [self.source, self.destination, self.next];
        let words = words.chain(addresses.into_iter().flat_map(|address| [address as u32, (address >> 32) as u32]));
        let mut bytes = [0; Self::BYTES];
        for (place, word) in bytes.chunks_exact_mut(4).zip(words) {
            place.copy_from_slice(&word.to_le_bytes());
        }
        bytes
    }

    /// Decodes a descriptor; `None` if the bytes do not begin with the descriptor's magic number.
    pub fn from_bytes(bytes: [u8; Self::BYTES]) -> Option<Self> {
        let word = |at: usize| u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
        let address = |at: usize| u64::from(word(at + 4)) << 32 | u64::from(word(at));
        let first = word(0);
        (first >> 16 == MAGIC).then(|| Self {
            stops: first & STOP != 0,
            completes: first & COMPLETED != 0,
            ends: first & END != 0,
            length: word(4) & LENGTH,
            source: address(8),
            destination: address(16),
            next: address(24),
        })
    }
}

/// The bridge's report on a descriptor of the channel to the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Written {
    /// Number of bytes that came.
    pub length: u32,
    /// The answer ended with these bytes.
    pub is_end: bool,
}

impl Written {
    /// Bytes of the report in memory.
    pub const BYTES: usize = 8;

    /// Encodes the report as the host finds it in memory.
    pub fn to_bytes(self) -> [u8; Self::BYTES] {
        let [a, b, c, d] = (WRITTEN_MAGIC << 16 | u32::from(self.is_end)).to_le_bytes();
        let [e, f, g, h] = self.length.to_le_bytes();
        [a, b, c, d, e, f, g, h]
    }

    /// Decodes the report; `None` if nothing was written back.
    pub fn from_bytes(bytes: [u8; Self::BYTES]) -> Option<Self> {
        let [a, b, c, d, e, f, g, h] = bytes;
        let first = u32::from_le_bytes([a, b, c, d]);
        let length = u32::from_le_bytes([e, f, g, h]);
        (first >> 16 == WRITTEN_MAGIC).then_some(Self { length, is_end: first & 1 != 0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn descriptors_have_the_places_of_the_guide() {
        let descriptor = Descriptor {
            stops: true,
            completes: true,
            ends: true,
            length: 0x0fed_cba8,
            source: 0x1122_3344_5566_7788,
            destination: 0x99aa_bbcc_ddee_ff00,
            next: 0x0123_4567_89ab_cde0,
        };
        let bytes = descriptor.to_bytes();
        let words: Vec<u32> = bytes.chunks(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
        assert_eq!(
            words,
            [0xad4b_0013, 0x0fed_cba8, 0x5566_7788, 0x1122_3344, 0xddee_ff00, 0x99aa_bbcc, 0x89ab_cde0, 0x0123_4567]
        );
        assert_eq!(Descriptor::from_bytes(bytes), Some(descriptor));
        let mut other = bytes;
        other[3] = 0;
        assert_eq!(Descriptor::from_bytes(other), None);
        assert_eq!(Descriptor::from_bytes([0; 32]), None);
    }

    #[test]
    fn what_is_written_back_is_told_from_nothing() {
        for (written, first) in [
            (Written { length: 48, is_end: true }, 0x52b4_0001),
            (Written { length: 1 << 27, is_end: false }, 0x52b4_0000u32),
        ] {
            assert_eq!(written.to_bytes()[..4], first.to_le_bytes());
            assert_eq!(Written::from_bytes(written.to_bytes()), Some(written));
        }
        assert_eq!(Written::from_bytes([0; 8]), None);
    }
}
