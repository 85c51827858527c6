//! PGM images, the grey ones of Netpbm: `P2` with numbers as text, `P5` with bytes.

use super::pixels::{checked, damaged, of_grey, Image};
use crate::failure::Failure;
use crate::memory::Memory;

/// Reads a PGM image of up to 16 bits.
pub(super) fn read(bytes: &[u8], memory: Memory) -> Result<Image, Failure> {
    let mut words = Words { bytes, at: 2 };
    let mut number = |what: &str| words.number().ok_or_else(|| damaged("PGM", &format!("{what} is no number")));
    let (columns, rows) = (number("the width")?, number("the height")?);
    let most = number("the largest grey value")?;
    if most == 0 || most > u32::from(u16::MAX) {
        return Err(damaged("PGM", &format!("the largest grey value is {most}, not 1 to 65535")));
    }
    let (columns, rows) = (columns as usize, rows as usize);
    let pixels = checked(columns, rows, memory)?;
    let values: Vec<u32> = if bytes[1] == b'2' {
        std::iter::from_fn(|| words.number()).take(pixels).collect()
    } else {
        // One blank ends the header.
        let data = bytes.get(words.at + 1..).unwrap_or_default();
        let value = |chunk: &[u8]| chunk.iter().fold(0, |sum, &byte| sum << 8 | u32::from(byte));
        data.chunks_exact(if most < 256 { 1 } else { 2 }).take(pixels).map(value).collect()
    };
    if values.len() < pixels {
        return Err(damaged("PGM", &format!("{} of {pixels} pixels are there", values.len())));
    }
    if let Some(value) = values.iter().find(|&&value| value > most) {
        return Err(damaged("PGM", &format!("a grey value is {value}, above the largest, {most}")));
    }
    let grey = |value: &u32| (u64::from(*value) * u64::from(u16::MAX) / u64::from(most)) as u16;
    Ok(Image { columns, weights: values.iter().map(|value| of_grey(grey(value))).collect() })
}

/// The numbers of a text, with comments from `#` to the end of the line between them.
struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Words<'_> {
    /// The next number below 2^32. Afterwards `at` is the place of the byte behind it.
    fn number(&mut self) -> Option<u32> {
        while let Some(byte) = self.bytes.get(self.at) {
            match byte {
                b'#' => self.at += self.bytes[self.at..].iter().position(|&byte| byte == b'\n')?,
                byte if byte.is_ascii_whitespace() => self.at += 1,
                _ => break,
            }
        }
        let rest = &self.bytes[self.at..];
        let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
        let number = std::str::from_utf8(&rest[..digits]).ok()?.parse().ok()?;
        self.at += digits;
        Some(number)
    }
}
