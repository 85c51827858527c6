//! An image as weights, and the steps that all decoders share.

use crate::failure::Failure;
use crate::memory::Memory;

/// The most memory that a pixel takes: its bytes of up to four channels of 16 bits, its weight, and its part of the
/// density of the library.
const PIXEL_BYTES: u64 = 32;
/// The most pixels in a row, and the most rows, which is the limit of JPEG.
pub(super) const MOST_SIDE: usize = 65_535;

/// The weights of an image, row by row from the uppermost on: 0 for white or clear, 65535 for black.
#[derive(Debug, PartialEq, Eq)]
pub struct Image {
    /// Pixels in a row.
    pub columns: usize,
    /// One weight for each pixel.
    pub weights: Vec<u16>,
}

impl Image {
    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.weights.len() / self.columns.max(1)
    }
}

/// Refuses an image without pixels, and one that the memory does not hold. Gives the number of pixels.
pub(super) fn checked(columns: usize, rows: usize, memory: Memory) -> Result<usize, Failure> {
    let pixels = columns as u64 * rows as u64;
    let most = memory.bytes() / PIXEL_BYTES;
    if pixels == 0 || columns > MOST_SIDE || rows > MOST_SIDE {
        return Err(Failure::input(format!(
            "the image has {columns} by {rows} pixels, but sides of 1 to {MOST_SIDE} are possible: give another image"
        )));
    }
    if pixels > most {
        return Err(Failure::input(format!(
            "the image has {columns} by {rows} pixels, more than the {most} that {} MiB of free memory hold: give a \
             smaller image",
            memory.bytes() >> 20
        )));
    }
    Ok(pixels as usize)
}

/// The failure of an image that its decoder refuses.
pub(super) fn damaged(kind: &str, error: &str) -> Failure {
    Failure::input(format!("the {kind} image cannot be read ({error}): save it again"))
}

/// The weight of a grey value of 16 bits.
pub(super) fn of_grey(grey: u16) -> u16 {
    u16::MAX - grey
}

/// The brightness of a colour, by the weights of ITU-R BT.709, rounded down.
fn brightness([red, green, blue]: [u16; 3]) -> u16 {
    ((u64::from(red) * 2126 + u64::from(green) * 7152 + u64::from(blue) * 722) / 10_000) as u16
}

/// The weight of a pixel with these channels: grey or colour, perhaps with its cover behind. White paper shows through
/// what does not cover it.
pub(super) fn of_channels(channels: &[u16]) -> u16 {
    let (grey, cover) = match *channels {
        [grey] => (grey, u16::MAX),
        [grey, cover] => (grey, cover),
        [red, green, blue] => (brightness([red, green, blue]), u16::MAX),
        [red, green, blue, cover] => (brightness([red, green, blue]), cover),
        _ => (u16::MAX, 0),
    };
    (u64::from(of_grey(grey)) * u64::from(cover) / u64::from(u16::MAX)) as u16
}

/// A value of 8 bits as one of 16.
pub(super) fn widened(value: u8) -> u16 {
    u16::from(value) * 257
}
