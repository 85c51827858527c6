//! The second verb: the points of one tile are triangulated.

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use incircle::tiles;
use incircle::{Mesh, Point};

use super::canonical::sorted;
use super::deal::POINT_BYTES;
use super::head::{damaged, Kind};
use super::manifest::{local_path, points_path, Manifest};
use super::opened::{Opened, Owner};
use super::result::{TileFile, TileResult};
use crate::failure::Failure;
use crate::output::{self, Written};
use crate::path;

/// A tile of a folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TileAt {
    /// The folder of the tiles.
    pub folder: PathBuf,
    /// The number of the tile.
    pub tile: u32,
}

impl TileAt {
    /// The tile that a path `DIR/K` names. `DIR/K.points` is taken, too.
    pub fn of_path(path: &Path) -> Result<Self, Failure> {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let number = name.strip_suffix(".points").unwrap_or(name);
        let is_number = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
        let Some(tile) = number.parse().ok().filter(|_| is_number) else {
            return Err(Failure::usage(format!(
                "{} names no tile: give the folder and the number of the tile, as in tiles/0",
                path::name(path)
            )));
        };
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        Ok(Self { folder: folder.unwrap_or(Path::new(".")).to_owned(), tile })
    }
}

/// The counts of a tile that is triangulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// The number of points of the tile.
    pub points: u64,
    /// The numbers of final triangles, and of points and open triangles of the border.
    pub counts: [u64; 3],
    /// Whether the file was there already.
    pub was_there: bool,
}

/// Gives the canonical mesh of points whose coordinates need the given number of bits.
pub type Triangulate<'a> = dyn FnMut(&[Point], u32) -> Result<Mesh, Failure> + 'a;

/// Triangulates the points of a tile and writes its file, unless that file is there and sound.
///
/// `triangulate` gets the points, moved so that the lowest x and y are 0, with the bits that they need, and must give
/// their canonical mesh. `last` is called when the file is in place; if it fails, the file is removed.
///
/// # Errors
/// A file is missing, damaged or of another run, or cannot be written, or `triangulate` fails.
pub fn local(
    at: &TileAt,
    triangulate: &mut Triangulate<'_>,
    last: impl FnOnce(&Outcome) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let TileAt { folder, tile } = at;
    let manifest = Manifest::read(folder)?;
    let count = manifest.tiles().count();
    let Some((region, points)) = manifest.tiles().nth(*tile as usize) else {
        return Err(Failure::input(format!(
            "{} has no tile {tile}: its tiles have the numbers 0 to {}",
            path::name(folder),
            count.saturating_sub(1)
        )));
    };
    let owner = Owner { run: manifest.run, tile: *tile };
    if local_path(folder, *tile).exists() {
        let mut file = TileFile::open(folder, owner, manifest.points())?;
        let result = file.result(region, false)?;
        let counts = [file.finals(), result.border.points.len() as u64, result.border.open.len() as u64];
        file.check_finals()?;
        return last(&Outcome { points, counts, was_there: true });
    }
    if points > manifest.most {
        let written = write_one_place(folder, owner, points, region)?;
        return output::keep([written], || last(&Outcome { points, counts: [0, 1, 0], was_there: false }));
    }
    let (ids, own) = read_points(folder, owner, points)?;
    let (finals, result) = solve(&ids, own, (region, &manifest.occupancy), triangulate)?;
    let counts = [finals.len(), result.border.points.len(), result.border.open.len()].map(|count| count as u64);
    let written = result.write(&finals, folder, owner)?;
    output::keep([written], || last(&Outcome { points, counts, was_there: false }))
}

/// Reads the points of a tile, and their indices.
fn read_points(folder: &Path, owner: Owner, points: u64) -> Result<(Vec<u32>, Vec<Point>), Failure> {
    let mut opened = open_points(folder, owner, points)?;
    let rows = opened.list::<3>(points)?;
    opened.finish()?;
    Ok((rows.iter().map(|row| row[0]).collect(), rows.iter().map(|row| Point::new(row[1], row[2])).collect()))
}

