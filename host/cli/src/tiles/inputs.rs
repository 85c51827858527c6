//! The points of an input, piece by piece.

use std::path::Path;

use super::digest::Digest;
use super::manifest::Manifest;
use crate::arguments::ReadArguments;
use crate::failure::Failure;
use crate::formats::Take;
use crate::input::Input;
use crate::path;
use crate::points::{Coordinates, PointTable};
use crate::source;

/// Calls `take` with the coordinates of all points of a file, in pieces as
/// [`PointFormat::read_pieces`](crate::formats::PointFormat::read_pieces) makes them. Failures of reading name the
/// file; those of `take` are passed on.
pub fn each_piece(path: &Path, read: &ReadArguments, quiet: bool, take: Take<'_>) -> Result<(), Failure> {
    if path::is_standard(path) {
        return Err(Failure::usage("the points are read twice, and standard input can be read only once: give a file"));
    }
    let format = source::format_of_points(path, read)?;
    let selection = read.selection(format)?;
    // A failure of `take` is not one of the file.
    let mut failed = None;
    let done = Input::open(path, quiet).and_then(|input| {
        let take = &mut |piece: &Coordinates| take(piece).inspect_err(|failure| failed = Some(failure.clone()));
        format.read_pieces(input, &selection, take)
    });
    failed.map_or_else(|| done.map_err(|failure| failure.in_file(path::name(path))), Err)
}

/// Reads the points of a run again, for a mesh that has them. The memory must hold them.
///
/// # Errors
/// The run has no input or several, or the points are no longer those that were split.
pub fn points_again(manifest: &Manifest, read: &ReadArguments, quiet: bool) -> Result<PointTable, Failure> {
    let [input] = &manifest.inputs[..] else {
        return Err(Failure::usage(format!(
            "the set has {} inputs, and a format that has the points in the mesh takes one: choose npy, csv or ele",
            manifest.inputs.len()
        )));
    };
    let table = source::read_points(&input.path, read, quiet)?;
    // The digest does not depend on how the points come in pieces.
    let mut digest = Digest::default();
    digest.add(table.coordinates());
    if (digest.points(), digest.value()) != (input.points, input.digest) {
        return Err(changed(&input.path));
    }
    Ok(table)
}

/// The failure of an input that is not the same as in an earlier pass.
pub fn changed(path: &Path) -> Failure {
    Failure::input(format!(
        "{} has changed since it was first read: split the inputs again, and leave them alone until the tiles are \
         joined",
        path::name(path)
    ))
}
