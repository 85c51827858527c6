//! The file of a tile's triangulation.

use std::io::{self, Write};
use std::path::Path;

use incircle::tiles::{Border, Region};
use incircle::Point;

use super::canonical::is_ordered;
use super::head::{damaged, Head, Kind};
use super::manifest::local_path;
use super::opened::{Opened, Owner};
use super::written::{write_checked, write_rows};
use crate::failure::Failure;
use crate::output::Written;
use crate::path;

/// Writes rows behind others; called twice, and must write the same both times.
pub type WriteRows<'a> = dyn FnMut(&mut dyn Write) -> io::Result<()> + 'a;

/// The bytes of the check sum behind the final triangles.
const SUM_BYTES: u64 = 4;

/// The triangulation of a tile, without its final triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct TileResult {
    /// The border, with input indices as ids.
    pub border: Border<Point, u32>,
    /// The hull of the points of the tile, in input indices.
    pub hull: Vec<u32>,
    /// Pairs of a duplicate and the lowest index at the same place. Empty if they were not asked for.
    pub duplicates: Vec<[u32; 2]>,
}

impl TileResult {
    /// Writes the file of a tile under a working name. The final triangles are in input indices and in canonical order.
    pub fn write(&self, finals: &[[u32; 3]], folder: &Path, owner: Owner) -> Result<Written, Failure> {
        let count = self.duplicates.len() as u64;
        self.write_with((count, &mut |out| write_rows(&self.duplicates, out)), finals, folder, owner)
    }

    /// Writes the file as [`write`](Self::write) does, with so many duplicates that a function writes, which is called
    /// twice. So no list of them need be in memory.
    pub fn write_with(
        &self,
        (count, duplicates): (u64, &mut WriteRows<'_>),
        finals: &[[u32; 3]],
        folder: &Path,
        owner: Owner,
    ) -> Result<Written, Failure> {
        let Self { border, hull, .. } = self;
        let counts = [finals.len(), border.points.len(), border.open.len(), hull.len()].map(|count| count as u64);
        let [finals_count, points, open, hull] = counts;
        let counts = [finals_count, points, open, hull, count];
        let head = Head { kind: Kind::Local, run: owner.run, tile: owner.tile, counts, check: 0 };
        let mut content = |out: &mut dyn Write| {
            self.encode(out)?;
            duplicates(out)
        };
        write_checked(&local_path(folder, owner.tile), head, &mut content, Some(finals))
    }

    /// Writes the lists before the duplicates.
    fn encode(&self, out: &mut dyn Write) -> io::Result<()> {
        let points = self.border.points.iter().zip(&self.border.ids).map(|(point, &id)| [id, point.x, point.y]);
        write_rows(&points.collect::<Vec<_>>(), out)?;
        write_rows(&self.border.open, out)?;
        write_rows(self.hull.as_chunks::<1>().0, out)
    }
}

/// The file of a tile, which is read in two steps.
pub struct TileFile {
    opened: Opened,
    name: String,
    /// The number of points of the whole set, which all indices must be below.
    points: u64,
}

impl TileFile {
    /// Opens the file of a tile, whose length must be that of its lists. All indices must be below `points`.
    pub fn open(folder: &Path, owner: Owner, points: u64) -> Result<Self, Failure> {
        let bytes_of = |[finals, points, open, hull, duplicates]: &[u64; 5]| {
            let rows = finals.checked_add(*points)?.checked_add(*open)?.checked_mul(12)?;
            let lists = hull.checked_mul(4)?.checked_add(duplicates.checked_mul(8)?)?;
            rows.checked_add(lists)?.checked_add(SUM_BYTES)
        };
        let path = local_path(folder, owner.tile);
        let opened = Opened::open(&path, Kind::Local, Some(owner), Some(bytes_of))?;
        Ok(Self { opened, name: path::name(&path), points })
    }

    /// The number of final triangles.
    pub fn finals(&self) -> u64 {
        self.opened.head.counts[0]
    }

    /// The number of duplicates.
    pub fn duplicates(&self) -> u64 {
        self.opened.head.counts[4]
    }

    /// Whether the tile has triangles, final or open.
    pub fn has_triangles(&self) -> bool {
        self.opened.head.counts[0] > 0 || self.opened.head.counts[2] > 0
    }

