//! The file of a tile's triangulation.

use std::io::{self, Write};
use std::path::Path;

use incircle::tiles::{Border, Region};
use incircle::Point;

use super::head::{Head, Kind};
use super::manifest::local_path;
use super::opened::{Opened, Owner};
use super::written::{write_checked, write_rows};
use crate::failure::Failure;
use crate::output::Written;

/// What is known of a tile once its points are triangulated.
#[derive(Clone, Debug, PartialEq)]
pub struct TileResult {
    /// The final triangles, in input indices. Empty if they were not read.
    pub finals: Vec<[u32; 3]>,
    /// The border, with input indices as ids.
    pub border: Border<Point, u32>,
    /// The hull of the points of the tile, in input indices.
    pub hull: Vec<u32>,
    /// Pairs of a duplicate and the lowest index at the same place.
    pub duplicates: Vec<[u32; 2]>,
}

impl TileResult {
    /// Writes the file of a tile under a working name.
    pub fn write(&self, folder: &Path, owner: Owner) -> Result<Written, Failure> {
        let Self { finals, border, hull, duplicates } = self;
        let counts = [finals.len(), border.points.len(), border.open.len(), hull.len(), duplicates.len()];
        let counts = counts.map(|count| count as u64);
        let head = Head { kind: Kind::Local, run: owner.run, tile: owner.tile, counts, check: 0 };
        write_checked(&local_path(folder, owner.tile), head, &mut |out| self.encode(out))
    }

    fn encode(&self, out: &mut dyn Write) -> io::Result<()> {
        write_rows(&self.finals, out)?;
        for (point, id) in self.border.points.iter().zip(&self.border.ids) {
            write_rows(&[[*id, point.x, point.y]], out)?;
        }
        write_rows(&self.border.open, out)?;
        write_rows(self.hull.as_chunks::<1>().0, out)?;
        write_rows(&self.duplicates, out)
    }

    /// Reads the file of a tile. Each final triangle goes to `take`, and the file is certain only if the result is.
    pub fn read(
        folder: &Path,
        owner: Owner,
        region: Region,
        take: &mut dyn FnMut([u32; 3]) -> Result<(), Failure>,
    ) -> Result<Self, Failure> {
        let mut opened = Self::open(folder, owner)?;
        let [finals, points, open, hull, duplicates] = opened.head.counts;
        opened.rows(finals, take)?;
        let mut border = Border { region, points: Vec::new(), ids: Vec::new(), open: Vec::new() };
        for [id, x, y] in opened.list(points)? {
            border.points.push(Point::new(x, y));
            border.ids.push(id);
        }
        border.open = opened.list(open)?;
        let hull = opened.list(hull)?.into_iter().map(|[id]| id).collect();
        let duplicates = opened.list(duplicates)?;
        opened.finish()?;
        Ok(Self { finals: Vec::new(), border, hull, duplicates })
    }

    /// Opens the file of a tile, whose length must be that of its lists.
    fn open(folder: &Path, owner: Owner) -> Result<Opened, Failure> {
        let bytes_of = |[finals, points, open, hull, duplicates]: &[u64; 5]| {
            let rows = finals.checked_add(*points)?.checked_add(*open)?.checked_mul(12)?;
            rows.checked_add(hull.checked_mul(4)?)?.checked_add(duplicates.checked_mul(8)?)
        };
        Opened::open(&local_path(folder, owner.tile), Kind::Local, Some(owner), Some(bytes_of))
    }
}
