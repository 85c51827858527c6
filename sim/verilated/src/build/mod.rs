//! The build side of the binding: from Verilog to a static library and a Rust table of models.

mod cache;
mod error;
mod file;
mod rewrite;
mod runtime;
mod shim;
mod source;
mod verilator;

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::Mutex;

use file::write;

pub use error::BuildError;
pub use runtime::compile_runtime;
pub use source::{ModelSource, Optimisation};
pub use verilator::Verilator;

/// Collects models, then builds all of them.
#[derive(Debug, Default)]
pub struct Builder {
    models: Vec<ModelSource>,
}

impl Builder {
    /// A builder without models. Only build scripts can use it, because it reads the variables that
    /// cargo sets for them.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a model to build.
    pub fn model(mut self, model: ModelSource) -> Self {
        self.models.push(model);
        self
    }

    /// Builds and links all models, and writes the file that `verilated::include_models!` includes. A model whose text,
    /// options and tools have not changed is taken from the last build, whichever profile that was for. As many models
    /// are built at a time as cargo allows jobs.
    ///
    /// # Panics
    /// Every error panics with its message, which is how a build script fails.
    pub fn compile(self) {
        if let Err(error) = self.try_compile() {
            panic!("{error}");
        }
    }

    /// Builds as [`Builder::compile`] does, and returns the error.
    ///
    /// # Errors
    /// Verilator or the compiler is missing or refuses the input, or a name is invalid or used twice.
    pub fn try_compile(self) -> Result<(), BuildError> {
        for (position, model) in self.models.iter().enumerate() {
            model.check_name()?;
            let mut earlier = self.models.iter().take(position);
            if earlier.any(|other| other.name == model.name) {
                return Err(BuildError::NameTwice { name: model.name.clone() });
            }
        }
        println!("cargo:rerun-if-changed=build.rs");
        let out_dir = cargo_variable("OUT_DIR")?;
        let out_dir = PathBuf::from(out_dir);
        let package = cargo_variable("CARGO_PKG_NAME")?.replace('-', "_");
        let verilator = Verilator::locate()?;
        let kept = kept_folder(&out_dir, &package);
        // The lock is held until the archive is written: another build of this package waits, and then
        // finds the models built.
        let _lock = file::lock(&kept)?;
        let compiler = runtime::compiler_text(&verilator)?;
        let objects = build_all(&self.models, &verilator, &compiler, &kept, &package)?;
        if !objects.is_empty() {
            let mut archive = runtime::compiler(&verilator);
            for object in objects {
                archive.object(object);
            }
            archive.try_compile(&format!("{package}_models"))?;
        }
        let names: Vec<_> = self.models.iter().map(|m| m.name.as_str()).collect();
        let table = out_dir.join("verilated_models.rs");
        write(&table, &shim::rust_table(&package, &names))
    }
}

/// The folder that keeps the models of a package from build to build. Cargo gives a build script the folder
/// `TARGET/PROFILE/build/NAME/out`. Models depend on no profile, so they stand beside the profiles, and
/// each is translated once.
fn kept_folder(out_dir: &Path, package: &str) -> PathBuf {
    let parents: Vec<&Path> = out_dir.ancestors().skip(2).take(3).collect();
    match parents[..] {
        [build, _, target] if build.ends_with("build") => target.join("verilated").join(package),
        _ => out_dir.join("verilated"),
    }
}

/// The objects of all models, in the order of the models.
fn build_all(
    models: &[ModelSource],
    verilator: &Verilator,
    compiler: &str,
    kept: &Path,
    package: &str,
) -> Result<Vec<PathBuf>, BuildError> {
    let jobs = std::env::var("NUM_JOBS")
        .ok()
        .and_then(|jobs| jobs.parse::<usize>().ok())
        .unwrap_or(1)
        .clamp(1, models.len().max(1));
    let next = AtomicUsize::new(0);
    let results = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..jobs {
            scope.spawn(|| loop {
                let position = next.fetch_add(1, Ordering::Relaxed);
                let Some(model) = models.get(position) else {
                    break;
                };
                let folder = kept.join(&model.name);
                let objects = cache::objects_of(model, verilator, compiler, &folder, package);
                if let Ok(mut results) = results.lock() {
                    results.push((position, objects));
                }
            });
        }
    });
    let mut results = results.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
    results.sort_by_key(|(position, _)| *position);
    let mut objects = Vec::new();
    for (_, built) in results {
        objects.extend(built?);
    }
    Ok(objects)
}

fn cargo_variable(name: &'static str) -> Result<String, BuildError> {
    std::env::var(name).map_err(|_| BuildError::NotABuildScript { variable: name })
}
