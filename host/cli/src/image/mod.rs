//! Images as densities: dark is dense.
//!
//! Every machine reads the same weights. Pixels become integers of 16 bits by integer arithmetic alone, and the decoders
//! use no vector instructions and no doubles.

mod jpeg;
mod pgm;
mod pixels;
mod png;

use std::path::Path;

use crate::failure::Failure;
use crate::input::Input;
use crate::memory::Memory;
use crate::path::name;

pub use pixels::Image;

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

#[cfg(test)]
mod tests;