    /// Calls `take` with each point of the border, for a file of which nothing was read, and checks what is not final.
    pub fn each_border_point(mut self, region: Region, take: &mut dyn FnMut(Point)) -> Result<(), Failure> {
        let [_, points, open, hull, duplicates] = self.opened.head.counts;
        let mut is_beyond = false;
        self.opened.rows(points, |[_, x, y]| {
            is_beyond |= !region.contains([x.into(), y.into()]);
            take(Point::new(x, y));
            Ok(())
        })?;
        self.opened.rows(open, |_: [u32; 3]| Ok(()))?;
        self.opened.rows(hull, |_: [u32; 1]| Ok(()))?;
        self.opened.rows(duplicates, |_: [u32; 2]| Ok(()))?;
        self.opened.end_of_content()?;
        self.check_region(is_beyond)
    }

    /// Reads all but the final triangles, and checks it.
    pub fn result(&mut self, region: Region, keep_duplicates: bool) -> Result<TileResult, Failure> {
        let [_, points, open, hull, duplicates] = self.opened.head.counts;
        let mut border = Border { region, points: Vec::new(), ids: Vec::new(), open: Vec::new() };
        let room = usize::try_from(points).unwrap_or(usize::MAX);
        let has_room = border.points.try_reserve_exact(room).and_then(|()| border.ids.try_reserve_exact(room));
        has_room.map_err(|_| Failure::input(format!("the {points} points of {} do not fit the memory", self.name)))?;
        let mut is_beyond = false;
        self.opened.rows(points, |[id, x, y]| {
            is_beyond |= !region.contains([x.into(), y.into()]);
            border.points.push(Point::new(x, y));
            border.ids.push(id);
            Ok(())
        })?;
        border.open = self.opened.list(open)?;
        let hull = self.opened.list(hull)?.into_iter().map(|[id]| id).collect();
        let (mut pairs, mut most) = (Vec::new(), None);
        self.opened.rows(duplicates, |pair: [u32; 2]| {
            most = most.max(pair.into_iter().max());
            if keep_duplicates {
                pairs.push(pair);
            }
            Ok(())
        })?;
        self.opened.end_of_content()?;
        self.check_region(is_beyond)?;
        let result = TileResult { border, hull, duplicates: pairs };
        let indices = result.border.ids.iter().chain(&result.hull).copied();
        self.check_index(indices.max().max(most))?;
        Ok(result)
    }

    /// The final triangles, for a file of which nothing was read. The file is closed until some are read.
    pub fn into_finals(mut self) -> Finals {
        let left = self.finals();
        self.opened.skip(self.opened.left() - left * 12 - SUM_BYTES);
        Finals { file: self, left, last: None }
    }

    /// Reads what follows the result, and checks it.
    pub fn check_finals(self) -> Result<(), Failure> {
        let (left, mut some) = (self.finals(), Vec::new());
        let mut finals = Finals { file: self, left, last: None };
        while finals.left > 0 {
            some.clear();
            finals.read(&mut some, 1 << 16)?;
        }
        finals.end()
    }

    fn check_region(&self, is_beyond: bool) -> Result<(), Failure> {
        match is_beyond {
            true => Err(damaged("a point lies beyond its region").in_file(&self.name)),
            false => Ok(()),
        }
    }

    fn check_index(&self, most: Option<u32>) -> Result<(), Failure> {
        match most {
            Some(index) if u64::from(index) >= self.points => {
                let points = self.points;
                Err(damaged(&format!("it names point {index} of a set of {points} points")).in_file(&self.name))
            }
            _ => Ok(()),
        }
    }
}

/// The final triangles of a tile, in canonical order, which are read some at a time. None of them is certain before
/// [`end`](Self::end) has compared the check sum.
pub struct Finals {
    file: TileFile,
    /// Triangles that were not read yet.
    left: u64,
    last: Option<[u32; 3]>,
}

impl Finals {
    /// Whether triangles are left to be read.
    pub fn has_more(&self) -> bool {
        self.left > 0
    }

    /// Adds up to `most` triangles to a list, and closes the file.
    pub fn read(&mut self, list: &mut Vec<[u32; 3]>, most: usize) -> Result<(), Failure> {
        let (first, count) = (list.len(), self.left.min(most as u64));
        self.file.opened.rows(count, |row| {
            list.push(row);
            Ok(())
        })?;
        self.file.opened.close();
        self.left -= count;
        let read = &list[first..];
        self.file.check_index(read.iter().flatten().copied().max())?;
        let follows = self.last.iter().chain(read.first()).is_sorted();
        if !follows || !is_ordered(read) {
            return Err(damaged("its triangles are not in order").in_file(&self.file.name));
        }
        self.last = read.last().copied().or(self.last);
        Ok(())
    }

    /// Checks what was read.
    pub fn end(self) -> Result<(), Failure> {
        self.file.opened.finish_with_sum()
    }
}
