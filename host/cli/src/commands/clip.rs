//! The polygon to which cells are clipped.

use std::path::{Path, PathBuf};

use incircle::voronoi::Clip;
use incircle::Point;

use crate::arguments::{ReadArguments, Rectangle};
use crate::failure::Failure;
use crate::formats::{geojson_ring, PointFormat};
use crate::input::Input;
use crate::path::{extension, name};
use crate::points::PointTable;
use crate::source;

/// The corners of a clip, in the numbers in which they are written.
pub struct Border {
    /// The corners of the ring, or two opposite corners of a rectangle.
    pub corners: PointTable,
    is_rectangle: bool,
    /// Where the clip comes from, for messages.
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
            return Ok(Some(Self { corners: corners.complete()?, is_rectangle: true, from: "--clip".to_owned() }));
        }
        let Some(file) = file else { return Ok(None) };
        let corners = read_ring(file, quiet)?;
        Ok(Some(Self { corners, is_rectangle: false, from: name(file) }))
    }

    /// The clip whose corners fell onto these grid points.
    pub fn clip(&self, grid: &[Point]) -> Result<Clip, Failure> {
        let clip = match (self.is_rectangle, grid) {
            (true, &[one, other]) => Clip::rectangle(one, other),
            _ => Clip::polygon(grid),
        };
        clip.map_err(|error| Failure::input(error.to_string()).in_file(&self.from))
    }
}

/// Reads the corners of a polygon: those of a GeoJSON polygon, or the points of any other file in their order.
fn read_ring(file: &Path, quiet: bool) -> Result<PointTable, Failure> {
    let format = PointFormat::of_extension(extension(file));
    if matches!(format, Some(PointFormat::Geojson | PointFormat::Json)) {
        let read = || {
            let input = Input::open(file, quiet)?;
            let memory = input.memory();
            geojson_ring::read(&input.into_bytes()?, memory)
        };
        return read().map_err(|failure| failure.in_file(name(file)));
    }
    source::read_points(file, &ReadArguments::of_whole_file(), quiet)
}

/// The smallest rectangle around grid points; `None` if it has no area.
pub fn around(points: &[Point]) -> Option<Clip> {
    let (xs, ys) = (points.iter().map(|point| point.x), points.iter().map(|point| point.y));
    let low = Point::new(xs.clone().min()?, ys.clone().min()?);
    Clip::rectangle(low, Point::new(xs.max()?, ys.max()?)).ok()
}
