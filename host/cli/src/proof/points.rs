//! The points of a proof: sorted, without duplicates, with their hull, and once more in the order of their indices.

use std::path::{Path, PathBuf};

use incircle::verify::local::{sector, turn};
use incircle::Point;

use super::budget::Budget;
use super::sorter::{Sorted, Sorter, Stream};
use super::spill::Spill;
use super::stack::Stack;
use crate::arguments::ReadArguments;
use crate::failure::Failure;
use crate::path;
use crate::tiles::{each_piece, Digest, Extent, Ground};

/// The most points of a set: each index fits 32 bits, and two values stay free.
const MOST_POINTS: u64 = u32::MAX as u64 - 1;
/// The number of rows that are written or read at once.
const ROWS: usize = 1 << 13;

/// The inputs of a set, read once.
pub struct Survey {
    /// The lattice of all points.
    pub ground: Ground,
    /// The number of points.
    pub points: u64,
    digests: Vec<Digest>,
}

impl Survey {
    /// Reads all inputs for the first time.
    ///
    /// # Errors
    /// An input cannot be read, or the points have no lattice of up to 32 bits in common.
    pub fn of(paths: &[PathBuf], read: &ReadArguments, quiet: bool) -> Result<Self, Failure> {
        let (mut extent, mut digests, mut points) = (Extent::default(), Vec::new(), 0);
        for path in paths {
            let mut digest = Digest::default();
            each_piece(path, read, quiet, &mut |piece| {
                digest.add(piece);
                if points + digest.points() > MOST_POINTS {
                    return Err(Failure::input(format!(
                        "a set has at most {MOST_POINTS} points, and this one has more"
                    )));
                }
                extent.add(piece).map_err(|failure| failure.in_file(path::name(path)))
            })?;
            points += digest.points();
            digests.push(digest);
        }
        Ok(Self { ground: extent.ground()?, points, digests })
    }

    /// Reads all inputs again, and calls `take` with each point and its index.
    fn each(
        &self,
        (paths, read, quiet): (&[PathBuf], &ReadArguments, bool),
        take: &mut dyn FnMut(u32, Point) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let (mut index, mut grid) = (0u32, Vec::new());
        for (path, seen) in paths.iter().zip(&self.digests) {
            let mut digest = Digest::default();
            each_piece(path, read, quiet, &mut |piece| {
                digest.add(piece);
                grid.clear();
                if digest.points() > seen.points() || self.ground.lay(piece, &mut grid).is_none() {
                    return Err(changed(path));
                }
                for &point in &grid {
                    take(index, point)?;
                    index += 1;
                }
                Ok(())
            })?;
            if digest != *seen {
                return Err(changed(path));
            }
        }
        Ok(())
    }
}

/// The points of a set, ready for a proof.
pub struct Sites {
    /// The number of points.
    pub points: u64,
    /// The number of distinct points.
    pub distinct: u64,
    /// Whether there are fewer than three distinct points, or all lie on one line.
    pub is_collinear: bool,
    /// All points as x and y, in the order of their indices.
    indexed: Spill,
    /// The distinct points as x, y and their lowest index, in lexicographic order.
    sorted: Spill,
    /// The first point of each strip. A strip has consecutive distinct points in lexicographic order.
    strips: Vec<Point>,
    /// The number of points of each strip but the last.
    strip: usize,
    /// Each duplicate, and the lowest index at its place.
    duplicates: Sorted<2>,
    /// The hull.
    pub hull: Hull,
}

/// The hull of a set.
pub struct Hull {
    /// The number of points on it.
    pub count: u64,
    /// Twice its area.
    pub area: i128,
    /// The place of the lowest index.
    pub start: u32,
    /// Rows of a strip, the two points of an edge in rising order, whether the edge runs the other way, and its place on
    /// the hull. The strip is the one of the first point.
    pub edges: Sorted<5>,
}

