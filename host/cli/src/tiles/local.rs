//! The second verb: the points of one tile are triangulated.

use std::path::{Path, PathBuf};

use incircle::tiles;
use incircle::{Mesh, Point};

use super::canonical::sorted;
use super::deal::POINT_BYTES;
use super::head::Kind;
use super::manifest::{local_path, points_path, Manifest};
use super::opened::{Opened, Owner};
use super::result::{TileFile, TileResult};
use crate::failure::Failure;
use crate::output;
use crate::path;

/// A tile of a folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TileAt {
    /// The folder.
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

/// Gives the canonical mesh of points that need so many bits.
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
    let (ids, own) = read_points(folder, owner, points)?;
    let (finals, result) = solve(&ids, own, region, triangulate)?;
    let counts = [finals.len(), result.border.points.len(), result.border.open.len()].map(|count| count as u64);
    let written = result.write(&finals, folder, owner)?;
    output::keep([written], || last(&Outcome { points, counts, was_there: false }))
}

/// Reads the points of a tile, and their indices.
fn read_points(folder: &Path, owner: Owner, points: u64) -> Result<(Vec<u32>, Vec<Point>), Failure> {
    let path = points_path(folder, owner.tile);
    let bytes_of = |counts: &[u64; 5]| counts[0].checked_mul(POINT_BYTES as u64);
    let mut opened = Opened::open(&path, Kind::Points, Some(owner), Some(bytes_of))?;
    let found = opened.head.counts[0];
    if found != points {
        return Err(Failure::input(format!(
            "{}: the tile has {found} points, and the manifest says {points}: split the set again",
            path::name(&path)
        )));
    }
    let rows = opened.list::<3>(points)?;
    opened.finish()?;
    Ok((rows.iter().map(|row| row[0]).collect(), rows.iter().map(|row| Point::new(row[1], row[2])).collect()))
}

/// Triangulates the points of a region and finds out what is final. The final triangles are in canonical order.
fn solve(
    ids: &[u32],
    points: Vec<Point>,
    region: tiles::Region,
    triangulate: &mut Triangulate<'_>,
) -> Result<(Vec<[u32; 3]>, TileResult), Failure> {
    let low = points.iter().fold([u32::MAX; 2], |low, point| [low[0].min(point.x), low[1].min(point.y)]);
    let moved: Vec<Point> = points.iter().map(|point| Point::new(point.x - low[0], point.y - low[1])).collect();
    let all = moved.iter().fold(0, |all, point| all | point.x | point.y);
    let mesh = triangulate(&moved, u32::BITS - all.leading_zeros())?;
    drop(moved);
    // The canonical mesh does not depend on where the points are, so that of the moved points is that of the points.
    let mesh = Mesh::new(points, mesh.triangles, mesh.hull, mesh.duplicates);
    let tile = tiles::local(&mesh, ids, region)
        .map_err(|error| Failure::input(format!("the tile does not fit its manifest, as {error}")))?;
    let index = |place: u32| ids.get(place as usize).copied().unwrap_or_default();
    let duplicates = mesh.duplicates.iter().map(|duplicate| [duplicate.index, duplicate.of].map(index)).collect();
    Ok((sorted(&[&tile.finals]), TileResult { border: tile.border, hull: tile.hull, duplicates }))
}
