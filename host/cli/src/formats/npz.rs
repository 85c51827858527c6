//! `.npz`, the archives of arrays of NumPy: a ZIP file with a `.npy` file for each array, stored or deflated.

use zip::result::ZipError;
use zip::ZipArchive;

use crate::failure::{one_line, quoted, Failure};
use crate::formats::array::Source;
use crate::formats::npy;
use crate::input::Input;
use crate::points::PointTable;

/// The ending of the names of arrays in the archive.
const ENDING: &str = ".npy";
/// The most names that a message lists.
const MOST_NAMES: usize = 8;

/// Reads the points of the array of this name, or else of the only array.
pub fn read_points(input: Input, array: Option<&str>) -> Result<PointTable, Failure> {
    let memory = input.memory();
    let mut archive = ZipArchive::new(input.into_seekable()?).map_err(|error| refuse(&error))?;
    let names: Vec<String> = archive.file_names().filter_map(|name| array_name(&name.ok()?)).collect();
    let name = choose(&names, array)?;
    let mut entry = archive.by_name(&format!("{name}{ENDING}")).map_err(|error| refuse(&error))?;
    let table = npy::read_points(Source::of_entry(&mut entry, memory));
    table.map_err(|failure| failure.in_file(format_args!("array {}", quoted(name.as_bytes()))))
}

fn array_name(file_name: &str) -> Option<String> {
    file_name.strip_suffix(ENDING).map(str::to_owned)
}

/// The name of the array to read: `wanted`, or else that of the only array.
fn choose<'a>(names: &'a [String], wanted: Option<&str>) -> Result<&'a str, Failure> {
    let found = match (names, wanted) {
        ([], _) => return Err(Failure::input("the archive holds no array")),
        (_, Some(wanted)) => names.iter().find(|name| *name == wanted),
        ([one], None) => Some(one),
        (_, None) => None,
    };
    found.map(String::as_str).ok_or_else(|| match wanted {
        Some(wanted) => {
            let wanted = quoted(wanted.as_bytes());
            Failure::input(format!("the archive has no array {wanted}: it has {}", list(names)))
        }
        None => Failure::input(format!("the archive has several arrays, {}: choose one with --array", list(names))),
    })
}

/// The names of arrays, for a message.
fn list(names: &[String]) -> String {
    let mut shown: Vec<_> = names.iter().take(MOST_NAMES).map(|name| quoted(name.as_bytes())).collect();
    if names.len() > MOST_NAMES {
        shown.push(format!("and {} more", names.len() - MOST_NAMES));
    }
    one_line(&shown.join(", "))
}

fn refuse(error: &ZipError) -> Failure {
    Failure::input(format!(
        "not an archive of arrays, or cut off ({}): save it again with numpy.savez",
        one_line(&error.to_string())
    ))
}