impl Sites {
    /// Reads all inputs again, and sorts their points.
    ///
    /// # Errors
    /// An input cannot be read or has changed, or the folder cannot be written.
    pub fn of(
        survey: &Survey,
        inputs: (&[PathBuf], &ReadArguments, bool),
        folder: &Path,
        budget: &Budget,
    ) -> Result<Self, Failure> {
        let mut indexed = Writer::new(folder)?;
        let mut sorter = Sorter::new(folder, budget.share(2));
        survey.each(inputs, &mut |index, point| {
            indexed.push([point.x, point.y])?;
            sorter.push([point.x, point.y, index])
        })?;
        let indexed = indexed.finish()?;
        let rows = sorter.finish()?;
        let mut merged = Merged::new(folder, budget)?;
        let mut stream = rows.stream(budget.share(4))?;
        while let Some(row) = stream.take()? {
            merged.push(row)?;
        }
        let Merged { sorted, strips, strip, distinct, duplicates, sides, is_collinear, .. } = merged;
        let hull = match is_collinear {
            true => Hull { count: distinct, area: 0, start: 0, edges: Sorter::new(folder, 0).finish()? },
            false => Hull::of(sides, &strips, folder, budget.share(16))?,
        };
        let (sorted, duplicates) = (sorted.finish()?, duplicates.finish()?);
        Ok(Self { points: survey.points, distinct, is_collinear, indexed, sorted, strips, strip, duplicates, hull })
    }

    /// The number of strips.
    pub fn strips(&self) -> usize {
        self.strips.len()
    }

    /// The strip of a point of the set.
    pub fn strip_of(&self, point: Point) -> usize {
        strip_of(&self.strips, point)
    }

    /// The rows of a strip: x, y and index.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn rows(&self, strip: usize) -> Result<Vec<[u32; 3]>, Failure> {
        let first = strip as u64 * self.strip as u64;
        let count = self.distinct.saturating_sub(first).min(self.strip as u64) as usize;
        let mut rows = Vec::with_capacity(count);
        self.sorted.read(first * 12, count, &mut rows)?;
        Ok(rows)
    }

    /// The duplicates, to be asked for rising indices.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn duplicates(&self, memory: u64) -> Result<Duplicates<'_>, Failure> {
        Ok(Duplicates { stream: self.duplicates.stream(memory)? })
    }

    /// The points by their indices.
    pub fn indexed(&self) -> Indexed<'_> {
        Indexed { spill: &self.indexed, first: 0, rows: Vec::new() }
    }
}

/// The duplicates of a set, one after the other.
pub struct Duplicates<'a> {
    stream: Stream<'a, 2>,
}

impl Duplicates<'_> {
    /// The lowest index at the place of a point, if that is another one. Indices must rise from call to call.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn lowest(&mut self, index: u32) -> Result<Option<u32>, Failure> {
        while let Some(&[duplicate, of]) = self.stream.peek() {
            if duplicate >= index {
                return Ok((duplicate == index).then_some(of));
            }
            self.stream.take()?;
        }
        Ok(None)
    }
}

/// The points of a set by their indices. Rising indices are read in one go.
pub struct Indexed<'a> {
    spill: &'a Spill,
    first: u64,
    rows: Vec<[u32; 2]>,
}

impl Indexed<'_> {
    /// The point at an index, which must exist.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn at(&mut self, index: u32) -> Result<Point, Failure> {
        let place = u64::from(index).wrapping_sub(self.first);
        let row = match usize::try_from(place).ok().and_then(|place| self.rows.get(place)) {
            Some(&row) => row,
            None => {
                self.first = u64::from(index) / ROWS as u64 * ROWS as u64;
                let left = (self.spill.length() / 8).saturating_sub(self.first);
                self.rows.clear();
                self.spill.read(self.first * 8, left.min(ROWS as u64) as usize, &mut self.rows)?;
                self.rows.get((u64::from(index) - self.first) as usize).copied().unwrap_or_default()
            }
        };
        Ok(row.into())
    }
}

/// A file of rows that is written from its begin to its end.
struct Writer<const N: usize> {
    spill: Spill,
    rows: Vec<[u32; N]>,
}

impl<const N: usize> Writer<N> {
    fn new(folder: &Path) -> Result<Self, Failure> {
        Ok(Self { spill: Spill::create(folder)?, rows: Vec::new() })
    }

    fn push(&mut self, row: [u32; N]) -> Result<(), Failure> {
        self.rows.push(row);
        if self.rows.len() == ROWS {
            self.spill.append(&self.rows)?;
            self.rows.clear();
        }
        Ok(())
    }

    fn finish(mut self) -> Result<Spill, Failure> {
        self.spill.append(&self.rows)?;
        Ok(self.spill)
    }
}

