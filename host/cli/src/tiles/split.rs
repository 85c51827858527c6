//! The first verb: the inputs become one file of points for each tile, and a manifest.

use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use incircle::order::z_curve::position;
use incircle::tiles::{OccupiedCells, Region, Step, Tree};
use incircle::Point;

use super::deal::{remove_stale, room_for, Placed, PointFile, POINT_BYTES, WORKING};
use super::digest::Digest;
use super::ground::{Ground, Length};
use super::head::{Head, Kind, HEAD_BYTES, VERSION};
use super::inputs::{changed, each_piece};
use super::manifest::{local_path, manifest_path, points_path, step_words, Manifest};
use super::survey::{survey, Survey};
use crate::arguments::ReadArguments;
use crate::failure::Failure;
use crate::output::{self, Written};
use crate::path;

/// The inputs, the folder and the limits of a split.
#[derive(Clone, Copy)]
pub struct Plan<'a> {
    /// The inputs, whose points are numbered in this order.
    pub inputs: &'a [PathBuf],
    /// The options for reading the inputs.
    pub read: &'a ReadArguments,
    /// The most points of a tile. Only points at one place may be more.
    pub most: NonZeroUsize,
    /// The folder for the files. It is made if it does not exist.
    pub folder: &'a Path,
    /// The most points of the sample from which the cuts are made.
    pub sample: usize,
    /// The bytes that all buffers together take, unless there are very many tiles.
    pub buffers: usize,
    /// Called with the number of points before the first file is written, or when the files of an earlier split are
    /// taken. An error ends the split.
    pub check: &'a dyn Fn(u64) -> Result<(), Failure>,
    /// Whether no progress is shown.
    pub quiet: bool,
}

/// The result of a split.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Summary {
    /// The manifest of the run.
    pub manifest: Manifest,
    /// The number of bytes of all files of points.
    pub bytes: u64,
    /// Whether the folder had the tiles already.
    pub was_there: bool,
}

/// Splits a set. The memory holds a sample and buffers, and then one tile at a time.
///
/// If the folder has the manifest of the same points and cuts, nothing is done. `last` is called when all files are in
/// place; if it fails, none of them is left.
///
/// # Errors
/// An input cannot be read, has no lattice of at most 32 bits in common with the others, or changes between the two
/// passes. The folder cannot be written, or has tiles of another run. Nothing is left behind.
pub fn split(plan: &Plan<'_>, last: impl FnOnce(&Summary) -> Result<(), Failure>) -> Result<(), Failure> {
    let survey = survey(plan.inputs, plan.read, plan.sample, plan.quiet)?;
    if manifest_path(plan.folder).exists() {
        return last(&known(plan, &survey)?);
    }
    (plan.check)(survey.points)?;
    let is_new = !plan.folder.exists();
    fs::create_dir_all(plan.folder)
        .map_err(|error| Failure::input(format!("{} cannot be made: {error}", path::name(plan.folder))))?;
    let done = split_into(plan, survey, last);
    if done.is_err() && is_new {
        // A folder with anything in it stays.
        let _ = fs::remove_dir(plan.folder);
    }
    done
}

/// Splits a set that was read once into the files of a folder.
fn split_into(
    plan: &Plan<'_>,
    survey: Survey,
    last: impl FnOnce(&Summary) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let tree = Tree::of_positions(&positions(&survey.sample), most_of_sample(&survey, plan.most));
    let mut occupied = OccupiedCells::new(survey.ground.bits);
    let cells = deal(plan, &survey, &tree, &mut occupied)?;
    let occupancy = occupied.finish();
    drop(occupied);
    let mut tiles = Tiles { steps: Vec::new(), files: Vec::new(), created: cells.len(), done: 0 };
    let mut cells = cells.into_iter();
    for step in tree.steps() {
        match step {
            Step::Join { .. } => tiles.steps.push(step.clone()),
            Step::Tile { region, .. } => tiles.add(plan, *region, cells.next())?,
        }
    }
    let run = run_of(&survey, plan.most, &tiles.steps);
    let Survey { ground, inputs, points, .. } = survey;
    let manifest = Manifest { run, most: plan.most.get() as u64, inputs, ground, steps: tiles.steps, occupancy };
    let bytes = points * POINT_BYTES as u64 + (tiles.files.len() * HEAD_BYTES) as u64;
    let (placed, written) = place(plan.folder, &manifest, tiles.files)?;
    output::keep([written], || {
        placed.into_iter().for_each(Placed::keep);
        remove_stale(plan.folder, WORKING);
        last(&Summary { manifest, bytes, was_there: false })
    })
}

