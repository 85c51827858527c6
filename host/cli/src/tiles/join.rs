//! The third verb: the borders of all tiles are joined up the tree, and the triangles are brought into order.

use std::path::Path;

use incircle::tiles::{self, Border, Region, Step, Tile};
use incircle::Point;

use super::head::damaged;
use super::manifest::{local_path, manifest_path, Manifest};
use super::opened::Owner;
use super::result::TileResult;
use super::sort::{Bucket, Sorter, Take};
use crate::failure::Failure;
use crate::path;
use crate::progress::CountMeter;

/// Triangles that are passed on together.
const SOME: usize = 1 << 12;

/// The order of the triangles of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The canonical order: sorted, which needs as much disk as the mesh.
    Canonical,
    /// Those of the joins first, then those of one tile after the other. Nothing is sorted.
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
    store: Store,
}

/// Where the triangles are.
enum Store {
    Sorted(Sorter),
    /// Those of the joins. The others are in the files of the tiles.
    Unordered(Bucket),
}

/// Joins the tiles of a folder. `memory` is the number of bytes for the sort of the triangles; beside it, the memory
/// holds the border of up to 3 regions for each level of the tree, and the border and duplicates of one tile.
///
/// # Errors
/// A tile has no file yet, or a file is damaged or of another run, or the disk is full.
pub fn join(
    folder: &Path,
    manifest: &Manifest,
    order: Order,
    memory: u64,
    keep_pairs: bool,
    quiet: bool,
) -> Result<Joined, Failure> {
    check_there(folder, manifest)?;
    let points = manifest.points();
    let store = match order {
        Order::Canonical => Store::Sorted(Sorter::new(folder, points, 2 * points, memory)),
        Order::Unordered => Store::Unordered(Bucket::new()),
    };
    let joined = Joined { triangles: 0, duplicates: 0, hull: Vec::new(), pairs: Vec::new(), store };
    let mut work = Work { folder, manifest, memory, keep_pairs, joined, borders: Vec::new(), tile: 0 };
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
    memory: u64,
    keep_pairs: bool,
    joined: Joined,
    borders: Vec<Border<Point, u32>>,
    tile: u32,
}

impl Work<'_> {
    fn tile(&mut self, region: Region) -> Result<(), Failure> {
        let owner = Owner { run: self.manifest.run, tile: self.tile };
        let (points, joined) = (self.manifest.points(), &mut self.joined);
        let name = local_path(self.folder, self.tile);
        let (store, triangles) = (&mut joined.store, &mut joined.triangles);
        let read = TileResult::read(self.folder, owner, region, &mut |triangle| {
            *triangles += 1;
            check_index(triangle.into_iter().max(), points).map_err(|failure| failure.in_file(path::name(&name)))?;
            match store {
                Store::Sorted(sorter) => sorter.add(&[triangle]),
                Store::Unordered(_) => Ok(()),
            }
        })?;
        let indices = read.border.ids.iter().chain(&read.hull).chain(read.duplicates.as_flattened());
        check_index(indices.copied().max(), points).map_err(|failure| failure.in_file(path::name(&name)))?;
        joined.duplicates += read.duplicates.len() as u64;
        if self.keep_pairs {
            joined.pairs.extend(read.duplicates);
        }
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
        match &mut self.joined.store {
            Store::Sorted(sorter) => sorter.add(&finals)?,
            Store::Unordered(bucket) => {
                let room = usize::try_from(self.memory).unwrap_or(usize::MAX);
                finals.iter().try_for_each(|&triangle| bucket.push(triangle, room, self.folder))?;
            }
        }
        self.joined.hull = hull;
        self.borders.push(border);
        Ok(())
    }
}

fn check_index(most: Option<u32>, points: u64) -> Result<(), Failure> {
    match most {
        Some(index) if u64::from(index) >= points => {
            Err(damaged(&format!("it names point {index} of a set of {points} points")))
        }
        _ => Ok(()),
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

    /// Calls `take` with all triangles, in the order that was asked for.
    pub fn each(self, folder: &Path, manifest: &Manifest, take: &mut Take<'_>) -> Result<(), Failure> {
        match self.store {
            Store::Sorted(sorter) => sorter.finish(take),
            Store::Unordered(bucket) => {
                bucket.each(take)?;
                for (tile, (region, _)) in (0..).zip(manifest.tiles()) {
                    let owner = Owner { run: manifest.run, tile };
                    let mut some = Vec::with_capacity(SOME);
                    TileResult::read(folder, owner, region, &mut |triangle| {
                        some.push(triangle);
                        if some.len() < SOME {
                            return Ok(());
                        }
                        let taken = take(&some);
                        some.clear();
                        taken
                    })?;
                    take(&some)?;
                }
                Ok(())
            }
        }
    }
}

/// All triangles as one list, which the memory must hold.
pub fn triangles_of(joined: Joined, folder: &Path, manifest: &Manifest) -> Result<Vec<[u32; 3]>, Failure> {
    let mut list = Vec::new();
    let count = usize::try_from(joined.triangles).unwrap_or(usize::MAX);
    list.try_reserve_exact(count).map_err(|_| Failure::input(format!("{count} triangles do not fit the memory")))?;
    joined.each(folder, manifest, &mut |triangles| {
        list.extend_from_slice(triangles);
        Ok(())
    })?;
    Ok(list)
}
