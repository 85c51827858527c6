//! Images as densities: dark is dense.
//!
//! Every machine reads the same weights. Pixels become integers of 16 bits by integer arithmetic alone, and the decoders
//! use no vector instructions and no doubles.

mod jpeg;
mod pgm;
mod png;

use std::path::Path;

use crate::failure::Failure;
use crate::input::Input;
use crate::memory::Memory;
use crate::path::name;

/// The most memory that a pixel takes: its bytes of up to four channels of 16 bits, its weight, and its part of the
/// density of the library.
const PIXEL_BYTES: u64 = 32;
/// The most pixels in a row, and the most rows, which is the limit of JPEG.
const MOST_SIDE: usize = 65_535;

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

/// Reads a PNG, JPEG or PGM file; its first bytes tell which.
pub fn read(file: &Path, quiet: bool) -> Result<Image, Failure> {
    let read = || {
        let input = Input::open(file, quiet)?;
        let memory = input.memory();
        let image = of_bytes(&input.into_bytes()?, memory)?;
        if image.weights.iter().all(|&weight| weight == 0) {
            return Err(Failure::input(
                "all pixels of the image are white, so nothing has weight: give an image with dark pixels",
            ));
        }
        Ok(image)
    };
    read().map_err(|failure| failure.in_file(name(file)))
}

fn of_bytes(bytes: &[u8], memory: Memory) -> Result<Image, Failure> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => png::read(bytes, memory),
        [0xff, 0xd8, ..] => jpeg::read(bytes, memory),
        [b'P', b'2' | b'5', ..] => pgm::read(bytes, memory),
        _ => Err(Failure::input("the image is neither PNG, JPEG nor PGM: convert it to one of these")),
    }
}

/// Refuses an image without pixels, and one that the memory does not hold. Gives the number of pixels.
fn checked(columns: usize, rows: usize, memory: Memory) -> Result<usize, Failure> {
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
fn damaged(kind: &str, error: &str) -> Failure {
    Failure::input(format!("the {kind} image cannot be read ({error}): save it again"))
}

/// The weight of a grey value of 16 bits.
fn of_grey(grey: u16) -> u16 {
    u16::MAX - grey
}

/// The brightness of a colour, by the weights of ITU-R BT.709, rounded down.
fn brightness([red, green, blue]: [u16; 3]) -> u16 {
    ((u64::from(red) * 2126 + u64::from(green) * 7152 + u64::from(blue) * 722) / 10_000) as u16
}

/// The weight of a pixel with these channels: grey or colour, perhaps with its cover behind. White paper shows through
/// what does not cover it.
fn of_channels(channels: &[u16]) -> u16 {
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
fn widened(value: u8) -> u16 {
    u16::from(value) * 257
}

#[cfg(test)]
mod tests;
