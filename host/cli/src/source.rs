//! Input files: which format they have, and what they hold.

use std::path::{Path, PathBuf};

use crate::arguments::ReadArguments;
use crate::failure::Failure;
use crate::formats::{MeshFormat, PointFormat, Selection};
use crate::input::Input;
use crate::path::{check_standard, extension, is_standard, name};
use crate::points::PointTable;
use crate::script::{self, Script};

/// Reads the points of a file or of standard input, those that the arguments select. The format is that of `--from`, or
/// else that of the extension. Without `--from`, standard input is CSV.
pub fn read_points(path: &Path, arguments: &ReadArguments, quiet: bool) -> Result<PointTable, Failure> {
    read_valued_points(path, arguments, None, quiet)
}

/// Reads points like [`read_points`], with the column `value` of a CSV file as their z.
pub fn read_valued_points(
    path: &Path,
    arguments: &ReadArguments,
    value: Option<&str>,
    quiet: bool,
) -> Result<PointTable, Failure> {
    let format = format_of_points(path, arguments)?;
    if value.is_some() && format != PointFormat::Csv {
        return Err(Failure::usage("--value names a column of CSV: leave it out for other formats, whose z is taken"));
    }
    let selection = Selection { value: value.map(str::to_owned), ..arguments.selection(format)? };
    let read = || format.read(Input::open(path, quiet)?, &selection);
    read().map_err(|failure| failure.in_file(name(path)))
}

/// The format of a file of points: that of `--from`, or else that of the extension. Standard input is CSV.
pub fn format_of_points(path: &Path, arguments: &ReadArguments) -> Result<PointFormat, Failure> {
    match arguments.from {
        Some(format) => Ok(format),
        None if is_standard(path) => Ok(PointFormat::Csv),
        None => PointFormat::of_extension(extension(path)).ok_or_else(|| {
            let (name, names) = (name(path), PointFormat::names());
            Failure::usage(format!("{name}: the extension names no format of points: add --from {names}"))
        }),
    }
}

/// Reads the points of several files as one set, numbered in the order of the files.
///
/// # Errors
/// A file cannot be read, or standard input is named twice.
pub fn read_set(paths: &[PathBuf], arguments: &ReadArguments, quiet: bool) -> Result<PointTable, Failure> {
    check_standard(paths)?;
    let mut tables = paths.iter().map(|path| read_points(path, arguments, quiet));
    let first = tables.next().unwrap_or_else(|| Ok(PointTable::of_items("point")))?;
    if paths.len() < 2 {
        return Ok(first);
    }
    tables.try_fold(first.into_items(), |set, table| set.append(table?))
}

/// The name of a set of files, for messages.
pub fn set_name(paths: &[PathBuf]) -> String {
    match paths {
        [path] => name(path),
        _ => format!("the set of {} files", paths.len()),
    }
}

/// Reads a script from a file or from standard input.
pub fn read_script(path: &Path, quiet: bool) -> Result<Script, Failure> {
    let read = || {
        let input = Input::open(path, quiet)?;
        let memory = input.memory();
        script::read(&input.into_bytes()?, memory)
    };
    read().map_err(|failure| failure.in_file(name(path)))
}

/// Reads the triangles of a mesh file. The format is `format`, or else the one of the extension.
pub fn read_mesh(path: &Path, format: Option<MeshFormat>, quiet: bool) -> Result<Vec<[u32; 3]>, Failure> {
    let format = format.or_else(|| MeshFormat::of_extension(extension(path)));
    let format = format.ok_or_else(|| {
        let (name, why, names) = (name(path), no_format(path), MeshFormat::names(MeshFormat::is_readable));
        Failure::usage(format!("{name}: {why}: add --format {names}"))
    })?;
    let read = || format.read(Input::open(path, quiet)?);
    read().map_err(|failure| failure.in_file(name(path)))
}

/// The format of a mesh that is written to this path: `format`, or else the one of the extension.
pub fn mesh_format(path: &Path, format: Option<MeshFormat>) -> Result<MeshFormat, Failure> {
    format.or_else(|| MeshFormat::of_extension(extension(path))).ok_or_else(|| {
        let name = if is_standard(path) { "standard output".to_owned() } else { name(path) };
        let (why, names) = (no_format(path), MeshFormat::names(|_| true));
        Failure::usage(format!("{name}: {why}: add --format {names}"))
    })
}

/// The reason why a mesh of this name needs `--format`, for a message.
fn no_format(path: &Path) -> &'static str {
    if is_standard(path) {
        "a mesh that has no file name needs a format"
    } else {
        "the extension names no format of meshes"
    }
}