/// A number for the run, made of all that decides what is in the files.
fn run_of(survey: &Survey, most: NonZeroUsize, steps: &[Step]) -> u64 {
    let mut digest = Digest::default();
    let mut add = |word: u64| digest.mix(word);
    add(u64::from(VERSION));
    add(most.get() as u64);
    let Ground { length, offset, bits } = survey.ground;
    match length {
        Length::Decimal(digits) => add(u64::from(digits)),
        Length::Binary(exponent) => add(1 << 32 | u64::from(exponent.cast_unsigned())),
    }
    // An offset fits 64 bits (`Extent` refuses more), so its lower half has all of it.
    offset.iter().for_each(|&steps| add(steps.cast_unsigned() as u64));
    add(u64::from(bits));
    for input in &survey.inputs {
        add(input.points);
        add(input.digest);
    }
    steps.iter().flat_map(step_words).for_each(add);
    digest.value()
}

/// The result of an earlier split in the folder. Tiles of another run are refused.
fn known(plan: &Plan<'_>, survey: &Survey) -> Result<Summary, Failure> {
    let manifest = Manifest::read(plan.folder)?;
    // The cuts may come from a sample of another size.
    let run = run_of(survey, plan.most, &manifest.steps);
    if manifest.run != run {
        return Err(Failure::input(format!(
            "{} has the tiles of another run ({:016x}, not {run:016x}): choose another folder, or remove this one",
            path::name(plan.folder),
            manifest.run
        )));
    }
    for (tile, _) in (0..).zip(manifest.tiles()) {
        let file = points_path(plan.folder, tile);
        // A tile that is triangulated needs no file of points any more.
        if !file.exists() && !local_path(plan.folder, tile).exists() {
            return Err(Failure::input(format!(
                "{} is missing, which the manifest lists: remove the folder, and split again",
                path::name(&file)
            )));
        }
    }
    (plan.check)(survey.points)?;
    let bytes = manifest.points() * POINT_BYTES as u64 + (manifest.tiles().count() * HEAD_BYTES) as u64;
    Ok(Summary { manifest, bytes, was_there: true })
}

fn positions(points: &[Point]) -> Vec<u64> {
    let mut positions: Vec<u64> = points.iter().map(|point| position(point.x, point.y)).collect();
    positions.sort_unstable();
    positions
}

/// The positions along the Z-curve of the points of a file, sorted. Of the points at the most frequent place, at most
/// one more than `most` count, because only these may be so many that the memory does not hold the list.
fn positions_of(file: &mut PointFile, most: NonZeroUsize) -> Result<Vec<u64>, Failure> {
    // A place that has more than half of the points outlasts all others (Boyer and Moore, 1981).
    let (mut frequent, mut lead) = (Point::default(), 0u64);
    file.each(&mut |_, point| {
        match lead {
            _ if point == frequent => lead += 1,
            0 => (frequent, lead) = (point, 1),
            _ => lead -= 1,
        }
        Ok(())
    })?;
    let (mut positions, mut there) = (Vec::new(), 0);
    file.each(&mut |_, point| {
        there += usize::from(point == frequent);
        if point != frequent || there <= most.get().saturating_add(1) {
            positions.push(position(point.x, point.y));
        }
        Ok(())
    })?;
    positions.sort_unstable();
    Ok(positions)
}

/// The most points of the sample in a tile. A tenth is left free, because a sample is uneven; cells with too many
/// points all the same are cut once more.
fn most_of_sample(survey: &Survey, most: NonZeroUsize) -> NonZeroUsize {
    let sample = survey.sample.len() as u64;
    if sample == survey.points {
        return most;
    }
    let share = u128::from(sample) * most.get() as u128 * 9 / 10 / u128::from(survey.points.max(1));
    usize::try_from(share).ok().and_then(NonZeroUsize::new).unwrap_or(NonZeroUsize::MIN)
}

