//! The room that files of tiles take, which is checked before the first one is written.

use std::fs;
use std::path::Path;

use crate::failure::Failure;
use crate::formats::MeshFormat;
use crate::path;

/// Bytes of a point in the files of points, and of its two triangles in the files of tiles.
const POINTS: u64 = 12;
const TRIANGLES: u64 = 24;
/// Borders and the triangles of joins add one byte to this many bytes of the files of tiles. Sets with large empty
/// circles, such as points on one circle, need more: at worst they fill the disk, and the step fails.
const EXTRA: u64 = 20;

/// The bytes that the steps of an even set have on disk at one time, at most.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needed {
    /// The files of the tiles.
    pub scratch: u64,
    /// The file of the mesh.
    pub mesh: u64,
}

impl Needed {
    /// The bytes for an even set of `points` points.
    pub fn of(points: u64, format: MeshFormat) -> Self {
        let tiles = points * TRIANGLES;
        // The points of a tile go when it is triangulated.
        Self { scratch: (points * POINTS).max(tiles + tiles / EXTRA), mesh: mesh_bytes(points, format) }
    }

    /// Refuses the set if the disks have less room. `there` are the bytes that an earlier run has written already.
    pub fn check(self, scratch: &Path, mesh: Option<&Path>, there: u64) -> Result<(), Failure> {
        let Self { scratch: own, mesh: out } = self;
        match mesh {
            Some(mesh) if is_one_disk(scratch, mesh) => room_for(scratch, (own + out).saturating_sub(there)),
            Some(mesh) => {
                room_for(scratch, own.saturating_sub(there))?;
                room_for(mesh, out)
            }
            None => room_for(scratch, own.saturating_sub(there)),
        }
    }
}

/// The bytes of a mesh of `points` points, at most: two triangles for each.
fn mesh_bytes(points: u64, format: MeshFormat) -> u64 {
    let digits = u64::from(points.max(1).ilog10()) + 2;
    match format {
        MeshFormat::Npy => points * TRIANGLES,
        MeshFormat::Ele => 2 * points * 4 * digits,
        _ => 2 * points * 3 * digits,
    }
}

/// Refuses to write `bytes` to a folder whose disk has less room. A disk that does not tell is not refused.
pub fn room_for(folder: &Path, bytes: u64) -> Result<(), Failure> {
    match fs4::available_space(folder) {
        Ok(free) if free < bytes => Err(Failure::input(format!(
            "{} has {} free, and {} are needed: choose another folder, or make room",
            path::name(folder),
            told(free),
            told(bytes)
        ))),
        _ => Ok(()),
    }
}

/// A number of bytes with a unit that suits it, for messages. The units are powers of 1,024, as those of `--memory` are.
pub fn told(bytes: u64) -> String {
    const MEBIBYTE: u64 = 1 << 20;
    const GIBIBYTE: u64 = 1 << 30;
    if bytes < MEBIBYTE {
        format!("{bytes} bytes")
    } else if bytes < 10 * GIBIBYTE {
        format!("{} MiB", bytes / MEBIBYTE)
    } else {
        format!("{} GiB", bytes / GIBIBYTE)
    }
}

/// The bytes of all files in a folder; 0 if there is no such folder.
pub fn bytes_in(folder: &Path) -> u64 {
    let Ok(entries) = fs::read_dir(folder) else { return 0 };
    entries.filter_map(Result::ok).filter_map(|entry| entry.metadata().ok()).map(|found| found.len()).sum()
}

#[cfg(unix)]
fn is_one_disk(one: &Path, other: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let disk = |folder: &Path| fs::metadata(folder).ok().map(|found| found.dev());
    disk(one) == disk(other)
}

/// Other systems do not tell, so all files are counted on one disk.
#[cfg(not(unix))]
fn is_one_disk(_: &Path, _: &Path) -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_and_mesh_need_room() {
        let needed = Needed::of(1_000_000, MeshFormat::Npy);
        assert_eq!(needed, Needed { scratch: 25_200_000, mesh: 24_000_000 });
        assert_eq!(Needed::of(1_000_000, MeshFormat::Csv).mesh, 48_000_000);
        let folder = std::env::temp_dir();
        assert!(needed.check(&folder, Some(&folder), 0).is_ok());
        let huge = Needed::of(u64::MAX / 1000, MeshFormat::Npy);
        assert!(huge.check(&folder, None, 0).is_err_and(|failure| failure.message.contains("GiB are needed")));
    }
}
