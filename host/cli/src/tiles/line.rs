//! Sets whose points all lie on one line: no tile has a triangle, and every point would be in a border.

use std::path::Path;

use incircle::Point;

use super::manifest::Manifest;
use super::opened::Owner;
use super::result::TileFile;
use crate::failure::Failure;

/// The number of duplicates of a set whose distinct points lie on one line; `None` for other sets. Reads one point
/// after the other.
///
/// # Errors
/// The file of a tile is missing or damaged.
pub fn duplicates_on_line(folder: &Path, manifest: &Manifest) -> Result<Option<u64>, Failure> {
    let (mut line, mut duplicates) = (Line::default(), 0);
    for (tile, (region, _)) in (0..).zip(manifest.tiles()) {
        let file = TileFile::open(folder, Owner { run: manifest.run, tile }, manifest.points())?;
        if file.has_triangles() {
            return Ok(None);
        }
        duplicates += file.duplicates();
        file.each_border_point(region, &mut |point| line.add(point))?;
        if line.is_left {
            return Ok(None);
        }
    }
    Ok(Some(duplicates))
}

/// The line through the points seen so far.
#[derive(Default)]
struct Line {
    first: Option<Point>,
    /// The vector from the first point to another one.
    along: Option<[i128; 2]>,
    /// Whether a point lies beside the line.
    is_left: bool,
}

impl Line {
    fn add(&mut self, point: Point) {
        let first = *self.first.get_or_insert(point);
        let seen = [i128::from(point.x) - i128::from(first.x), i128::from(point.y) - i128::from(first.y)];
        match self.along {
            Some([x, y]) => self.is_left |= x * seen[1] != y * seen[0],
            None if seen != [0, 0] => self.along = Some(seen),
            None => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_point_beside_a_line_is_found() {
        let mut line = Line::default();
        [(5, 5), (5, 5), (u32::MAX, u32::MAX), (0, 0)].map(Point::from).into_iter().for_each(|point| line.add(point));
        assert!(!line.is_left);
        line.add(Point::new(u32::MAX, u32::MAX - 1));
        assert!(line.is_left);
    }
}
