//! The first pass over the points of a proof, which finds their lattice, and all later passes over them.

use std::path::{Path, PathBuf};

use incircle::Point;

use crate::arguments::ReadArguments;
use crate::failure::Failure;
use crate::path;
use crate::tiles::{each_piece, Digest, Extent, Ground};

/// The most points of a set: each index fits 32 bits, and two values stay free.
const MOST_POINTS: u64 = u32::MAX as u64 - 1;

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
    ///
    /// # Errors
    /// An input cannot be read or has changed, or `take` fails.
    pub fn each(
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

/// The failure of an input that is not the same as at first.
fn changed(path: &Path) -> Failure {
    Failure::input(format!(
        "{} has changed while it was read: verify the mesh again, and leave the file alone meanwhile",
        path::name(path)
    ))
}