/// What becomes of points that come in lexicographic order.
struct Merged {
    sorted: Writer<3>,
    strips: Vec<Point>,
    strip: usize,
    distinct: u64,
    duplicates: Sorter<2>,
    last: Option<[u32; 3]>,
    /// The first two distinct points.
    first: Vec<Point>,
    is_collinear: bool,
    /// The lower and the upper side of the hull, from left to right (Andrew's monotone chain).
    sides: [Stack; 2],
}

impl Merged {
    fn new(folder: &Path, budget: &Budget) -> Result<Self, Failure> {
        Ok(Self {
            sorted: Writer::new(folder)?,
            strips: Vec::new(),
            strip: budget.strip,
            distinct: 0,
            duplicates: Sorter::new(folder, budget.share(16)),
            last: None,
            first: Vec::new(),
            is_collinear: true,
            sides: [Stack::new(folder), Stack::new(folder)],
        })
    }

    fn push(&mut self, row: [u32; 3]) -> Result<(), Failure> {
        if let Some([.., lowest]) = self.last.filter(|last| last[..2] == row[..2]) {
            return self.duplicates.push([row[2], lowest]);
        }
        self.last = Some(row);
        let point = point_of(row);
        if self.distinct.is_multiple_of(self.strip as u64) {
            self.strips.push(point);
        }
        self.distinct += 1;
        match self.first[..] {
            [one, other] => self.is_collinear &= turn(one, other, point).is_eq(),
            _ => self.first.push(point),
        }
        let [lower, upper] = &mut self.sides;
        while lower.last_two().is_some_and(|[a, b]| turn(point_of(a), point_of(b), point).is_lt()) {
            lower.pop()?;
        }
        lower.push(row)?;
        while upper.last_two().is_some_and(|[a, b]| turn(point_of(a), point_of(b), point).is_gt()) {
            upper.pop()?;
        }
        upper.push(row)?;
        self.sorted.push(row)
    }
}

impl Hull {
    /// The hull with these sides, which begin at one point and end at another one. The points on its edges belong to it.
    fn of(sides: [Stack; 2], strips: &[Point], folder: &Path, memory: u64) -> Result<Self, Failure> {
        let [mut lower, mut upper] = sides;
        let count = (lower.len() + upper.len()).saturating_sub(2);
        let mut hull = Self { count, area: 0, start: 0, edges: Sorter::new(folder, 0).finish()? };
        let (mut edges, mut lowest) = (Sorter::new(folder, memory), u32::MAX);
        let mut add = |hull: &mut Self, place: u64, [from, to]: [[u32; 3]; 2]| {
            let place = (place % count.max(1)) as u32;
            hull.area += sector(point_of(from), point_of(to));
            if from[2] < lowest {
                (lowest, hull.start) = (from[2], place);
            }
            let (least, most) = if from[2] < to[2] { (from, to) } else { (to, from) };
            let strip = strip_of(strips, point_of(least)) as u32;
            edges.push([strip, least[2], most[2], u32::from(from[2] > to[2]), place])
        };
        // The lower side runs counter-clockwise, and comes from its end here; the upper one the other way round.
        let mut after = lower.pop()?;
        while let (Some(to), Some(from)) = (after, lower.pop()?) {
            add(&mut hull, lower.len(), [from, to])?;
            after = Some(from);
        }
        let (mut from, mut place) = (upper.pop()?, count.saturating_sub(upper.len()));
        while let (Some(begin), Some(to)) = (from, upper.pop()?) {
            add(&mut hull, place, [begin, to])?;
            (from, place) = (Some(to), place + 1);
        }
        hull.edges = edges.finish()?;
        Ok(hull)
    }

    /// The place of an edge when counting begins at the lowest index.
    pub fn rank(&self, place: u32) -> u64 {
        (u64::from(place) + self.count - u64::from(self.start)) % self.count.max(1)
    }
}

/// The failure of an input that is not the same as at first.
fn changed(path: &Path) -> Failure {
    Failure::input(format!(
        "{} has changed while it was read: verify the mesh again, and leave the file alone meanwhile",
        path::name(path)
    ))
}

fn point_of([x, y, _]: [u32; 3]) -> Point {
    Point::new(x, y)
}

fn strip_of(strips: &[Point], point: Point) -> usize {
    strips.partition_point(|first| *first <= point).saturating_sub(1)
}
