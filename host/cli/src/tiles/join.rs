//! The third verb: the borders of all tiles are joined up the tree, and the triangles are brought into order.

use std::path::Path;

use incircle::tiles::{self, Border, Region, Step, Tile};
use incircle::Point;

use super::head::damaged;
use super::manifest::{local_path, manifest_path, Manifest};
use super::merge::{merge, Source, Take};
use super::opened::Owner;
use super::result::TileFile;
use super::runs::Runs;
use crate::failure::Failure;
use crate::path;
use crate::progress::CountMeter;

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
    /// The hull, in the form of [`incircle::Mesh::hull`].
    pub hull: Vec<u32>,
    /// The duplicates themselves, if they were asked for: pairs of a duplicate and the lowest index at the same place,
    /// sorted.
    pub pairs: Vec<[u32; 2]>,
    /// Triangles of the joins. The others are in the files of the tiles.
    runs: Runs,
}

/// Joins the tiles of a folder. `memory` is the number of bytes for the triangles of the joins; beside it, the memory
/// holds the border of up to 3 regions for each level of the tree, and the border of one tile.
///
/// # Errors
/// A tile has no file yet, or a file is damaged or of another run, or the disk is full.
pub fn join(folder: &Path, manifest: &Manifest, memory: u64, keep_pairs: bool, quiet: bool) -> Result<Joined, Failure> {
    check_there(folder, manifest)?;
    let points = manifest.points();
    let runs = Runs::new(folder, memory / 2);
    let joined = Joined { triangles: 0, duplicates: 0, hull: Vec::new(), pairs: Vec::new(), runs };
    let mut work = Work { folder, manifest, keep_pairs, joined, borders: Vec::new(), tile: 0 };
    let meter = CountMeter::new(manifest.steps.len() as u64, "joining", "regions", quiet);
    for step in &manifest.steps {
        match step {
            Step::Tile { region, .. } => work.tile(*region)?,
            Step::Join { region, children } => work.join(*region, *children)?,
        }
        meter.advance(1);
    }
    let mut joined = work.joined;
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
    Err(Failure::input(format!(
        "{} of the {count} tiles in {} are not triangulated yet: run 'incircle tile local {}/K' for K = {}",
        missing.len(),
        path::name(folder),
        path::name(folder),
        shown.join(", ")
    )))
}

struct Work<'a> {
    folder: &'a Path,
    manifest: &'a Manifest,
    keep_pairs: bool,
    joined: Joined,
    borders: Vec<Border<Point, u32>>,
    tile: u32,
}

impl Work<'_> {
    fn tile(&mut self, region: Region) -> Result<(), Failure> {
        let owner = Owner { run: self.manifest.run, tile: self.tile };
        let mut file = TileFile::open(self.folder, owner, self.manifest.points())?;
        let read = file.result(region, self.keep_pairs)?;
        let joined = &mut self.joined;
        joined.triangles += file.finals();
        joined.duplicates += file.duplicates();
        joined.pairs.extend(read.duplicates);
        joined.hull = read.hull;
        self.borders.push(read.border);
        self.tile += 1;
        Ok(())
    }

    /// Joins the last borders of the stack.
    fn join(&mut self, region: Region, children: usize) -> Result<(), Failure> {
        let first = self.borders.len().saturating_sub(children);
        let Tile { finals, border, hull, .. } =
            tiles::join(region, self.borders.split_off(first)).map_err(|error| {
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
        let (distinct, hull) = (points.saturating_sub(self.duplicates), self.hull.len() as u64);
        let expected = euler(distinct, hull, self.triangles > 0);
        if self.triangles == expected {
            return Ok(());
        }
        Err(Failure::input(format!(
            "the tiles of {} contradict each other: {} triangles of {distinct} distinct points with {hull} on the hull \
             should be {expected}; split the set again",
            path::name(folder),
            self.triangles
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
        // The triangles of the joins may have the other half.
        let memory = memory / 2;
        let mut sources = vec![Source::Memory(in_memory.into_iter())];
        sources.extend(runs.into_iter().map(Source::Run));
        let tiles = (0..manifest.tiles().count() as u32).map(|tile| -> Result<Source, Failure> {
            let owner = Owner { run: manifest.run, tile };
            Ok(Source::Tile(Box::new(TileFile::open(folder, owner, manifest.points())?.into_finals())))
        });
        match order {
            Order::Canonical => {
                for tile in tiles {
                    sources.push(tile?);
                }
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
