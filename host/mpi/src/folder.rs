//! The seventh step: a folder with a file for each process, which gets its name when everything in it is complete.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use incircle_cli::formats::npy_writer::{write_mesh_head, write_triangles};
use incircle_cli::Failure;

/// The name of the file of counts.
const COUNTS: &str = "mesh.json";

/// The folder of the mesh, under a working name.
#[derive(Clone, Debug)]
pub struct Folder {
    path: PathBuf,
    part: PathBuf,
}

impl Folder {
    /// The folder with this path. `number` makes the working name one of this run alone.
    pub fn new(path: &Path, number: u64) -> Self {
        let mut name = std::ffi::OsString::from(".");
        name.push(path.file_name().unwrap_or_default());
        name.push(format!(".{number}.part"));
        Self { path: path.to_owned(), part: path.with_file_name(name) }
    }

    /// Makes the folder under its working name.
    ///
    /// # Errors
    /// The path is there and no empty folder, or the folder cannot be made.
    pub fn make(&self) -> Result<(), Failure> {
        let name = self.path.display();
        if self.path.file_name().is_none() {
            return Err(Failure::usage(format!("{name} is no name for a folder: name one, such as mesh")));
        }
        if fs::symlink_metadata(&self.path).is_ok() {
            let is_empty = fs::read_dir(&self.path).is_ok_and(|mut entries| entries.next().is_none());
            if !is_empty {
                return Err(Failure::input(format!(
                    "{name} is there already and is no empty folder: choose another name, or remove it"
                )));
            }
        }
        fs::create_dir(&self.part).map_err(|error| self.cannot("made", &error))
    }

    /// Writes the triangles of a process.
    pub fn write(&self, rank: usize, triangles: &[[u32; 3]]) -> Result<(), Failure> {
        let write = || {
            let mut file = BufWriter::with_capacity(1 << 16, File::create(self.part.join(file_name(rank)))?);
            write_mesh_head(triangles.len() as u64, &mut file)?;
            write_triangles(triangles, &mut file)?;
            file.flush()
        };
        write().map_err(|error| self.cannot("written", &error))
    }

    /// Writes the counts, and gives the folder its name.
    pub fn finish(&self, counts: &serde_json::Value) -> Result<(), Failure> {
        let text = format!("{counts}\n");
        fs::write(self.part.join(COUNTS), text).map_err(|error| self.cannot("written", &error))?;
        // A rename replaces an empty folder, and no other.
        fs::rename(&self.part, &self.path).map_err(|error| self.cannot("written", &error))
    }

    /// Removes the folder under its working name.
    pub fn remove(&self) {
        let _ = fs::remove_dir_all(&self.part);
    }

    fn cannot(&self, what: &str, error: &io::Error) -> Failure {
        Failure::input(format!("{} cannot be {what}: {error}", self.path.display()))
    }
}

/// The name of the file of a process.
pub fn file_name(rank: usize) -> String {
    format!("{rank}.npy")
}
