//! C++ programs that are compiled on the spot: peers whose libraries may not be linked into ours.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicU32, Ordering};
use std::{env, fs, process};

/// A program that g++ has made of a text, in a folder of its own that goes with this value.
///
/// A program that runs already does not need its file any more.
#[derive(Debug)]
pub struct Compiled {
    folder: PathBuf,
}

impl Compiled {
    /// Compiles a program with the optimisation `-O3 -DNDEBUG` and these libraries. `CPLUS_INCLUDE_PATH` and
    /// `LIBRARY_PATH` help if headers and libraries are not where the compiler looks.
    ///
    /// # Errors
    /// The folder cannot be made, there is no compiler, or the compiler refuses the text: the reason in words.
    pub fn new(source: &str, libraries: &[&str]) -> Result<Self, String> {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let name = format!("incircle-peer-{}-{}", process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
        let folder = env::temp_dir().join(name);
        // The folder must be new and private: the program that is compiled there is run.
        let mut builder = fs::DirBuilder::new();
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder.create(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        let made = Self { folder };
        compile(&made.folder, &made.program(), source, libraries)?;
        Ok(made)
    }

    /// The file of the program.
    pub fn program(&self) -> PathBuf {
        self.folder.join("program")
    }
}

impl Drop for Compiled {
    fn drop(&mut self) {
        // A folder that stays does no harm.
        let _ = fs::remove_dir_all(&self.folder);
    }
}

fn compile(folder: &Path, program: &Path, source: &str, libraries: &[&str]) -> Result<(), String> {
    let text = folder.join("program.cpp");
    fs::write(&text, source).map_err(|error| error.to_string())?;
    let mut compiler = Command::new("g++");
    compiler.args(["-O3", "-DNDEBUG", "-w", "-std=c++17", "-o"]).arg(program).arg(&text).args(libraries);
    let output = compiler.output().map_err(|error| format!("g++: {error}"))?;
    if output.status.success() {
        return Ok(());
    }
    let text = String::from_utf8_lossy(&output.stderr);
    let first = text.lines().find(|line| line.contains("error") || line.contains("cannot find"));
    Err(format!("not installed: {}", first.unwrap_or("g++ failed").trim()))
}
