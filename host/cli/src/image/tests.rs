//! Every kind of pixel, damage, and sizes beyond the memory.

use super::*;

fn png_of(color: ::png::ColorType, depth: ::png::BitDepth, size: [u32; 2], pixels: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, size[0], size[1]);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == ::png::ColorType::Indexed {
        encoder.set_palette(vec![0, 0, 0, 255, 255, 255, 255, 0, 0]);
    }
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(pixels).expect("as many bytes");
    writer.finish().expect("an end");
    bytes
}

fn weights(bytes: &[u8]) -> Vec<u16> {
    of_bytes(bytes, Memory::ENDLESS).expect("an image").weights
}

fn message(bytes: &[u8], memory: Memory) -> String {
    of_bytes(bytes, memory).expect_err("no image").message
}

#[test]
fn dark_pixels_weigh_much_in_every_kind_of_png() {
    use ::png::{BitDepth::*, ColorType::*};
    assert_eq!(weights(&png_of(Grayscale, Eight, [3, 1], &[0, 255, 1])), [65535, 0, 65535 - 257]);
    assert_eq!(weights(&png_of(Grayscale, Sixteen, [1, 2], &[0x12, 0x34, 0, 0])), [65535 - 0x1234, 65535]);
    assert_eq!(weights(&png_of(Grayscale, One, [3, 1], &[0b0100_0000])), [65535, 0, 65535]);
    assert_eq!(weights(&png_of(GrayscaleAlpha, Eight, [2, 1], &[0, 0, 0, 51])), [0, 51 * 257]);
    let red = 65535 - 65535 * 2126 / 10_000;
    assert_eq!(weights(&png_of(Rgb, Eight, [2, 1], &[255, 0, 0, 255, 255, 255])), [red as u16, 0]);
    assert_eq!(weights(&png_of(Rgba, Eight, [1, 1], &[255, 0, 0, 0])), [0]);
    assert_eq!(weights(&png_of(Indexed, Two, [3, 1], &[0b0001_1000])), [65535, 0, red as u16]);
}

#[test]
fn both_kinds_of_pgm_are_read() {
    assert_eq!(weights(b"P2\n# a comment\n3 1 # another\n4\n0 4\t1\n"), [65535, 0, 65535 - 16383]);
    assert_eq!(weights(b"P5 2 1 255\n\x00\xff"), [65535, 0]);
    assert_eq!(weights(b"P5 2 1 65535\n\x12\x34\xff\xff"), [65535 - 0x1234, 0]);
    assert_eq!(of_bytes(b"P5 1 2 255\nab", Memory::ENDLESS).map(|image| image.columns), Ok(1));
}

#[test]
fn damage_is_told_in_one_sentence() {
    let png = png_of(::png::ColorType::Grayscale, ::png::BitDepth::Eight, [40, 40], &[7; 1600]);
    let jpeg = include_bytes!("../../tests/it/common/grey.jpg");
    for whole in [&png[..], jpeg] {
        assert!(of_bytes(whole, Memory::ENDLESS).is_ok());
        for end in 0..whole.len() {
            let told = message(&whole[..end], Memory::ENDLESS);
            assert!(!told.contains('\n'), "{told}");
        }
    }
    for (bytes, part) in [
        (&b"GIF89a"[..], "neither PNG, JPEG nor PGM"),
        (b"", "neither PNG"),
        (b"P5", "the width is no number"),
        (b"P2 2 2 255 1 2 3", "3 of 4 pixels are there"),
        (b"P5 2 1 3\n\x01\x07", "a grey value is 7, above the largest, 3"),
        (b"P2 1 1 70000 1", "the largest grey value is 70000"),
        (b"P2 0 1 9", "0 by 1 pixels"),
        (b"P5 70000 1 255\n", "70000 by 1 pixels"),
        (b"P2 99999999999 1 9", "the width is no number"),
    ] {
        let told = message(bytes, Memory::ENDLESS);
        assert!(told.contains(part), "{told}");
    }
    let told = message(b"P5 60000 60000 255\n", Memory::of_bytes(1 << 30));
    assert!(told.contains("more than the 33554432 that 1024 MiB"), "{told}");
    let told = message(&png, Memory::of_bytes(1 << 12));
    assert!(told.contains("40 by 40 pixels, more than the 128"), "{told}");
}

#[test]
fn a_jpeg_has_the_weights_that_it_was_made_of() {
    let image = of_bytes(include_bytes!("../../tests/it/common/grey.jpg"), Memory::ENDLESS).expect("an image");
    assert_eq!((image.columns, image.weights.len()), (24, 24 * 16));
    // The image was made black on the left, white on the right.
    assert!(image.weights.chunks(24).all(|row| row[2] > 60_000 && row[21] < 5_000));
}
