//! The third verb: the borders of all tiles are joined up the tree, and the triangles are brought into order.

use std::path::Path;

use incircle::tiles::{self, Border, Region, Step, Tile};
use incircle::Point;

use super::disk::told;
use super::head::damaged;
use super::line;
use super::manifest::{local_path, manifest_path, Manifest};
use super::merge::{merge, Source, Take};
use super::opened::Owner;
use super::result::TileFile;
use super::runs::Runs;
use crate::failure::Failure;
use crate::memory::Memory;
use crate::path;
use crate::progress::CountMeter;

/// One byte in this many of the memory is for the triangles of the joins. They are few, and the rest is for borders.
const SHARE: u64 = 8;
/// The most bytes that a point of the borders takes while they are joined. Measured: 105 for points on a circle, and
/// 112 for points on a parabola.
const JOIN_BYTES: u64 = 112;
/// The bytes that the program itself takes while it joins. Measured: 9 MiB.
const PROGRAM: u64 = 10 << 20;
/// The bytes of a point or of an open triangle of a border that waits to be joined.
const ROW: u64 = 12;

/// The order of the triangles of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The canonical order: the sorted lists of all tiles are merged.
    Canonical,
    /// Those of the joins first, then those of one tile after the other.
    Unordered,
}

/// A set whose tiles are joined.
pub struct Joined {
    /// The number of triangles.
    pub triangles: u64,
    /// The number of points that have the place of an earlier one.
    pub duplicates: u64,
    /// The number of points on the hull.
    pub hull_points: u64,
    /// The hull, in the form of [`incircle::Mesh::hull`]. Empty if all points lie on one line and no lists were asked
    /// for.
    pub hull: Vec<u32>,
    /// The duplicates themselves, if they were asked for: pairs of a duplicate and the lowest index at the same place,
    /// sorted.
    pub pairs: Vec<[u32; 2]>,
    /// Triangles of the joins. The others are in the files of the tiles.
    runs: Runs,
}

/// The memory of a join.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JoinMemory {
    /// The bytes for sorting triangles.
    pub sort: u64,
    /// The bytes of the whole process that the joins must not exceed; `None` for no bound.
    pub bound: Option<u64>,
}

/// Joins the tiles of a folder. The memory holds the borders of up to 3 regions for each level of the tree, the points
/// of one join, and triangles. `keeps_lists` asks for the hull and the duplicates, and not only for their numbers.
///
/// # Errors
/// A tile has no file yet, or a file is damaged or of another run, or the disk is full, or a join does not fit the
/// memory.
pub fn join(
    folder: &Path,
    manifest: &Manifest,
    memory: JoinMemory,
    keeps_lists: bool,
    quiet: bool,
) -> Result<Joined, Failure> {
    check_there(folder, manifest)?;
    Memory::give_back_lists();
    let points = manifest.points();
    let runs = Runs::new(folder, memory.sort / SHARE);
    let joined = Joined { triangles: 0, duplicates: 0, hull_points: 0, hull: Vec::new(), pairs: Vec::new(), runs };
    let mut work = Work { folder, manifest, memory, keeps_lists, joined, borders: Vec::new(), tile: 0 };
    let on_line = if keeps_lists { None } else { line::duplicates_on_line(folder, manifest)? };
    if let Some(duplicates) = on_line {
        let joined = &mut work.joined;
        (joined.duplicates, joined.hull_points) = (duplicates, points.saturating_sub(duplicates));
        joined.check_counts(points, folder)?;
        return Ok(work.joined);
    }
    let meter = CountMeter::new(manifest.steps.len() as u64, "joining", "regions", quiet);
    for step in &manifest.steps {
        match step {
            Step::Tile { region, .. } => work.tile(*region)?,
            Step::Join { region, children } => work.join(*region, *children)?,
        }
        meter.advance(1);
    }
    let mut joined = work.joined;
    joined.hull_points = joined.hull.len() as u64;
    joined.pairs.sort_unstable();
    joined.check_counts(points, folder)?;
    Ok(joined)
}

/// Refuses a folder in which tiles are not done yet.
fn check_there(folder: &Path, manifest: &Manifest) -> Result<(), Failure> {
    let count = manifest.tiles().count();
    let missing: Vec<u32> = (0..count as u32).filter(|&tile| !local_path(folder, tile).exists()).collect();
    if missing.is_empty() {
        return Ok(());
    }
    const SHOWN: usize = 10;
    let mut shown: Vec<String> = missing.iter().take(SHOWN).map(u32::to_string).collect();
    if missing.len() > SHOWN {
        shown.push(format!("and {} more", missing.len() - SHOWN));
    }
    let (folder, verb) = (path::name(folder), if missing.len() == 1 { "is" } else { "are" });
    Err(Failure::input(format!(
        "{} of the {count} tiles in {folder} {verb} not triangulated yet: run 'incircle tile local {folder}/K' for \
         K = {}",
        missing.len(),
        shown.join(", ")
    )))
}

struct Work<'a> {
    folder: &'a Path,
    manifest: &'a Manifest,
    memory: JoinMemory,
    keeps_lists: bool,
    joined: Joined,
    borders: Vec<Border<Point, u32>>,
    tile: u32,
}

