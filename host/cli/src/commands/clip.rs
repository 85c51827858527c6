//! The polygon to which cells are clipped.

use std::path::{Path, PathBuf};

use incircle::voronoi::{Clip, Error};
use incircle::Point;

use crate::arguments::{ReadArguments, Rectangle};
use crate::failure::Failure;
use crate::formats::geojson_ring::{self, Rings};
use crate::formats::PointFormat;
use crate::input::Input;
use crate::path::{extension, name};
use crate::points::PointTable;
use crate::source;

/// The corners of a clip, in the numbers in which they are written.
pub struct Border {
    /// The corners of all rings, or two opposite corners of a rectangle.
    pub corners: PointTable,
    /// The number of corners of each ring: the outer one, then the holes. Empty for a rectangle.
    counts: Vec<usize>,
    /// The option or the file from which the clip comes, for messages.
    from: String,
}

impl Border {
    /// The clip of `--clip` or `--clip-to`; `None` if neither is given.
    pub fn read(rectangle: Option<&Rectangle>, file: Option<&PathBuf>, quiet: bool) -> Result<Option<Self>, Failure> {
        if let Some(Rectangle(numbers)) = rectangle {
            let mut corners = PointTable::of_items("corner");
            for [x, y] in [[&numbers[0], &numbers[1]], [&numbers[2], &numbers[3]]] {
                corners.push([x.as_bytes(), y.as_bytes()], 0)?;
            }
            return Ok(Some(Self { corners: corners.complete()?, counts: Vec::new(), from: "--clip".to_owned() }));
        }
        let Some(file) = file else { return Ok(None) };
        let Rings { corners, counts } = read_rings(file, quiet)?;
        Ok(Some(Self { corners, counts, from: name(file) }))
    }

    /// The clip whose corners fell onto these grid points.
    pub fn clip(&self, grid: &[Point]) -> Result<Clip, Failure> {
        let clip = match (&self.counts[..], grid) {
            ([], &[one, other]) => Clip::rectangle(one, other),
            ([], _) => Clip::polygon(grid),
            (counts, _) => Clip::of_rings(grid, counts),
        };
        let told = |error: Error| match error {
            Error::MisplacedHole { hole } => format!(
                "hole {} of the clip, counted from 1, lies outside its outer ring or inside another hole: give holes \
                 that lie side by side within the outer ring",
                hole + 1
            ),
            other => other.to_string(),
        };
        clip.map_err(|error| Failure::input(told(error)).in_file(&self.from))
    }
}

/// Reads the rings of a polygon: those of a GeoJSON polygon, or the points of any other file, in their order, as the
/// only one.
fn read_rings(file: &Path, quiet: bool) -> Result<Rings, Failure> {
    let format = PointFormat::of_extension(extension(file));
    if matches!(format, Some(PointFormat::Geojson | PointFormat::Json)) {
        let read = || {
            let input = Input::open(file, quiet)?;
            let memory = input.memory();
            geojson_ring::read(&input.into_bytes()?, memory)
        };
        return read().map_err(|failure| failure.in_file(name(file)));
    }
    let corners = source::read_points(file, &ReadArguments::of_whole_file(), quiet)?;
    let counts = vec![corners.len()];
    Ok(Rings { corners, counts })
}

/// The smallest rectangle around grid points; `None` if it has no area.
pub fn around(points: &[Point]) -> Option<Clip> {
    let (xs, ys) = (points.iter().map(|point| point.x), points.iter().map(|point| point.y));
    let low = Point::new(xs.clone().min()?, ys.clone().min()?);
    Clip::rectangle(low, Point::new(xs.max()?, ys.max()?)).ok()
}