/// Reads the inputs again, and deals their points to the cells of the tree. Notes where points are.
fn deal(
    plan: &Plan<'_>,
    survey: &Survey,
    tree: &Tree,
    occupied: &mut OccupiedCells,
) -> Result<Vec<PointFile>, Failure> {
    let count = tree.tiles().count();
    let mut cells: Vec<PointFile> =
        (0..count).map(|number| PointFile::create(plan.folder, number)).collect::<Result<_, _>>()?;
    let (room, mut index, mut grid) = (room_for(plan.buffers, count), 0u32, Vec::new());
    for (path, input) in plan.inputs.iter().zip(&survey.inputs) {
        let mut digest = Digest::default();
        each_piece(path, plan.read, plan.quiet, &mut |piece| {
            digest.add(piece);
            grid.clear();
            if digest.points() > input.points || survey.ground.lay(piece, &mut grid).is_none() {
                return Err(changed(path));
            }
            for &point in &grid {
                if let Some(cell) = cells.get_mut(tree.tile_of(point)) {
                    cell.push(index, point, room)?;
                }
                occupied.add(point);
                index += 1;
            }
            Ok(())
        })?;
        if (digest.points(), digest.value()) != (input.points, input.digest) {
            return Err(changed(path));
        }
    }
    cells.iter_mut().try_for_each(PointFile::flush)?;
    Ok(cells)
}

/// The steps of the run, and the files of its tiles.
struct Tiles {
    steps: Vec<Step>,
    files: Vec<PointFile>,
    /// The number of files that were made.
    created: usize,
    /// The number of points in all tiles so far.
    done: usize,
}

impl Tiles {
    /// Adds the tile of a cell, or several if the cell has too many points.
    fn add(&mut self, plan: &Plan<'_>, region: Region, file: Option<PointFile>) -> Result<(), Failure> {
        let Some(mut file) = file else { return Ok(()) };
        if file.points <= plan.most.get() as u64 {
            self.push(region, file);
            return Ok(());
        }
        let tree = Tree::of_positions(&positions_of(&mut file, plan.most)?, plan.most);
        let count = tree.tiles().count();
        if count == 1 {
            self.push(region, file);
            return Ok(());
        }
        let numbers = self.created..self.created + count;
        self.created = numbers.end;
        let mut parts: Vec<PointFile> =
            numbers.map(|number| PointFile::create(plan.folder, number)).collect::<Result<_, _>>()?;
        let room = room_for(plan.buffers, count);
        file.each(&mut |index, point| match parts.get_mut(tree.tile_of(point)) {
            Some(part) => part.push(index, point, room),
            None => Ok(()),
        })?;
        drop(file);
        let mut parts = parts.into_iter();
        for step in tree.steps() {
            match step {
                Step::Tile { region: own, .. } => {
                    let Some(mut part) = parts.next() else { continue };
                    part.flush()?;
                    self.push(common(&region, own), part);
                }
                Step::Join { region: joined, children } => {
                    self.steps.push(Step::Join { region: common(&region, joined), children: *children });
                }
            }
        }
        Ok(())
    }

    fn push(&mut self, region: Region, file: PointFile) {
        let count = file.points as usize;
        self.steps.push(Step::Tile { region, points: self.done..self.done + count });
        self.done += count;
        self.files.push(file);
    }
}

/// The rectangle that two regions have in common.
fn common(one: &Region, other: &Region) -> Region {
    let further = |one: Option<i64>, other: Option<i64>| one.max(other);
    let nearer = |one: Option<i64>, other: Option<i64>| match (one, other) {
        (Some(one), Some(other)) => Some(one.min(other)),
        _ => one.or(other),
    };
    Region {
        west: further(one.west, other.west),
        east: nearer(one.east, other.east),
        south: further(one.south, other.south),
        north: nearer(one.north, other.north),
    }
}

/// Gives all files of points their names, and writes the manifest under a working name.
fn place(folder: &Path, manifest: &Manifest, files: Vec<PointFile>) -> Result<(Vec<Placed>, Written), Failure> {
    let mut placed = Vec::with_capacity(files.len());
    for (tile, file) in (0..).zip(files) {
        let head = Head { kind: Kind::Points, run: manifest.run, tile, counts: [0; 5], check: 0 };
        placed.push(file.place(head, &points_path(folder, tile))?);
    }
    Ok((placed, manifest.write(folder)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_cuts_of_one_set_are_another_run() {
        let ground = Ground { length: Length::Decimal(0), offset: [0; 2], bits: 4 };
        let survey = Survey { points: 2, inputs: Vec::new(), sample: Vec::new(), ground };
        let run = |west| {
            let steps = [Step::Tile { region: Region { west, ..Region::WHOLE }, points: 0..2 }];
            run_of(&survey, NonZeroUsize::MIN, &steps)
        };
        assert_eq!(run(Some(1)), run(Some(1)));
        assert!(run(Some(1)) != run(Some(2)) && run(Some(1)) != run(None));
    }
}
