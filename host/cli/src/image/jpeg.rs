//! JPEG images.

use std::io::Cursor;

use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;

use super::pixels::{checked, damaged, of_channels, widened, Image, MOST_SIDE};
use crate::failure::{one_line, Failure};
use crate::memory::Memory;

/// The mark at the end of an image.
const END: [u8; 2] = [0xff, 0xd9];

/// Reads a JPEG image. One whose colours are brightness and two differences, as nearly all, gives its brightness.
pub(super) fn read(bytes: &[u8], memory: Memory) -> Result<Image, Failure> {
    let refuse = |error: zune_jpeg::errors::DecodeErrors| damaged("JPEG", &one_line(&error.to_string()));
    let options = DecoderOptions::default().set_strict_mode(true).set_max_width(MOST_SIDE).set_max_height(MOST_SIDE);
    let mut decoder = JpegDecoder::new_with_options(Cursor::new(bytes), options);
    // The decoder is content with a file that lacks its last bytes.
    if !bytes.windows(2).any(|mark| mark == END) {
        return Err(damaged("JPEG", "its end is missing"));
    }
    decoder.decode_headers().map_err(refuse)?;
    let (columns, rows) = decoder.dimensions().unwrap_or_default();
    let pixels = checked(columns, rows, memory)?;
    let colors = match decoder.input_colorspace() {
        Some(ColorSpace::YCbCr | ColorSpace::Luma) => ColorSpace::Luma,
        _ => ColorSpace::RGB,
    };
    decoder.set_options(options.jpeg_set_out_colorspace(colors));
    let values = decoder.decode().map_err(refuse)?;
    let channels = colors.num_components();
    if values.len() != pixels * channels {
        return Err(damaged("JPEG", "pixels are missing"));
    }
    let weight = |pixel: &[u8]| match *pixel {
        [red, green, blue] => of_channels(&[red, green, blue].map(widened)),
        [grey, ..] => of_channels(&[widened(grey)]),
        [] => 0,
    };
    Ok(Image { columns, weights: values.chunks_exact(channels).map(weight).collect() })
}