impl Work<'_> {
    fn tile(&mut self, region: Region) -> Result<(), Failure> {
        let owner = Owner { run: self.manifest.run, tile: self.tile };
        let mut file = TileFile::open(self.folder, owner, self.manifest.points())?;
        let read = file.result(region, self.keeps_lists)?;
        let joined = &mut self.joined;
        joined.triangles += file.finals();
        joined.duplicates += file.duplicates();
        joined.pairs.extend(read.duplicates);
        joined.hull = read.hull;
        self.borders.push(read.border);
        self.tile += 1;
        Ok(())
    }

    /// Joins the borders that were put onto the stack last.
    fn join(&mut self, region: Region, children: usize) -> Result<(), Failure> {
        let first = self.borders.len().saturating_sub(children);
        self.check_memory(first)?;
        let Tile { finals, border, hull, .. } =
            tiles::join_among(region, self.borders.split_off(first), &self.manifest.occupancy).map_err(|error| {
                let name = path::name(&manifest_path(self.folder));
                damaged(&format!("the borders of its tiles do not fit together: {error}")).in_file(name)
            })?;
        self.joined.triangles += finals.len() as u64;
        self.joined.runs.add(&finals)?;
        self.joined.hull = hull;
        self.borders.push(border);
        Ok(())
    }
}

impl Work<'_> {
    /// Refuses a join of the borders from `first` on that does not fit the memory.
    fn check_memory(&self, first: usize) -> Result<(), Failure> {
        let Some(bound) = self.memory.bound else { return Ok(()) };
        let (waiting, joined) = self.borders.split_at(first);
        let points: u64 = joined.iter().map(|border| border.points.len() as u64).sum();
        let waiting: u64 = waiting.iter().map(|border| ROW * (border.points.len() + border.open.len()) as u64).sum();
        let needed = PROGRAM + self.memory.sort / SHARE + waiting + points * JOIN_BYTES;
        if needed <= bound {
            return Ok(());
        }
        // A larger memory has a larger share for triangles, too.
        let mebibytes = (needed + needed / SHARE).div_ceil(1 << 20);
        Err(Failure::input(format!(
            "{points} points are joined at once, because large circles through them are empty, and that takes {} of the \
             {} of --memory: go on with --memory {mebibytes}M",
            told(needed),
            told(bound)
        )))
    }
}

/// The number of triangles of a mesh by Euler's formula, from the number of its vertices and of those on the hull. In a
/// mesh without triangles all points are on the hull; if they are not, the result is the number of all others.
pub fn euler(distinct: u64, hull: u64, has_triangles: bool) -> u64 {
    match has_triangles {
        true => (2 * distinct).saturating_sub(2 + hull),
        false => distinct.saturating_sub(hull),
    }
}

impl Joined {
    /// Euler's formula counts the triangles of a mesh, so tiles that contradict each other are found.
    fn check_counts(&self, points: u64, folder: &Path) -> Result<(), Failure> {
        let (distinct, hull) = (points.saturating_sub(self.duplicates), self.hull_points);
        let expected = euler(distinct, hull, self.triangles > 0);
        if self.triangles == expected && self.duplicates <= points {
            return Ok(());
        }
        Err(Failure::input(format!(
            "the tiles of {} contradict each other: {} triangles of {distinct} distinct points and {} duplicates with \
             {hull} on the hull should be {expected}; split the set again",
            path::name(folder),
            self.triangles,
            self.duplicates
        )))
    }

    /// Calls `take` with all triangles in this order. The triangles of the joins and the lists of the tiles take about
    /// `memory` bytes.
    ///
    /// # Errors
    /// A file is damaged, which may show only after all triangles were taken, or `take` fails.
    pub fn each(
        self,
        (folder, manifest): (&Path, &Manifest),
        order: Order,
        memory: u64,
        take: &mut Take<'_>,
    ) -> Result<(), Failure> {
        let (in_memory, runs) = self.runs.finish();
        // The triangles of the joins may have their share.
        let memory = memory - memory / SHARE;
        let mut sources = vec![Source::Memory(in_memory.into_iter())];
        sources.extend(runs.into_iter().map(Source::Run));
        let tiles = (0..manifest.tiles().count() as u32).map(|tile| {
            let owner = Owner { run: manifest.run, tile };
            Ok(Source::Tile(TileFile::open(folder, owner, manifest.points())?.into_finals()))
        });
        match order {
            Order::Canonical => {
                let tiles: Vec<Source> = tiles.collect::<Result<_, Failure>>()?;
                sources.extend(tiles);
                merge(sources, memory, take)
            }
            Order::Unordered => {
                sources.into_iter().map(Ok).chain(tiles).try_for_each(|source| merge(vec![source?], memory, take))
            }
        }
    }
}

/// All triangles as one list, which the memory must hold.
pub fn triangles_of(joined: Joined, folder: &Path, manifest: &Manifest, memory: u64) -> Result<Vec<[u32; 3]>, Failure> {
    let mut list = Vec::new();
    let count = usize::try_from(joined.triangles).unwrap_or(usize::MAX);
    list.try_reserve_exact(count).map_err(|_| Failure::input(format!("{count} triangles do not fit the memory")))?;
    joined.each((folder, manifest), Order::Canonical, memory, &mut |triangles| {
        list.extend_from_slice(triangles);
        Ok(())
    })?;
    Ok(list)
}