/// Opens the file of the points of a tile.
fn open_points(folder: &Path, owner: Owner, points: u64) -> Result<Opened, Failure> {
    let path = points_path(folder, owner.tile);
    let bytes_of = |counts: &[u64; 5]| counts[0].checked_mul(POINT_BYTES as u64);
    let opened = Opened::open(&path, Kind::Points, Some(owner), Some(bytes_of))?;
    match opened.head.counts[0] {
        found if found == points => Ok(opened),
        found => Err(Failure::input(format!(
            "{}: the tile has {found} points, and the manifest says {points}: split the set again",
            path::name(&path)
        ))),
    }
}

/// Writes the file of a tile with more points than a tile may have: all are at one place. They are read again for each
/// pass over the duplicates, because there may be more than the memory holds.
fn write_one_place(folder: &Path, owner: Owner, points: u64, region: tiles::Region) -> Result<Written, Failure> {
    let mut first = None;
    each_at_one_place(folder, owner, points, &mut |row| {
        first.get_or_insert(row);
        Ok(())
    })?;
    let [lowest, x, y] = first.unwrap_or_default();
    let border = tiles::Border { region, points: vec![Point::new(x, y)], ids: vec![lowest], open: Vec::new() };
    let result = TileResult { border, hull: vec![lowest], duplicates: Vec::new() };
    let mut duplicates = |out: &mut dyn Write| {
        let mut out = BufWriter::new(out);
        let read = each_at_one_place(folder, owner, points, &mut |[id, _, _]| {
            if id == lowest {
                return Ok(());
            }
            let written = out.write_all([id, lowest].map(u32::to_le_bytes).as_flattened());
            written.map_err(|error| Failure::input(error.to_string()))
        });
        read.map_err(|failure| io::Error::other(failure.message))?;
        out.flush()
    };
    result.write_with((points - 1, &mut duplicates), &[], folder, owner)
}

/// Calls `take` with each point of a tile, and refuses points at two places.
fn each_at_one_place(
    folder: &Path,
    owner: Owner,
    points: u64,
    take: &mut dyn FnMut([u32; 3]) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut opened = open_points(folder, owner, points)?;
    let mut place = None;
    opened.rows(points, |row: [u32; 3]| {
        let [_, x, y] = row;
        if *place.get_or_insert([x, y]) != [x, y] {
            let name = path::name(&points_path(folder, owner.tile));
            return Err(damaged(&format!("its {points} points should be at one place")).in_file(name));
        }
        take(row)
    })?;
    opened.finish()
}

/// Triangulates the points of a region and finds out what is final. The final triangles are in canonical order.
fn solve(
    ids: &[u32],
    points: Vec<Point>,
    (region, occupancy): (tiles::Region, &tiles::Occupancy),
    triangulate: &mut Triangulate<'_>,
) -> Result<(Vec<[u32; 3]>, TileResult), Failure> {
    let low = points.iter().fold([u32::MAX; 2], |low, point| [low[0].min(point.x), low[1].min(point.y)]);
    let moved: Vec<Point> = points.iter().map(|point| Point::new(point.x - low[0], point.y - low[1])).collect();
    let all = moved.iter().fold(0, |all, point| all | point.x | point.y);
    let mesh = triangulate(&moved, u32::BITS - all.leading_zeros())?;
    drop(moved);
    // The canonical mesh does not depend on where the points are, so that of the moved points is that of the points.
    let mesh = Mesh::new(points, mesh.triangles, mesh.hull, mesh.duplicates);
    let tile = tiles::local_among(&mesh, ids, region, occupancy)
        .map_err(|error| Failure::input(format!("the tile does not fit its manifest, as {error}")))?;
    let index = |place: u32| ids.get(place as usize).copied().unwrap_or_default();
    let duplicates = mesh.duplicates.iter().map(|duplicate| [duplicate.index, duplicate.of].map(index)).collect();
    Ok((sorted(&[&tile.finals]), TileResult { border: tile.border, hull: tile.hull, duplicates }))
}
