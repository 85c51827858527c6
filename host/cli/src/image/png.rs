//! PNG images.

use std::io::Cursor;

use png::{BitDepth, Decoder, Limits, Transformations};

use super::pixels::{checked, damaged, of_channels, widened, Image};
use crate::failure::{one_line, Failure};
use crate::memory::Memory;

/// Reads a PNG image with any colours and depth; of an animation, the first frame.
pub(super) fn read(bytes: &[u8], memory: Memory) -> Result<Image, Failure> {
    let refuse = |error: png::DecodingError| damaged("PNG", &one_line(&error.to_string()));
    let limits = Limits { bytes: usize::try_from(memory.bytes()).unwrap_or(usize::MAX) };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), limits);
    // Palettes become colours, and depths below 8 bits become 8.
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(refuse)?;
    let (columns, rows) = (reader.info().width as usize, reader.info().height as usize);
    checked(columns, rows, memory)?;
    let size = reader.output_buffer_size().ok_or_else(|| damaged("PNG", "it is too large"))?;
    let mut pixels = vec![0; size];
    let info = reader.next_frame(&mut pixels).map_err(refuse)?;
    // Only the end of the file tells that nothing is cut off.
    reader.finish().map_err(refuse)?;
    pixels.truncate(info.buffer_size());
    let channels = info.color_type.samples();
    let weights = if info.bit_depth == BitDepth::Sixteen {
        let value = |pair: &[u8]| u16::from_be_bytes([pair[0], pair[1]]);
        weights(&pixels, channels, 2, value)
    } else {
        weights(&pixels, channels, 1, |byte| widened(byte[0]))
    };
    Ok(Image { columns, weights })
}

fn weights(pixels: &[u8], channels: usize, bytes: usize, value: impl Fn(&[u8]) -> u16) -> Vec<u16> {
    let mut values = [0; 4];
    let weight = |pixel: &[u8]| {
        pixel.chunks_exact(bytes).zip(&mut values).for_each(|(chunk, into)| *into = value(chunk));
        of_channels(&values[..channels])
    };
    pixels.chunks_exact(channels * bytes).map(weight).collect()
}
