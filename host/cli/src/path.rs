//! The names of files: what they are called in messages, and which format and packing their extensions name.

use std::path::{Path, PathBuf};

use crate::failure::{printable, Failure};

/// The packing of the bytes of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compression {
    /// The bytes stand in the file as they are.
    None,
    /// Gzip, by the extension `.gz`.
    Gzip,
    /// Zstandard, by the extension `.zst`.
    Zstd,
}

impl Compression {
    /// The packing that the last extension of a path names.
    pub fn of(path: &Path) -> Self {
        match last_extension(path).to_ascii_lowercase().as_str() {
            "gz" => Self::Gzip,
            "zst" => Self::Zstd,
            _ => Self::None,
        }
    }
}

/// The extension that names the format of a file, without that of its packing: `csv` for `points.csv.gz`. The text is
/// empty if there is none.
pub fn extension(path: &Path) -> &str {
    match Compression::of(path) {
        Compression::None => last_extension(path),
        Compression::Gzip | Compression::Zstd => path.file_stem().map_or("", |stem| last_extension(Path::new(stem))),
    }
}

/// The name of a file without the extension of its packing: `m.ele` for `m.ele.gz`.
pub fn unpacked(path: &Path) -> PathBuf {
    match Compression::of(path) {
        Compression::None => path.to_owned(),
        Compression::Gzip | Compression::Zstd => path.with_extension(""),
    }
}

/// The file beside one, with another extension for its format and the same for its packing: `m.node.gz` beside
/// `m.ele.gz`.
pub fn beside(path: &Path, extension: &str) -> PathBuf {
    match Compression::of(path) {
        Compression::None => path.with_extension(extension),
        Compression::Gzip | Compression::Zstd => {
            let packing = last_extension(path).to_owned();
            unpacked(path).with_extension(format!("{extension}.{packing}"))
        }
    }
}

fn last_extension(path: &Path) -> &str {
    path.extension().and_then(|extension| extension.to_str()).unwrap_or_default()
}

/// Whether the path is `-`, which stands for standard input or output.
pub fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Refuses a command that reads standard input for more than one of its files.
pub fn check_standard<'a>(inputs: impl IntoIterator<Item = &'a PathBuf>) -> Result<(), Failure> {
    match inputs.into_iter().filter(|path| is_standard(path)).count() {
        0 | 1 => Ok(()),
        count => Err(Failure::usage(format!(
            "standard input can be read only once, but {count} files of this command come from it: give '-' once"
        ))),
    }
}

/// The name of an input file for messages.
pub fn name(path: &Path) -> String {
    if is_standard(path) {
        "standard input".to_owned()
    } else {
        printable(&path.display().to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_beside_packed_ones_are_packed() {
        let found = |path: &str| beside(Path::new(path), "node");
        assert_eq!(found("a.b/m.ele"), Path::new("a.b/m.node"));
        assert_eq!(found("a.b/m.x.ele.gz"), Path::new("a.b/m.x.node.gz"));
        assert_eq!(found("m.ele.ZST"), Path::new("m.node.ZST"));
    }

    #[test]
    fn the_extension_of_a_packed_file_is_that_of_its_content() {
        let found = |path: &'static str| (extension(Path::new(path)), Compression::of(Path::new(path)));
        assert_eq!(found("a/points.csv"), ("csv", Compression::None));
        assert_eq!(found("a.b/points.CSV.GZ"), ("CSV", Compression::Gzip));
        assert_eq!(found("points.xyz.zst"), ("xyz", Compression::Zstd));
        assert_eq!(found("points.gz"), ("", Compression::Gzip));
        assert_eq!(found(".gz"), ("", Compression::None));
        assert_eq!(found("-"), ("", Compression::None));
    }
}
