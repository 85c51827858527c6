//! The manifest of a run: the inputs, the lattice, and the steps from tiles to the mesh.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use incircle::tiles::{Occupancy, Region, Step};

use super::ground::{Ground, Length};
use super::head::{damaged, Head, Kind};
use super::opened::Opened;
use super::written::{write_checked, write_rows};
use crate::failure::Failure;
use crate::output::Written;
use crate::path;

/// The most bytes of a manifest that are read: those of 16 million tiles.
const MOST_BYTES: u64 = 1 << 30;
/// Stands for a side of a region that is infinitely far away.
const FAR: i64 = i64::MIN;

/// An input as the first pass found it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputFile {
    /// The path, as it was given.
    pub path: PathBuf,
    /// The number of points.
    pub points: u64,
    /// A number made of all points.
    pub digest: u64,
}

/// A manifest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Manifest {
    /// The run.
    pub run: u64,
    /// The most points of a tile that was asked for.
    pub most: u64,
    /// The inputs, in the order in which their points are numbered.
    pub inputs: Vec<InputFile>,
    /// The lattice of the points.
    pub ground: Ground,
    /// Tiles and joins. The ranges of the tiles count the points of one tile after the other.
    pub steps: Vec<Step>,
    /// The places where points are, in steps of the lattice.
    pub occupancy: Occupancy,
}

impl Manifest {
    /// The number of all points.
    pub fn points(&self) -> u64 {
        self.inputs.iter().map(|input| input.points).sum()
    }

    /// The tiles, each with its region and its number of points.
    pub fn tiles(&self) -> impl Iterator<Item = (Region, u64)> + '_ {
        self.steps.iter().filter_map(|step| match step {
            Step::Tile { region, points } => Some((*region, points.len() as u64)),
            Step::Join { .. } => None,
        })
    }

    /// Reads the manifest of a folder.
    pub fn read(folder: &Path) -> Result<Self, Failure> {
        let path = manifest_path(folder);
        // A folder that may not be read says so itself.
        if path.try_exists().is_ok_and(|is_there| !is_there) {
            return Err(Failure::input(format!(
                "{} has no manifest, so it is no folder of tiles or 'tile split' has not ended: run 'incircle tile \
                 split' first",
                path::name(folder)
            )));
        }
        let mut opened = Opened::open(&path, Kind::Manifest, None, None)?;
        let head = opened.head;
        let in_file = |failure: Failure| failure.in_file(path::name(&path));
        if opened.left() > MOST_BYTES {
            return Err(in_file(damaged(&format!("it has {} bytes", opened.left()))));
        }
        let mut bytes = vec![0; opened.left() as usize];
        opened.fill(&mut bytes)?;
        opened.finish()?;
        let mut cursor = Cursor { bytes: &bytes };
        let manifest = Self::decode(&head, &mut cursor).filter(|_| cursor.bytes.is_empty());
        let manifest = manifest.ok_or_else(|| in_file(damaged("its lists do not fit together")))?;
        Ok(manifest)
    }

    /// Writes the manifest under a working name.
    pub fn write(&self, folder: &Path) -> Result<Written, Failure> {
        let counts = [self.points(), self.tiles().count() as u64, self.inputs.len() as u64, self.steps.len() as u64];
        let [points, tiles, inputs, steps] = counts;
        let head = Head {
            kind: Kind::Manifest,
            run: self.run,
            tile: 0,
            counts: [points, tiles, inputs, steps, self.most],
            check: 0,
        };
        write_checked(&manifest_path(folder), head, &mut |out| self.encode(out), None)
    }

    fn encode(&self, out: &mut dyn Write) -> io::Result<()> {
        let (kind, length) = match self.ground.length {
            Length::Decimal(digits) => (0u32, digits),
            Length::Binary(exponent) => (1, exponent.cast_unsigned()),
        };
        out.write_all([kind, length, self.ground.bits].map(u32::to_le_bytes).as_flattened())?;
        out.write_all(self.ground.offset.map(i128::to_le_bytes).as_flattened())?;
        for input in &self.inputs {
            let path = input.path.as_os_str().as_encoded_bytes();
            let numbers = [input.points, input.digest, path.len() as u64];
            out.write_all(numbers.map(u64::to_le_bytes).as_flattened())?;
            out.write_all(path)?;
        }
        for step in &self.steps {
            out.write_all(step_words(step).map(u64::to_le_bytes).as_flattened())?;
        }
        let stretches = self.occupancy.stretches();
        out.write_all([self.occupancy.shift(), stretches.len() as u32].map(u32::to_le_bytes).as_flattened())?;
        write_rows(stretches, out)
    }

    fn decode(head: &Head, cursor: &mut Cursor<'_>) -> Option<Self> {
        let [points, tiles, inputs, steps, most] = head.counts;
        let [kind, length, bits] = [cursor.u32()?, cursor.u32()?, cursor.u32()?];
        let length = match kind {
            0 => Length::Decimal(length),
            1 => Length::Binary(length.cast_signed()),
            _ => return None,
        };
        let offset = [cursor.i128()?, cursor.i128()?];
        let (mut files, mut list, mut done) = (Vec::new(), Vec::new(), 0);
        for _ in 0..inputs {
            files.push(cursor.input()?);
        }
        for _ in 0..steps {
            let step = cursor.step(done)?;
            if let Step::Tile { points, .. } = &step {
                done = points.end;
            }
            list.push(step);
        }
        let read = Self {
            run: head.run,
            most,
            inputs: files,
            ground: Ground { length, offset, bits },
            steps: list,
            occupancy: cursor.occupancy()?,
        };
        let sum = read.inputs.iter().try_fold(0u64, |sum, input| sum.checked_add(input.points))?;
        let fits = sum == points && points < u64::from(u32::MAX) && done as u64 == points;
        (fits && read.tiles().count() as u64 == tiles && read.leaves_one_border()).then_some(read)
    }

    /// Whether every join finds its children, and one border is left at the end.
    fn leaves_one_border(&self) -> bool {
        let left = self.steps.iter().try_fold(0usize, |stack, step| match step {
            Step::Tile { .. } => Some(stack + 1),
            Step::Join { children, .. } => stack.checked_sub(*children).map(|rest| rest + 1),
        });
        left == Some(1)
    }
}

