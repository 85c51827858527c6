//! Grids of values as GeoTIFF: one band of doubles, the highest row first.
//!
//! The tags of GeoTIFF say where the grid lies: the coordinates of the first pixel, the size of a pixel, and that a
//! pixel stands for a point, its node. Which projection the coordinates have is not known, so the file names none.
//! Nodes without a value are NaN, which the tag of GDAL for missing values names.

use std::io::{self, Cursor, Write};

use tiff::encoder::colortype::Gray64Float;
use tiff::encoder::{TiffEncoder, TiffKind};
use tiff::tags::Tag;
use tiff::TiffResult;

use crate::grid::Grid;

/// Bytes of values above which a file is a BigTIFF: the places in others are numbers of 32 bits, and lists follow the
/// values.
const MOST_BYTES: u64 = 4_000_000_000;
/// The list of GeoTIFF keys: version 1.1.0 with one key, `GTRasterTypeGeoKey`, which is 2: a pixel is a point.
const KEYS: [u16; 8] = [1, 1, 0, 1, 1025, 0, 1, 2];

/// Writes the values of a grid that has nodes, with rows from the lowest y on.
pub fn write(values: &[f64], grid: &Grid, out: &mut dyn Write) -> io::Result<()> {
    let mut bytes = Cursor::new(Vec::new());
    let is_big = 8 * values.len() as u64 > MOST_BYTES;
    let made = if is_big {
        TiffEncoder::new_big(&mut bytes).and_then(|encoder| encode(encoder, values, grid))
    } else {
        TiffEncoder::new(&mut bytes).and_then(|encoder| encode(encoder, values, grid))
    };
    made.map_err(io::Error::other)?;
    out.write_all(bytes.get_ref())
}

fn encode<K: TiffKind>(
    mut encoder: TiffEncoder<&mut Cursor<Vec<u8>>, K>,
    values: &[f64],
    grid: &Grid,
) -> TiffResult<()> {
    let [columns, rows] = grid.counts.map(u32::try_from);
    let (columns, rows) = (columns?, rows?);
    let ([x, _], step) = grid.origin();
    let mut image = encoder.new_image::<Gray64Float>(columns, rows)?;
    let tags = image.encoder();
    tags.write_tag(Tag::ModelPixelScaleTag, &[step, step, 0.0][..])?;
    // The first pixel, and its place.
    tags.write_tag(Tag::ModelTiepointTag, &[0.0, 0.0, 0.0, x, grid.top(), 0.0][..])?;
    tags.write_tag(Tag::GeoKeyDirectoryTag, &KEYS[..])?;
    tags.write_tag(Tag::GdalNodata, "nan")?;
    let mut lines = values.chunks(columns as usize).rev();
    let mut strip = Vec::new();
    while image.next_strip_sample_count() > 0 {
        let count = image.next_strip_sample_count() as usize;
        strip.clear();
        lines.by_ref().take(count / columns as usize).for_each(|line| strip.extend_from_slice(line));
        image.write_strip(&strip)?;
    }
    image.finish()
}
