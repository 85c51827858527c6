//! The CRC-32 of frames, answers and sessions, by a table of 64 bytes.

/// The check sums of the 16 values of four bits: polynomial 04C11DB7, reflected.
const NIBBLES: [u32; 16] = {
    let mut table = [0; 16];
    let mut value = 0;
    while value < 16 {
        let mut rest = value as u32;
        let mut bit = 0;
        while bit < 4 {
            rest = if rest & 1 == 1 { rest >> 1 ^ 0xedb8_8320 } else { rest >> 1 };
            bit += 1;
        }
        table[value] = rest;
        value += 1;
    }
    table
};

/// A CRC-32 that is computed byte by byte.
#[derive(Clone, Copy)]
pub(crate) struct Crc32(u32);

impl Crc32 {
    pub const fn new() -> Self {
        Self(!0)
    }

    pub fn add(&mut self, byte: u8) {
        let mut state = self.0 ^ u32::from(byte);
        state = state >> 4 ^ NIBBLES[(state & 15) as usize];
        state = state >> 4 ^ NIBBLES[(state & 15) as usize];
        self.0 = state;
    }

    pub const fn value(self) -> u32 {
        !self.0
    }

    /// The check sum of these bytes.
    pub fn of(bytes: &[u8]) -> u32 {
        let mut crc = Self::new();
        bytes.iter().for_each(|&byte| crc.add(byte));
        crc.value()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_check_value_of_the_standard() {
        assert_eq!(Crc32::of(b"123456789"), 0xcbf4_3926);
        assert_eq!(Crc32::of(b""), 0);
    }
}