/// A step as six numbers: 0 for a tile or 1 for a join, the points of the tile or the children of the join, and the
/// sides of the region.
pub fn step_words(step: &Step) -> [u64; 6] {
    let (kind, region, count) = match step {
        Step::Tile { region, points } => (0, region, points.len()),
        Step::Join { region, children } => (1, region, *children),
    };
    let [west, east, south, north] =
        [region.west, region.east, region.south, region.north].map(|side| side.unwrap_or(FAR).cast_unsigned());
    [kind, count as u64, west, east, south, north]
}

/// The file of the manifest.
pub fn manifest_path(folder: &Path) -> PathBuf {
    folder.join("manifest")
}

/// The file of the points of a tile.
pub fn points_path(folder: &Path, tile: u32) -> PathBuf {
    folder.join(format!("{tile}.points"))
}

/// The file of the triangulation of a tile.
pub fn local_path(folder: &Path, tile: u32) -> PathBuf {
    folder.join(format!("{tile}.local"))
}

/// Bytes that are read from their beginning.
struct Cursor<'a> {
    bytes: &'a [u8],
}

impl Cursor<'_> {
    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (array, rest) = self.bytes.split_first_chunk()?;
        self.bytes = rest;
        Some(*array)
    }

    fn u32(&mut self) -> Option<u32> {
        self.array().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Option<u64> {
        self.array().map(u64::from_le_bytes)
    }

    fn i128(&mut self) -> Option<i128> {
        self.array().map(i128::from_le_bytes)
    }

    fn input(&mut self) -> Option<InputFile> {
        let (points, digest, length) = (self.u64()?, self.u64()?, self.u64()?);
        let (path, rest) = self.bytes.split_at_checked(usize::try_from(length).ok()?)?;
        self.bytes = rest;
        Some(InputFile { path: path_of(path), points, digest })
    }

    /// Reads a step. The points of a tile are counted on from `done`.
    fn step(&mut self, done: usize) -> Option<Step> {
        let (kind, count) = (self.u64()?, usize::try_from(self.u64()?).ok()?);
        let mut side = || self.u64().map(|side| Some(side.cast_signed()).filter(|&side| side != FAR));
        let [west, east, south, north] = [side()?, side()?, side()?, side()?];
        let region = Region { west, east, south, north };
        match kind {
            0 => Some(Step::Tile { region, points: done..done.checked_add(count)? }),
            1 => Some(Step::Join { region, children: count }),
            _ => None,
        }
    }

    fn occupancy(&mut self) -> Option<Occupancy> {
        let (shift, count) = (self.u32()?, self.u32()?);
        let mut stretches = Vec::new();
        for _ in 0..count {
            stretches.push([self.u32()?, self.u32()?]);
        }
        Occupancy::of_stretches(shift, stretches)
    }
}

#[cfg(unix)]
fn path_of(bytes: &[u8]) -> PathBuf {
    use std::os::unix::ffi::OsStrExt;
    PathBuf::from(std::ffi::OsStr::from_bytes(bytes))
}

#[cfg(not(unix))]
fn path_of(bytes: &[u8]) -> PathBuf {
    PathBuf::from(String::from_utf8_lossy(bytes).into_owned())
}
