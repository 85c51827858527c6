//! The check sum of frames, answers and sessions.

/// The polynomial of Ethernet's CRC-32, with the lowest power in the top bit.
const REFLECTED: u32 = 0xedb8_8320;

/// A CRC-32 that is computed byte by byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crc32(u32);

impl Default for Crc32 {
    fn default() -> Self {
        Self(!0)
    }
}

impl Crc32 {
    /// The check sum of these bytes.
    pub fn of(bytes: &[u8]) -> u32 {
        let mut crc = Self::default();
        bytes.iter().for_each(|&byte| crc.add(byte));
        crc.value()
    }

    /// Adds a byte to the sum.
    pub fn add(&mut self, byte: u8) {
        self.0 ^= u32::from(byte);
        for _ in 0..8 {
            let is_odd = self.0 & 1 == 1;
            self.0 = (self.0 >> 1) ^ if is_odd { REFLECTED } else { 0 };
        }
    }

    /// The check sum of all bytes so far.
    pub fn value(self) -> u32 {
        !self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_sum_of_zip_and_ethernet() {
        assert_eq!(Crc32::of(b"123456789"), 0xcbf4_3926);
        assert_eq!(Crc32::of(b""), 0);
        assert_eq!(Crc32::of(&[0]), 0xd202_ef8d);
    }
}
